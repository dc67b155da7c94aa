#pragma once
#include "config/json/reader.h"
#include "layout.h"

namespace starbow {

/// A whole layout; `file` gives its name and the folder that its paths start from.
Layout read_layout(const Place& place, const std::filesystem::path& file);

/// The path at a place, from a folder; throws where there is no such file.
std::filesystem::path existing_file(const Place& place, const std::filesystem::path& folder);

/// Throws where the eye can't see the projection: a wall from behind or edge on, a dome from outside. `eyes_apart_m`: the
/// distance of its two eyes, 0 for one.
void check_eye(const Place& place, const Projection& projection, const glm::dvec3& eye_m, double eyes_apart_m);

} // namespace starbow
