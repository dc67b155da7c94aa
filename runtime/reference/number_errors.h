#pragma once
#include "reference.h"

namespace starbow {

/// How far live numbers (an EXR's channels) are from the reference's, of each pixel that shows something in both, beyond
/// what a float resolves.
struct NumberErrors {
    std::vector<double> directions_px; ///< of the world's direction, in widths of that pixel there
    std::vector<double> doppler; ///< of D, relative
    bool finite = true; ///< the live ones: all but the distance of the sky
};
/// u: the observer's proper velocity. slack_rad: also beyond what follows from looking so far off on board, which is
/// greatest where D changes fastest.
NumberErrors number_errors(const Reference& truth, const Channels& live, const glm::dvec3& u, double slack_rad = 0);

} // namespace starbow
