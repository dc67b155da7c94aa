#include "shown_light.h"
#include <cmath>
#include <utility>

namespace starbow {

/// Dims a calm exhibit's picture where it would flash.
void ShownLight::guard(RecordEntry& entry, const LightInputs& now)
{
    if (now.replays) {
        light_ = entry.light;
        return;
    }
    const double gain = std::exp2(ev_);
    const auto shown
        = [&](double luminance) { return gain * (curve() ? std::exp2(curve()->at(std::log2(luminance))) : luminance); };
    flash_guard_.take(now.metered.surfaces, now.metered.across, shown, now.dt_s);
    entry.light = light_ = flash_guard_.light();
}

/// Adapts at once where the picture has leapt. Returns true if it has: the metered light then belongs to another picture.
bool ShownLight::follow_leap(const FlightSource& source)
{
    const Leaps leaps = source.flight().leaps;
    const std::optional<Leaps> before = std::exchange(leaps_, leaps);
    if (before == leaps)
        return false;
    if (before && before->begun == leaps.begun) {
        exposure_.leapt = true;
        return true;
    }
    exposure_ = {}, calm_ev_ = {};
    begun_ev_ = source.begun_ev();
    range_.follows_at_once = true;
    return true;
}

/// Steps the curve that shows everything at once. The record's entry holds the view's numbers that it follows.
void ShownLight::follow_range(RecordEntry& entry, const LightInputs& now, const Metered& metered)
{
    if (!now.range || filtered_) {
        range_ = {};
        return;
    }
    const bool locked = exposure_.locked;
    if (!now.replays && (!locked || !range_.wanted) && wants_goal(range_, now.dt_s))
        entry.range_goal
            = range_goal(metered.surfaces, metered.stars, now.source.shown_ev(exposure_, rules_) - now.source.visitors_ev());
    range_ = starbow::advance(std::move(range_), entry.range_goal, now.dt_s, locked);
}

double ShownLight::wanted_ev(const LightInputs& now) const
{
    if (curve())
        return now.source.visitors_ev() + now.directed_ev;
    Exposure eye = exposure_;
    Exposing rules = rules_;
    if (filtered_) // whatever the start's exposure says
        eye.offset_ev = 0, rules.automatic = true;
    return now.source.shown_ev(eye, rules) + now.directed_ev;
}

/// Limits the turns of a calm exhibit's exposure and of its way to black.
void ShownLight::keep_calm(const LightInputs& now)
{
    constexpr double fade_per_s = 2; // the fastest way to black and back, its part in a second
    calm_fade_ = followed(calm_fade_, fade_, now.dt_s, fade_per_s, 0);
    fade_ = *calm_fade_.value;
    SlowTurns before = std::exchange(calm_ev_, {});
    const bool ranged = curve().has_value();
    if (std::exchange(calm_range_, ranged) != ranged)
        before = {}; // a leap, as each switch is
    // A tour shows its own exposures; the first view of a world is exposed at once.
    if ((exposure_.ev || !rules_.automatic) && now.source.by_hand())
        calm_ev_ = calmed_ev(before, ev_, now.dt_s);
    ev_ = calm_ev_.value.value_or(ev_);
}

void ShownLight::advance(RecordEntry& entry, const LightInputs& now)
{
    if (rules_.calm)
        guard(entry, now);
    leapt_ = follow_leap(now.source);
    Metered metered = leapt_ ? Metered() : now.metered;
    filtered_ = now.filter && now.source.by_hand(); // a tour shows its own exposures
    if (filtered_ && exposure_.ev) // the first view of a world sets the exposure's offset
        metered.ev = filtered_ev(metered.surfaces, metered.stars);
    exposure_.locked ^= now.locks;
    exposure_ = now.replays ? adapted_to(exposure_, entry.exposure_ev, rules_, begun_ev_)
                            : adapted(exposure_, metered.ev, now.dt_s, rules_, begun_ev_);
    entry.exposure_ev = exposure_.ev;
    follow_range(entry, now, metered);
    fade_ = now.fade;
    ev_ = wanted_ev(now);
    if (rules_.calm)
        keep_calm(now);
}

} // namespace starbow
