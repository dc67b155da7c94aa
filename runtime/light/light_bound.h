#pragma once
#include "response.h"

namespace starbow {

/// An upper bound of the light that any mixture of basis coefficients brings, by D: of coefficients between -1 and 1, the
/// greatest absolute value of a colour. It never falls as D rises. Element i holds from row i of the response to row i + 1.
struct LightBound {
    double first_log2_D = 0, per_octave = 1;
    std::vector<double> log2_of_row; ///< binary logarithms
};
LightBound greatest_light(const Response& response);

/// The D below which coefficients between -most and most bring colours of less than `least`; 0 where there is none, or light
/// does not depend on D. It may be smaller than the true one, never greater. doppler: without it light has the colours of
/// D = 1. headlight: times D^3.
double doppler_cutoff(const LightBound& greatest, bool doppler, bool headlight, double most, double least);

} // namespace starbow
