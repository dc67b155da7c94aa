#pragma once
#include "input/controls.h"

namespace starbow::testing {

/// Controls with these parts, the rest at rest: controls_with(Steering{.lever = 1}).
template <class... Parts> Controls controls_with(const Parts&... parts)
{
    Controls controls;
    ((static_cast<Parts&>(controls) = parts), ...);
    return controls;
}

} // namespace starbow::testing
