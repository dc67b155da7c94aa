#pragma once
#include "shot.h"
#include <array>
#include <string_view>

namespace starbow {

/// The small picture beside the large one, of the same instant: at rest, with one effect alone, or through a telescope that
/// looks where the ship flies. In the order of the key that steps through them.
enum class Beside { none, at_rest, aberration, doppler, headlight, telescope };
constexpr std::array<const char*, 6> beside_names = {"none", "at-rest", "aberration", "doppler", "headlight", "telescope"};
inline Beside after(Beside beside) { return Beside((std::size_t(beside) + 1) % beside_names.size()); }
/// Throws InputError for an unknown name.
Beside beside_named(std::string_view name);
inline const char* name_of(Beside beside) { return beside_names[std::size_t(beside)]; }

/// The cockpit turned so that it looks where the ship flies; as it is at rest.
glm::dquat towards_flight(const Shot& shot);

/// The field of the small picture from its lower edge to its upper, degrees, but for a telescope's.
constexpr double beside_fov_deg = 60;
/// The telescope's field: what an observer at rest sees in the front half of the sky, ahead of one of proper velocity u. One
/// of few steps, so that it can be read: 60, 40, 30, 20, 15, 10, 8, 6, 4, ... degrees. before: the field of the frame
/// before, which stays as long as it suits; 0: none.
double telescope_fov_deg(double u, double before);

/// The shot of the small picture. start_ev: the exposure of the small picture, EV; headlight alone and the telescope have
/// the shot's own, as their light is as bright.
inline Shot beside(Shot shot, Beside beside, double start_ev)
{
    if (beside == Beside::telescope) {
        shot.ship_from_cockpit = towards_flight(shot);
        return shot;
    }
    EffectSet alone;
    alone.set(Effect::aberration, beside == Beside::aberration);
    alone.set(Effect::doppler, beside == Beside::doppler);
    alone.set(Effect::headlight, beside == Beside::headlight);
    shot.effects = {.on = alone};
    if (beside == Beside::at_rest) {
        shot.effects = {};
        shot.u = glm::dvec3(0);
    }
    if (beside != Beside::headlight)
        shot.exposure_ev = start_ev;
    return shot;
}

} // namespace starbow
