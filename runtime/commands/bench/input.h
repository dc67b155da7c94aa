#pragma once
#include <string>

namespace starbow {

/// Flies an exhibit and times it from a device's reports to the present calls that show them. Returns the exit status.
int bench_input(const std::string& layout, double seconds);

} // namespace starbow
