#pragma once
#include "runtime/world/world.h"
#include <array>

namespace starbow {

/// The measuring overlays of every viewport, in the order of the key that steps through them.
/// Spectrum and photometer have a panel of their own, and the crosshair.
enum class Overlay { off, aim, grid, ring, distance, emission, protractor, spectrum, photometer };
constexpr std::array<const char*, 9> overlay_names
    = {"off", "aim", "grid", "ring", "distance", "emission", "protractor", "spectrum", "photometer"};
/// Those that differ in the picture itself.
inline constexpr std::array drawn_overlays
    = {Overlay::aim, Overlay::grid, Overlay::ring, Overlay::distance, Overlay::emission, Overlay::protractor};

/// The scales of the false colours.
struct OverlayScale {
    double nearest_s = 1, farthest_s = 1000; ///< ends of the colours, seconds of light
    double emission_step_s = 1; ///< between contours of equal retarded times
};
/// The scale for a world seen from a place: rounded ends of the distances, and a step that gives about ten contours near
/// by.
OverlayScale overlay_scale(const World& world, const glm::dvec3& place, double seconds_per_time_unit);

} // namespace starbow
