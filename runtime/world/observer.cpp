#include "observer.h"
#include "eye_event.h"
#include "shaders/physics/physics.h"
#include "worldline.h"
#include <algorithm>

namespace starbow {

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
    before.clear();
    Observer out{observer, shot_of(ship, observer), 1, std::move(before)};
    out.E = physics::exp_rapidity(glm::length(out.shot.u));
    const bool now = ship.effects.comparison == Comparison::no_light_delay;
    const bool aberration = ship.effects.aberration || now;
    Shot still = out.shot;
    still.u = glm::dvec3(0);
    for (const RestFrame& frame : world.frames) {
        const bool own = out.rest_frames.empty(); // the world comes first: its axes are the motion axes in any case
        const Shot looks = in_frame(frame, aberration || own ? out.shot : still);
        const glm::dmat3 turn = motion_from_world(looks.u, looks.ship_from_cockpit);
        out.rest_frames.push_back(
            {in_frame(frame, out.shot), aberration || !own ? physics::exp_rapidity(glm::length(looks.u)) : 1, turn,
                turn * glm::dmat3(glm::mat3_cast(looks.ship_from_cockpit))});
        if (!now)
            continue;
        RestFrameView& rest_frame = out.rest_frames.back();
        const double gamma = physics::gamma_of(rest_frame.shot.u);
        rest_frame.now = true, rest_frame.E = 1, rest_frame.contraction = 1 / gamma,
        rest_frame.beta = glm::length(rest_frame.shot.u) / gamma;
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
