#pragma once
#include <string>

namespace starbow {

/// Prints what a frame of a shipped layout and shot takes at least on the card of a family, pass by pass. Throws InputError.
void bench_estimate(const std::string& family, const std::string& layout, const std::string& shot);

} // namespace starbow
