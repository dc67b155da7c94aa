#pragma once
#include <glm/glm.hpp>
#include <string>

namespace starbow {

/// How much of a clock's face is mark, 0 to 1, at one point: its radius is 1, x to the right, y up. Hands stand for the time
/// that the point itself shows, figures for `told`. Sharp: whoever asks takes the mean.
double mark(const glm::dvec2& at, double reading_s, const std::string& told);

} // namespace starbow
