#pragma once
#include "config/model/effects.h"

namespace starbow::testing {

/// These effects alone.
constexpr Effects effects_of(bool aberration, bool doppler, bool headlight)
{
    Effects effects{.on = {}};
    effects.on.set(Effect::aberration, aberration);
    effects.on.set(Effect::doppler, doppler);
    effects.on.set(Effect::headlight, headlight);
    return effects;
}

} // namespace starbow::testing
