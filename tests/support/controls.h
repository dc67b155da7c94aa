#pragma once
#include "input/controls.h"

namespace starbow::testing {

/// Controls of which one part is used: controls_with(Steering{.lever = 1}).
template <class Part> Controls controls_with(const Part& part)
{
    Controls controls;
    static_cast<Part&>(controls) = part;
    return controls;
}

} // namespace starbow::testing
