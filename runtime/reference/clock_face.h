#pragma once
#include <glm/glm.hpp>
#include <string>

namespace starbow {

/// The coverage of a clock's face by marks, 0 to 1, at one point: its radius is 1, x to the right, y up. The hands show the
/// point's own time, the figures show `text`. The edges are sharp: callers average.
double mark(const glm::dvec2& at, double reading_s, const std::string& text);

} // namespace starbow
