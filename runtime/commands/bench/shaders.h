#pragma once
#include <string>

namespace starbow {

/// Prints what each pass's shaders cost on a graphics card that need not be there: RADV, Mesa's driver for AMD's cards, compiles
/// for any of its families without one. Every pipeline counts that the shipped worlds reach in windows and domes, with one eye
/// and two, in the qualities `balanced` and `fine`, with every switch. The figures are the compiler's own, and the same on each
/// machine with the same Mesa.
/// family: one of card_families. json: the file for the figures of each pipeline, or empty. against: such a file
/// of another time, or empty: the difference is printed. Throws InputError.
void bench_shaders(const std::string& family, const std::string& json, const std::string& against);

} // namespace starbow
