#pragma once

namespace starbow {

/// How an exhibit chooses its brightness. EV: powers of two of the light.
struct Exposing {
    bool automatic = true; ///< after what is seen, as eyes do; what the visitor turns is added
    /// Between which it chooses. The greatest shows as mid-grey (0.18) what an eye that has long been in the dark just sees,
    /// 1e-6 cd/m^2. Luminance 1 is a sunlit white surface's: 1361 W/m^2 of a black body of 5772 K, 92.0 lm/W of which an eye
    /// sees, over pi, are 39,900 cd/m^2; log2(0.18 * 39,900 / 1e-6) = 32.7.
    double min_ev = -60, max_ev = 33;
    double bloom = 0; ///< part of the light that is spread around what shines, as in an eye or a lens
};

} // namespace starbow
