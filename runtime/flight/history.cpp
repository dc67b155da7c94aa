#include "history.h"

namespace starbow {

void History::keep(const Flight& flight)
{
    if (flight.homing || flight.frozen) // an undo must not lead back into homing, nor count the time that stood still
        return;
    if (!kept_.empty() && flight.ticks - kept_.back().ticks < history_every_ticks)
        return;
    kept_.push_back(flight);
    // Twice the time, so that a second undo leads further back.
    while (kept_.size() > 2 && flight.ticks - kept_[1].ticks >= 2 * history_ticks)
        kept_.pop_front();
}

Flight History::back(const Flight& now)
{
    if (kept_.empty())
        return now;
    while (kept_.size() > 1 && now.ticks - kept_.back().ticks < history_ticks)
        kept_.pop_back();
    Flight then = kept_.back();
    // Time goes on: the next kept state is ten seconds away.
    for (Flight& flight : kept_)
        flight.ticks += now.ticks - then.ticks;
    then.mode = now.mode;
    then.effects = now.effects;
    then.exposure_ev = now.exposure_ev;
    then.hud = now.hud;
    then.frozen = now.frozen, then.time_scale = now.time_scale;
    then.ticks = now.ticks, then.left_ns = now.left_ns;
    then.vignette = now.vignette;
    then.homing.reset();
    then.leaps = now.leaps;
    ++then.leaps.within;
    return then;
}

Flight flown(const Flight& flight, History& history, const Controls& controls, std::int64_t dt_ns, const Flying& rules,
    double seconds_per_time_unit, const Shot& start)
{
    const Flight now
        = step(controls[Switch::undo] ? history.back(flight) : flight, controls, dt_ns, rules, seconds_per_time_unit, start);
    history.keep(now);
    return now;
}

} // namespace starbow
