#pragma once
#include "coverage.h"

namespace starbow {

/// Warnings of possible and hardly intended values, a line each: millimetres for metres, radians for degrees, pixels that
/// are not square, light twice on one place, a head-up display that no one sees.
std::vector<std::string> lint(const Layout& layout, const std::vector<Coverage>& coverages);

} // namespace starbow
