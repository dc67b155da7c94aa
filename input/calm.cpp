#include "calm.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// Sums of frames' times that should be whole seconds may lack a bit.
constexpr double rounding_s = 1e-9;

constexpr Switches toggles = switches_where([](const SwitchEntry& one) { return one.leap == Leap::toggle; });
constexpr Switches leaps = switches_where([](const SwitchEntry& one) { return one.leap != Leap::none; });

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

Flying calm_rules(Flying rules)
{
    rules.turn_deg_per_s = std::min(rules.turn_deg_per_s, calm_turn_deg_per_s);
    rules.roll_deg_per_s = std::min(rules.roll_deg_per_s, calm_turn_deg_per_s);
    return rules;
}

void FlashLimiter::hold_leaps(Controls& controls, bool by_steps)
{
    constexpr double nearly_at_rest = 0.5; // a ship that turns by steps rests there
    const bool steps = by_steps && glm::length(controls.turn) > nearly_at_rest;
    Switches& waiting = waiting_;
    waiting = ((waiting ^ controls) & toggles) | ((waiting | controls) & (leaps - toggles));
    bool any = steps || waiting.any();
    for (const auto step : all_steps) {
        waiting_.*step += controls.*step;
        any |= waiting_.*step != 0;
    }
    const bool lets = any && since_leap_s_ >= calm_every_s - rounding_s;
    static_cast<Switches&>(controls) = (controls - leaps) | (lets ? std::exchange(waiting, {}) : Switches());
    for (const auto step : all_steps)
        controls.*step = lets ? std::exchange(waiting_.*step, 0) : 0;
    if (steps && !lets)
        controls.turn = glm::dvec3(0);
    if (lets)
        since_leap_s_ = 0;
}

/// Takes a number's new way. Returns false where it would turn round too early.
bool FlashLimiter::turns(Kept& kept, int way)
{
    if (way == kept.way)
        return true;
    if (kept.way != 0) {
        if (since_turn_s_ < calm_every_s - rounding_s)
            return false;
        since_turn_s_ = 0;
    }
    kept.way = way;
    return true;
}

void FlashLimiter::follow(Kept& kept, double per_s, double band, double dt_s)
{
    if (!kept.value)
        kept.value = kept.wanted;
    const double off = *kept.wanted - *kept.value;
    const int way = sign(off);
    const bool unsteady = way != kept.way && kept.way != 0 && std::abs(off) <= band;
    if (way != 0 && !unsteady && turns(kept, way))
        *kept.value += way * std::min(std::abs(off), per_s * dt_s);
}

Controls FlashLimiter::let_through(Controls controls, double dt_s, bool by_steps)
{
    since_leap_s_ += dt_s, since_turn_s_ += dt_s;
    hold_leaps(controls, by_steps);
    if (glm::dot(controls.head.turned, turned_) < 0) // the same head
        controls.head.turned = -controls.head.turned;
    for (std::size_t i = 0; i < all_channels.size(); ++i) {
        const ChannelEntry& channel = all_channels[i];
        const std::span<double> numbers = channel.of(controls);
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            Kept& kept = kept_[i][n];
            double& number = numbers[n];
            switch (channel.way) {
            case Way::rate:
                if (number != 0 && !turns(kept, sign(number)))
                    number = 0;
                break;
            case Way::place:
                kept.wanted = number;
                follow(kept, channel.per_s, channel.band, dt_s);
                number = *kept.value;
                break;
            case Way::change: {
                // A hand that is faster is followed for a quarter of a second after its rest.
                const double before = kept.value.value_or(0), ahead = 0.25 * channel.per_s;
                kept.wanted = std::clamp(kept.wanted.value_or(0) + number, before - ahead, before + ahead);
                kept.value = before;
                follow(kept, channel.per_s, channel.band, dt_s);
                number = *kept.value - before;
                break;
            }
            case Way::light:
                break;
            }
        }
    }
    controls.head.turned = turned_ = glm::normalize(controls.head.turned);
    return controls;
}

} // namespace starbow
