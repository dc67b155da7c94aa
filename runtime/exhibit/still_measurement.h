#pragma once
#include "config/model/layout.h"
#include "lab.h"
#include "runtime/render/offscreen.h"
#include <string>
#include <variant>
#include <vector>

namespace starbow {

constexpr const char* measure_help
    = "Print what the instruments read at these points of the first output, as \"X,Y; X,Y\" in pixels from its top left, or "
      "as "
      "\"Adeg,Bdeg\", degrees to the right of straight ahead and up; the first two are marked, as ○ and ◇";

/// A point of a picture in pixels, or a unit direction in the cockpit.
using Point = std::variant<glm::dvec2, glm::dvec3>;

/// Throws InputError for what is no list of points, or lies outside the layout's first output.
std::vector<Point> parse_points(const std::string& text, const Layout& layout);

/// What was measured of a shot.
struct StillMeasurement {
    std::vector<Measured> points; ///< aimed straight ahead, then at each of the points
    std::vector<std::string> lines; ///< of what was read, in English
    std::shared_ptr<const Panel> panel; ///< of readings, which the renderer's frame shows
};

/// Measures a shot, and has the renderer's next picture show it where an overlay or a page is asked for. Throws InputError
/// for a point that shows nothing. What is returned must outlive that picture. words: of the panel.
StillMeasurement measure_still(OffscreenRenderer& renderer, const GpuWorld& world, const Shot& shot,
    const std::vector<Point>& points, const std::string& overlay, const std::string& why, const Words& words);

} // namespace starbow
