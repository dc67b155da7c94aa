#pragma once
#include "config/json/reader.h"
#include "layout.h"
#include <filesystem>

namespace starbow {

// The readers of a layout file's parts; each throws an InputError about wrong values. layout.cpp combines them.

/// Far beyond any building, and its square is far from overflow.
constexpr Range room_m{-1e4, 1e4};

/// A whole layout; `file` gives its name and the folder that its paths start from.
Layout read_layout(const Place& place, const std::filesystem::path& file);

/// At least one of a monitor's names.
MonitorName read_monitor(const Place& place);

Projection read_projection(const Place& place);

/// Throws where the eye can't see the projection: a wall from behind or edge on, a dome from outside. `eyes_apart_m`: the
/// distance of its two eyes, 0 for one.
void check_eye(const Place& place, const Projection& projection, const glm::dvec3& eye_m, double eyes_apart_m);

Colour read_colour(const Place& place, const std::filesystem::path& folder);

/// The path at a place, from a folder; throws where there is no such file.
std::filesystem::path existing_file(const Place& place, const std::filesystem::path& folder);

} // namespace starbow
