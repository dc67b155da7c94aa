#pragma once
#include "config/model/layout.h"
#include "config/model/log_kinds.h"
#include "runtime/flight/record.h"
#include <filesystem>
#include <string>
#include <vector>

namespace starbow {

/// All files that a layout consists of.
std::vector<std::filesystem::path> files_of(const Layout& layout);

/// The digest of files in order; a missing one adds nothing.
std::uint64_t digest_of(const std::vector<std::filesystem::path>& files);

/// The header of a record of a flight that begins now. Throws InputError where a file can't be read.
RecordHeader header_of(const std::filesystem::path& scene, const Layout& layout, const Shot& start, const Flying& rules,
    const Exposing& exposing, const std::string& pattern);

/// The scene and the layout of a replay.
struct Flown {
    std::filesystem::path scene;
    Layout layout;
};

/// Finds the scene and the layout of a record. layout: another one instead of the record's; empty: the record's. log: is
/// called if files have changed since the record, because the pictures may then differ. Throws InputError if the scene
/// now has another unit of time, because every state would differ.
Flown find_flown(
    const std::filesystem::path& record, const RecordHeader& header, const std::string& layout, const LogTo& log);

} // namespace starbow
