#include "presence.h"
#include "rates.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

bool any_switch(const Controls& c) { return c.pressed || c.choose != 0 || c.turn_by != 0 || c.any(); }

bool moved(const Head& head, const Head& from)
{
    const double turn_rad = 2 * std::acos(std::min(1.0, std::abs(glm::dot(head.turned, from.turned))));
    return glm::length(head.moved_m - from.moved_m) > least_head_m || turn_rad > least_head_rad;
}

} // namespace

bool Presence::take(const Controls& c, double dt_s)
{
    bool somebody = any_switch(c);
    const double look_rate = dt_s > 0 ? 1 / (look_rad_per_s * dt_s) : 0;
    const std::array<double, rates> now{c.throttle_rate, c.push.x, c.push.y, c.push.z, c.turn.x, c.turn.y, c.turn.z,
        c.look_rad.x * look_rate, c.look_rad.y * look_rate, c.exposure};
    for (std::size_t i = 0; i < rates; ++i) {
        // An axis that is left out, or whose device is unplugged, goes to 0 by itself.
        const bool moved = now[i] != 0 && std::abs(now[i] - resting_[i]) > least_move;
        somebody |= moved;
        if (moved || now[i] == 0)
            resting_[i] = now[i];
    }
    // A throttle's first report says where it stands, and not that it moved.
    if (c.lever && (!lever_ || std::abs(*c.lever - *lever_) > least_move))
        somebody |= std::exchange(lever_, c.lever).has_value();
    else if (!c.lever)
        lever_.reset();
    if (!head_ || moved(c.head, *head_))
        somebody |= std::exchange(head_, c.head).has_value();
    return somebody;
}

} // namespace starbow
