#pragma once
#include "spectral_basis.h"
#include <glm/gtc/type_precision.hpp>

namespace starbow {

/// A response table as the device reads it, RESPONSE_ROWS rows of words in texels of four. A row holds a pair of halves for
/// each basis coefficient and each shown colour (red, green, blue; Rec. 709 linear). They are the coefficient's part of the
/// colour over the row's scale, and its increase up to the next row. Then follow, as floats, the binary logarithm of that
/// scale and its increase. The scene's own emission spectra stand apart in RESPONSE_OWN_ROWS rows of MAX_OWN, so that they
/// may be brighter or darker by any factor. Each entry is a colour over its scale, and the scale's logarithm.
struct Response {
    int reflected = 0, own = 0;
    double first_log2_D = 0, per_octave = 1; ///< row i: log2 D = first + i / per_octave
    std::vector<glm::uvec4> rows;
    std::vector<glm::vec4> own_rows;
    std::vector<glm::dvec3> unshifted; ///< the colour of each coefficient at D = 1, without the tables' rounding
};

Response response_of(const SpectralBasis& basis, const StandardObserver& observer);

/// The rows for a device's sampler, which interpolates them: RESPONSE_ROWS columns by `reflected` rows of four halves. The
/// first three of row k are coefficient k's parts in red, green and blue. The fourth of rows 0 and 1 add up to the scale's
/// logarithm: its nearest half, and the rest.
std::vector<glm::u16vec4> picture_of(const Response& response);

/// The colour of basis coefficients at D, as the device computes it. Between rows the scales are interpolated
/// geometrically, because colours have steep ends that are nearly geometric; the values over the scales are interpolated
/// linearly.
glm::dvec3 seen(const Response& response, std::span<const double> coefficients, double D);

} // namespace starbow
