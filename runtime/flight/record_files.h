#pragma once
#include "config/model/layout.h"
#include "record.h"
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace starbow {

/// Every file that a layout is made of.
std::vector<std::filesystem::path> files_of(const Layout& layout);

/// Of one after the other; of one that is missing nothing is added.
std::uint64_t digest_of(const std::vector<std::filesystem::path>& files);

/// The header of a record of what is flown now. Throws InputError where a file can't be read.
RecordHeader header_of(const std::filesystem::path& scene, const Layout& layout, const Shot& start, const Flying& rules,
    const Exposing& exposing, const std::string& pattern);

/// What a replay flies in, and on.
struct Flown {
    std::filesystem::path scene;
    Layout layout;
};

/// Finds them again. layout: another one instead of the record's; empty: the record's. say: is called where the files are
/// others than they were: the pictures may be, too. Throws InputError where the scene now has another measure of time, in
/// which no state would be the same.
Flown find_flown(const std::filesystem::path& record, const RecordHeader& header, const std::string& layout,
    const std::function<void(const std::string&)>& say);

} // namespace starbow
