#pragma once
#include "config/model/scene_file.h"
#include "world.h"
#include <filesystem>

namespace starbow {

/// The picture of a sky with a Milky Way: its panorama, with the stars painted onto it that are not drawn one by one. Painting
/// takes a second, so the picture is kept in a folder by the content of both files, and the next start reads it. A folder
/// that is empty, or can't be used, only makes starts slower. Throws InputError for a panorama or a catalogue that is not
/// right.
Texture load_sky(const StarSky& sky, const std::filesystem::path& folder);

} // namespace starbow
