#pragma once
#include "shot.h"
#include <array>
#include <string_view>

namespace starbow {

/// The small picture beside the large one, of the same instant: at rest, or with one effect alone. In the order of the key
/// that steps through them.
enum class Beside { none, at_rest, aberration, doppler, headlight };
constexpr std::array<const char*, 5> beside_names = {"none", "at-rest", "aberration", "doppler", "headlight"};
inline Beside after(Beside beside) { return Beside((std::size_t(beside) + 1) % beside_names.size()); }
/// Throws InputError for an unknown name.
Beside beside_named(std::string_view name);
inline const char* name_of(Beside beside) { return beside_names[std::size_t(beside)]; }

/// The shot of the small picture. start_ev: the exposure of the small picture, EV; headlight alone has the shot's own, as
/// its light is as bright.
inline Shot beside(Shot shot, Beside beside, double start_ev)
{
    shot.effects = {.aberration = beside == Beside::aberration,
        .doppler = beside == Beside::doppler,
        .headlight = beside == Beside::headlight};
    if (beside == Beside::at_rest) {
        shot.effects = {};
        shot.u = glm::dvec3(0);
    }
    if (beside != Beside::headlight)
        shot.exposure_ev = start_ev;
    return shot;
}

} // namespace starbow
