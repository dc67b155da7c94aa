#pragma once
#include <cmath>

namespace starbow::testing {

/// Proper velocity u = gamma beta.
inline double u_of_gamma(double gamma) { return std::sqrt((gamma - 1) * (gamma + 1)); }
inline double u_of_beta(double beta) { return beta / std::sqrt((1 - beta) * (1 + beta)); }

} // namespace starbow::testing
