#pragma once
#include <numbers>

namespace starbow {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180; ///< radians

} // namespace starbow
