#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

namespace starbow {

/// A flat window looked at from its axis. The horizontal angle follows from the pixels' aspect.
struct Planar {
    double fov_y_deg = 60;
};

/// An equidistant fisheye inscribed in the viewport's rectangle: a domemaster. Its zenith (the centre) is the cockpit's up
/// tilted forward: tilt_deg 0 looks straight up, 90 straight ahead; the bottom of the picture is towards the visitor's
/// front.
struct Fisheye {
    double aperture_deg = 180;
    double tilt_deg = 0;
};

using Projection = std::variant<Planar, Fisheye>;

struct Viewport {
    glm::dvec4 rect{0, 0, 1, 1}; ///< x, y, width, height as fractions of the output, from its top left
    Projection projection;
    glm::dvec3 eye_m{0}; ///< place of the eye in the cockpit, metres (+x right, +y up, -z ahead)
};

struct Output {
    std::string name;
    glm::ivec2 size{800, 600}; ///< pixels
    bool resizable = false;
    std::vector<Viewport> viewports;
};

/// Where the head-up display floats in the cockpit: its centre's direction and its width as seen.
struct HudPlacement {
    double azimuth_deg = 0; ///< to the right of straight ahead
    double elevation_deg = 0; ///< above straight ahead
    double width_deg = 40;
};

/// What the exhibit is made of. Directions are in the cockpit's frame: looking along -z, +x right, +y up.
struct Layout {
    std::string name;
    double hyper_stereo = 1; ///< multiplies every eye_m, for worlds measured in light-seconds
    HudPlacement hud;
    std::vector<Output> outputs;
};

/// The pixels of a viewport in an output of `size`: x, y, width, height. Its edges are rounded, so that neighbours meet.
glm::ivec4 pixel_rect(const Viewport& viewport, glm::ivec2 size);

/// Reads and checks a layout. Throws InputError with file, JSON pointer, value and what would be right.
Layout load_layout(const std::filesystem::path& file);

} // namespace starbow
