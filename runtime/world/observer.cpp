#include "observer.h"
#include "eye_event.h"
#include "shaders/physics/physics.h"
#include "worldline.h"
#include <algorithm>

namespace starbow {
namespace {

/// e^rapidity at which a cube map's axes become those of the motion, at 0.51 c, and those of the cockpit again, at 0.44 c.
/// From there on a turn of the heading moves the picture ahead by half of its angle and more, so the axes may turn with it.
constexpr double most_slow_E = 1.75, least_fast_E = 1.6;

/// Chooses the axes of a rest frame's cube map. was_aligned: they were the motion axes in the picture before.
void choose_axes(RestFrameView& rest_frame, const glm::dquat& ship_from_cockpit, bool was_aligned)
{
    rest_frame.cube_from_frame = rest_frame.motion_from_frame;
    // Contraction at the ship's present is along z.
    if (rest_frame.now || rest_frame.E > (was_aligned ? least_fast_E : most_slow_E))
        return;
    const glm::dmat3 cube_from_frame = motion_from_world(glm::dvec3(0), ship_from_cockpit);
    if (cube_from_frame == rest_frame.motion_from_frame)
        return;
    rest_frame.cube_from_frame = cube_from_frame;
    rest_frame.cube_from_motion = cube_from_frame * glm::transpose(rest_frame.motion_from_frame);
}

} // namespace

double Observer::most_E() const
{
    double most = 1;
    for (const RestFrameView& rest_frame : rest_frames)
        most = std::max(most, physics::exp_rapidity(glm::length(rest_frame.shot.u)));
    return most;
}

Observer observer_of(
    const World& world, const Shot& ship, const ViewportObserver& observer, std::vector<RestFrameView> before)
{
    Observer out{observer, shot_of(ship, observer), 1, std::move(before)};
    out.E = physics::exp_rapidity(glm::length(out.shot.u));
    const bool now = ship.effects.comparison == Comparison::no_light_delay;
    const bool aberration = ship.effects[Effect::aberration] || now;
    Shot still = out.shot;
    still.u = glm::dvec3(0);
    const bool any_before = out.rest_frames.size() == world.frames.size();
    out.rest_frames.resize(world.frames.size());
    for (std::size_t at = 0; at < world.frames.size(); ++at) {
        const RestFrame& frame = world.frames[at];
        RestFrameView& rest_frame = out.rest_frames[at];
        const bool was_aligned = any_before && rest_frame.E > 1 && rest_frame.aligned();
        const bool own = at == 0; // the world comes first: its axes are the motion axes in any case
        const Shot looks = in_frame(frame, aberration || own ? out.shot : still);
        const glm::dmat3 turn = motion_from_world(looks.u, looks.ship_from_cockpit);
        rest_frame = {in_frame(frame, out.shot), aberration || !own ? physics::exp_rapidity(glm::length(looks.u)) : 1, turn,
            turn * glm::dmat3(glm::mat3_cast(looks.ship_from_cockpit))};
        if (now) {
            const double gamma = physics::gamma_of(rest_frame.shot.u);
            rest_frame.now = true, rest_frame.E = 1, rest_frame.contraction = 1 / gamma,
            rest_frame.beta = glm::length(rest_frame.shot.u) / gamma;
        }
        choose_axes(rest_frame, looks.ship_from_cockpit, was_aligned);
    }
    if (now)
        out.E = 1;
    return out;
}

Shot shot_of(const Shot& ship, const ViewportObserver& observer)
{
    Shot shot = ship;
    if (observer.at_rest)
        shot.u = glm::dvec3(0);
    if (observer.passing_u != glm::dvec3(0)) {
        const glm::dvec3 w = ship.ship_from_cockpit * observer.passing_u;
        shot.u = physics::composed(ship.u, w);
        shot.ship_from_cockpit = quaternion(physics::wigner_turn(ship.u, w)) * ship.ship_from_cockpit;
    }
    return shot;
}

} // namespace starbow
