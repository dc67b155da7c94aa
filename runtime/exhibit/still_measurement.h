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

/// Throws InputError for a text that is no list of points, and for points outside the layout's first output.
std::vector<Point> parse_points(const std::string& text, const Layout& layout);

/// The instruments' readings of one shot.
struct StillMeasurement {
    std::vector<Measured> points; ///< straight ahead, then at each of the points
    std::vector<std::string> lines; ///< the readings as text, in English
    std::shared_ptr<const Panel> panel; ///< panel of readings that the renderer's frame shows
};

/// Measures a shot. If an overlay or a page is requested, the renderer's next picture shows it; the result must outlive
/// that picture. by_eye: it shows scales alone, and no line has a reading. The spectrum's slit and the photometer are at the
/// first point, or without points straight ahead. words: for the panel. Throws InputError for a point that shows nothing.
StillMeasurement measure_still(OffscreenRenderer& renderer, const GpuWorld& world, const Shot& shot,
    const std::vector<Point>& points, const std::string& overlay, const std::string& why, const Words& words,
    bool by_eye = false);

} // namespace starbow
