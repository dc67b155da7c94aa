#pragma once

namespace starbow {

/// How an exhibit chooses its brightness. EV: powers of two of the light.
struct Exposing {
    bool automatic = true; ///< after what is seen, as eyes do; what the visitor turns is added
    double least_ev = -60, greatest_ev = 16; ///< between which it chooses
    double bloom = 0; ///< part of the light that is spread around what shines, as in an eye or a lens
};

} // namespace starbow
