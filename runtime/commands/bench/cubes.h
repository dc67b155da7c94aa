#pragma once
#include <map>
#include <string>

namespace starbow {

/// Times what a planned cube map saves and costs: a dome beside a plain picture, and the plan's images beside the six full
/// faces that would show as much. Prints to stdout. Returns the time of the dome with stars over the plain picture's, by
/// speed.
std::map<std::string, double> bench_cubes(int rounds);

} // namespace starbow
