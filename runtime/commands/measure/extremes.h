#pragma once
#include <string>

namespace starbow {

/// Flies, looks and is shown at the ends of what the program takes, and tells of each case whether it is finite and within
/// its stated error, or refused in a sentence. folder: for extremes.md, made if it is not there; empty: printed alone.
/// Returns the exit status: 1 where a case fails.
int measure_extremes(const std::string& folder);

} // namespace starbow
