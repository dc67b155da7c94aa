#include "visit.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

std::int64_t whole_ns(double seconds) { return std::llround(1e9 * seconds); }
double in_seconds(std::int64_t ns) { return 1e-9 * double(ns); }

/// To black takes half of the fade, and back the other half.
std::int64_t to_fade_ns(const Visiting& rules) { return whole_ns(rules.fade_s / 2); }

bool darkens(VisitPhase phase)
{
    return phase == VisitPhase::changing || phase == VisitPhase::entering || phase == VisitPhase::leaving;
}

bool too_long(const Visit& visit, const Visiting& rules)
{
    return rules.longest_s > 0 && visit.visit_ns >= whole_ns(rules.longest_s);
}

void enter(Visit& visit, VisitPhase phase) { visit.phase = phase, visit.phase_ns = 0; }

void attract(Visit& visit, const VisitSigns& signs, bool black, VisitEvents& events)
{
    if (signs.somebody) {
        enter(visit, VisitPhase::entering);
    } else if (visit.phase == VisitPhase::attract && signs.attraction_over) {
        enter(visit, VisitPhase::changing);
    } else if (visit.phase == VisitPhase::changing && black) {
        ++visit.attraction;
        events.shows_attraction = true;
        enter(visit, VisitPhase::attract);
    }
}

void count(Visit& visit, const VisitSigns& signs, std::int64_t dt_ns)
{
    visit.visit_ns += dt_ns;
    visit.idle_ns = signs.somebody || signs.watches ? 0 : visit.idle_ns + dt_ns;
    if (signs.somebody)
        visit.touched_ns = visit.visit_ns;
}

void end(Visit& visit, VisitEvents& events)
{
    events.ends = events.shows_attraction = true;
    events.length_s = in_seconds(visit.touched_ns);
    visit = {.fade_ns = visit.fade_ns};
}

} // namespace

Visit begun(Visit visit) { return {.phase = VisitPhase::flying, .fade_ns = visit.fade_ns, .attraction = visit.attraction}; }

bool in_hand(const Visit& visit) { return visit.phase == VisitPhase::flying || visit.phase == VisitPhase::asking; }

Visit advance(Visit visit, const Visiting& rules, const VisitSigns& signs, std::int64_t dt_ns, VisitEvents& events)
{
    visit.fade_ns = std::clamp(visit.fade_ns + (darkens(visit.phase) ? dt_ns : -dt_ns), std::int64_t(0), to_fade_ns(rules));
    visit.phase_ns += dt_ns;
    const bool black = visit.fade_ns == to_fade_ns(rules);
    switch (visit.phase) {
    case VisitPhase::attract:
    case VisitPhase::changing:
        attract(visit, signs, black, events);
        break;
    case VisitPhase::entering:
        if (black) {
            events.begins = true;
            visit = begun(visit);
        }
        break;
    case VisitPhase::flying:
        count(visit, signs, dt_ns);
        if (too_long(visit, rules))
            enter(visit, VisitPhase::leaving);
        else if (visit.idle_ns >= whole_ns(rules.idle_s))
            enter(visit, rules.ask_s > 0 ? VisitPhase::asking : VisitPhase::leaving);
        break;
    case VisitPhase::asking:
        count(visit, signs, dt_ns);
        if (too_long(visit, rules) || visit.phase_ns >= whole_ns(rules.ask_s))
            enter(visit, VisitPhase::leaving);
        else if (visit.idle_ns == 0)
            enter(visit, VisitPhase::flying);
        break;
    case VisitPhase::leaving:
        count(visit, signs, dt_ns);
        if (visit.idle_ns == 0 && !too_long(visit, rules))
            enter(visit, VisitPhase::flying);
        else if (black)
            end(visit, events);
        break;
    }
    return visit;
}

double fade_of(const Visit& visit, const Visiting& rules)
{
    const std::int64_t whole = to_fade_ns(rules);
    return whole > 0 ? double(visit.fade_ns) / double(whole) : 0;
}

std::optional<double> seconds_left(const Visit& visit, const Visiting& rules)
{
    if (visit.phase == VisitPhase::asking)
        return std::max(0.0, rules.ask_s - in_seconds(visit.phase_ns));
    if (visit.phase == VisitPhase::flying && rules.longest_s > 0)
        if (const double left = rules.longest_s - in_seconds(visit.visit_ns); left <= rules.ask_s)
            return std::max(0.0, left);
    return {};
}

} // namespace starbow
