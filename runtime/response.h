#pragma once
#include "spectral_basis.h"

namespace starbow {

/// A response table as the device reads it, RESPONSE_ROWS rows of two words of four for each of the colours red, green and
/// blue (Rec. 709 linear) that are shown. A row holds up to 12 numbers' halves, over the row's own scale; red's seventh word
/// is the binary logarithm of that scale, and the eighth of its first two rows tells where the table begins and how many
/// rows an octave has. So that numbers of its own may be brighter or darker by any factor they stand apart, in
/// RESPONSE_OWN_ROWS rows of MAX_OWN: a colour over its scale, and that scale's logarithm.
struct Response {
    int reflected = 0, own = 0;
    std::array<std::vector<glm::uvec4>, 3> rows;
    std::vector<glm::vec4> own_rows;
};

Response response_of(const SpectralBasis& basis, const Observer& observer);

/// The colour of such numbers at D, as the device finds it: between rows scales are geometric, as colours' steep ends nearly
/// are, and what is over them straight.
glm::dvec3 seen(const Response& response, std::span<const double> numbers, double D);

} // namespace starbow
