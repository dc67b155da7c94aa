#pragma once
#include <string>

namespace starbow {

/// Times one layout stage by stage, then compares displays with each other: kinds of projection per pixel, many viewports
/// with one, the stereo methods with their disparity errors. Prints to stdout.
void bench_layout(const std::string& layout, const std::string& shot, int rounds);

} // namespace starbow
