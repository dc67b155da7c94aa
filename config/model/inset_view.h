#pragma once
#include "shot.h"
#include <array>
#include <string_view>

namespace starbow {

/// The inset view, of the same instant: at rest, with one effect alone, or through a telescope that looks where the ship
/// flies. In the order of the key that steps through them.
enum class InsetView { none, at_rest, aberration, doppler, headlight, telescope };
constexpr std::array<const char*, 6> inset_view_names
    = {"none", "at-rest", "aberration", "doppler", "headlight", "telescope"};
inline InsetView after(InsetView view) { return InsetView((std::size_t(view) + 1) % inset_view_names.size()); }
/// Throws InputError for an unknown name.
InsetView inset_view_named(std::string_view name);
inline const char* name_of(InsetView view) { return inset_view_names[std::size_t(view)]; }

/// The cockpit turned so that it looks where the ship flies; as it is at rest.
glm::dquat towards_flight(const Shot& shot);

/// The field of the inset from its lower edge to its upper, degrees, but for a telescope's.
constexpr double inset_fov_deg = 60;
/// The telescope's field: what an observer at rest sees in the front half of the sky, ahead of one of proper velocity u. One
/// of few steps, so that it can be read: 60, 40, 30, 20, 15, 10, 8, 6, 4, ... degrees. before: the field of the frame
/// before, which stays as long as it suits; 0: none.
double telescope_fov_deg(double u, double before);
/// The field of few steps that is at least the wanted one, degrees. before: as above.
double stepped_fov_deg(double wanted, double before);

/// The shot turned so that it looks towards a unit direction of its cockpit, as upright as it was.
Shot looking(Shot shot, const glm::dvec3& towards);

/// The shot of the inset. start_ev: the exposure of the inset, EV; headlight alone and the telescope have the shot's own, as
/// their light is as bright.
inline Shot inset_shot(Shot shot, InsetView view, double start_ev)
{
    if (view == InsetView::telescope) {
        shot.ship_from_cockpit = towards_flight(shot);
        return shot;
    }
    EffectSet alone;
    alone.set(Effect::aberration, view == InsetView::aberration);
    alone.set(Effect::doppler, view == InsetView::doppler);
    alone.set(Effect::headlight, view == InsetView::headlight);
    shot.effects = {.on = alone};
    if (view == InsetView::at_rest) {
        shot.effects = {};
        shot.u = glm::dvec3(0);
    }
    if (view != InsetView::headlight)
        shot.exposure_ev = start_ev;
    return shot;
}

} // namespace starbow
