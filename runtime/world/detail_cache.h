#pragma once
#include "world.h"
#include <filesystem>
#include <functional>

namespace starbow {

/// add_detail_levels for worlds of many triangles, which take seconds: the levels are kept in a folder by the world's
/// content, and the next start reads them. Worlds of fewer corners than `worth_keeping` are simplified as fast as they
/// would be read. A folder that is empty, or can't be used, only makes starts slower. progress: as add_detail_levels'.
/// Returns true if it has written a file.
bool add_kept_detail_levels(World& world, const std::filesystem::path& folder,
    const std::function<void(double)>& progress = {}, std::size_t worth_keeping = 20'000);

/// The key of a world's levels: a hash of everything that they depend on.
std::uint64_t levels_key(const World& world);
/// Reads kept levels into a world without; false: there are none with this key, or the file is damaged, and the world stays
/// as it is.
bool read_kept_levels(const std::filesystem::path& file, std::uint64_t key, World& world);

} // namespace starbow
