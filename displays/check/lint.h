#pragma once
#include "coverage.h"

namespace starbow {

/// Warnings of legal but probably unintended values, one line each: millimetres for metres, radians for degrees, pixels
/// that are not square, light twice on one place.
std::vector<std::string> lint(const Layout& layout, const std::vector<Coverage>& coverages);

} // namespace starbow
