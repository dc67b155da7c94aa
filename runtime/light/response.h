#pragma once
#include "spectral_basis.h"

namespace starbow {

/// A response table as the device reads it, RESPONSE_ROWS rows of words in texels of four. A row holds for each number, for
/// each of the colours red, green and blue (Rec. 709 linear) that are shown, a pair of halves: its part of the colour over
/// the row's scale, and how much is added to it up to the next row; then, as floats, the binary logarithm of that scale, and
/// what is added to that. So that numbers of its own may be brighter or darker by any factor they stand apart, in
/// RESPONSE_OWN_ROWS rows of MAX_OWN: a colour over its scale, and that scale's logarithm.
struct Response {
    int reflected = 0, own = 0;
    double first_log2_D = 0, per_octave = 1; ///< row i: log2 D = first + i / per_octave
    std::vector<glm::uvec4> rows;
    std::vector<glm::vec4> own_rows;
};

Response response_of(const SpectralBasis& basis, const StandardObserver& observer);

/// The colour of such numbers at D, as the device finds it: between rows scales are geometric, as colours' steep ends nearly
/// are, and what is over them straight.
glm::dvec3 seen(const Response& response, std::span<const double> numbers, double D);

} // namespace starbow
