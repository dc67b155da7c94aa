#pragma once
#include <map>
#include <string>

namespace starbow {

/// Times the shipped worlds in which something moves, at 800x600: prints each one's stages and returns the median of the
/// whole frame, milliseconds, by shot.
std::map<std::string, double> bench_worlds(int rounds);

} // namespace starbow
