#pragma once
#include "reference.h"

namespace starbow {

/// The errors of live numbers (an EXR's channels) against the reference's, for each pixel that shows something in both,
/// beyond a float's resolution.
struct NumberErrors {
    std::vector<double> directions_px; ///< of the world's direction, in widths of that pixel there
    std::vector<double> doppler; ///< of D, relative
    bool finite = true; ///< the live ones: all but the distance of the sky
};
/// u: the observer's proper velocity. slack_rad: an angle on board whose consequences are left out too; they are greatest
/// where D changes fastest.
NumberErrors number_errors(const Reference& truth, const Channels& live, const glm::dvec3& u, double slack_rad = 0);

} // namespace starbow
