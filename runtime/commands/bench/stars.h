#pragma once

namespace starbow {

/// Times whole frames of the avenue, seen from above, under no stars, its own, and a synthetic hundred thousand and million.
/// Prints to stdout.
void bench_stars(int rounds);

} // namespace starbow
