#include "attendance.h"
#include <algorithm>

namespace starbow {

VisitEvents Attendance::advance(const VisitSigns& signs, std::int64_t dt_ns)
{
    VisitEvents events;
    visit_ = starbow::advance(visit_, rules_, signs, dt_ns, events);
    visited_s_ += knows_visitor() ? 1e-9 * double(dt_ns) : 0;
    goes_home_ &= !events.ends;
    return events;
}

void Attendance::wait_for_throttle(const Controls& hands, bool rests, Requests& requests)
{
    if (rests && hands.lever.value_or(0) > lever_touched)
        requests.set(Switch::stop);
}

Requests Attendance::lead_home(const FlightSource& source, const Controls& hands, bool rests, double dt_s)
{
    constexpr double longest_flown_s = 5;
    Requests requests;
    const std::optional<Homing>& homing = source.flight().homing;
    if (hands[Switch::home] && !source.tour() && !homing && !source.is_near_home(longest_flown_s)) {
        requests.set(Switch::home, false);
        goes_home_ = true;
    }
    // From the world's end the way leads backwards, and nothing is seen: it is left out, once the ship has slowed down.
    goes_home_ |= homing && homing->from_boundary && homing->leg == HomingLeg::way;
    if (!goes_home_ && home_fade_ == 1) {
        wait_for_throttle(hands, rests, requests);
        if (hands.throttle_rate > 0) // a key that is still held, too
            requests.set(Switch::stop);
    }
    const double half_s = std::max(rules_.fade_s / 2, 1e-3);
    home_fade_ = std::clamp(home_fade_ + (goes_home_ ? dt_s : -dt_s) / half_s, 0.0, 1.0);
    if (goes_home_ && home_fade_ == 1) {
        requests.set(Switch::reset);
        goes_home_ = false;
    }
    return requests;
}

} // namespace starbow
