#pragma once
#include "input/scan.h"
#include <type_traits>

namespace starbow::testing {

/// Controls with these parts, the rest at rest: controls_with(Steering{.lever = 1}).
template <class... Parts> Controls controls_with(const Parts&... parts)
{
    const auto count = []<class Part>(const Part*) { return (std::is_same_v<Part, Parts> + ...); };
    static_assert(
        ((count(static_cast<const Parts*>(nullptr)) == 1) && ...), "a second part of a type would replace the first");
    Controls controls;
    ((static_cast<Parts&>(controls) = parts), ...);
    return controls;
}

inline Controls controls_of(const ScannedHands& hands)
{
    return controls_with(static_cast<const Steering&>(hands), static_cast<const Switches&>(hands));
}

} // namespace starbow::testing
