#include "calm.h"
#include "switches.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// Sums of frames' times that should be whole seconds may lack a bit.
constexpr double rounding_s = 1e-9;

} // namespace

SlowTurns followed(SlowTurns now, double wanted, double dt_s, double per_s, double band)
{
    now.since_turn_s += dt_s;
    if (!now.value) {
        now.value = wanted;
        return now;
    }
    const double off = wanted - *now.value;
    const int way = sign(off);
    if (way == 0)
        return now;
    if (way != now.way) {
        if (now.way != 0 && (std::abs(off) <= band || now.since_turn_s < calm_every_s - rounding_s))
            return now;
        now.way = way;
        now.since_turn_s = 0;
    }
    *now.value += way * std::min(std::abs(off), per_s * dt_s);
    return now;
}

SlowTurns calmed_ev(const SlowTurns& now, double wanted_ev, double dt_s)
{
    constexpr double ev_per_s = 6; // as fast as eyes adapt to a view that is brighter by some stops
    constexpr double ev_band = 0.05; // 3.5 % of the light
    return followed(now, wanted_ev, dt_s, ev_per_s, ev_band);
}

Controls CalmHands::let_through(Controls controls, double dt_s)
{
    since_leap_s_ += dt_s;
    bool any = false;
    for (const auto& [name, pressed, leap] : all_switches) {
        if (leap == Leap::none)
            continue;
        bool& waits = waiting_.*pressed;
        waits = leap == Leap::toggle ? waits != controls.*pressed : waits || controls.*pressed;
        any |= waits;
    }
    const bool lets = any && since_leap_s_ >= calm_every_s - rounding_s;
    for (const auto& [name, pressed, leap] : all_switches)
        if (leap != Leap::none)
            controls.*pressed = lets && std::exchange(waiting_.*pressed, false);
    if (lets)
        since_leap_s_ = 0;

    constexpr double lever_per_s = 4, lever_band = 0.02; // a hand's, and a worn sensor's
    if (controls.lever)
        controls.lever = (lever_ = followed(lever_, *controls.lever, dt_s, lever_per_s, lever_band)).value;
    since_throttle_s_ += dt_s;
    if (const int way = sign(controls.throttle_rate); way != 0 && way != throttle_way_) {
        if (throttle_way_ != 0 && since_throttle_s_ < calm_every_s - rounding_s)
            controls.throttle_rate = 0;
        else
            throttle_way_ = way, since_throttle_s_ = 0;
    }
    return controls;
}

} // namespace starbow
