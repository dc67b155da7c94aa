#pragma once
#include "direction_map.h"
#include <cstdint>
#include <filesystem>
#include <memory>

namespace starbow {

/// A kept map of this size, or null: there is none with this key, or the file is damaged.
std::shared_ptr<DirectionMap> read_kept_map(const std::filesystem::path& file, std::uint64_t key, glm::ivec2 size);

/// False: the file can't be written.
bool write_kept_map(const std::filesystem::path& file, std::uint64_t key, const DirectionMap& map);

} // namespace starbow
