#include "tour.h"
#include "measuring.h"
#include "pilot.h"
#include "tour_motion.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double second_ns = 1e9;
/// Intervals at which a stick held aside steps to the next number.
constexpr double first_repeat_s = 0.5, repeat_s = 0.1;
/// A place counts as reached after this time.
constexpr double reached_s = 0.3;

std::int64_t ns(double seconds) { return std::llround(seconds * second_ns); }

const Step& step_of(const Touring& touring, const Show& show) { return show.tour.steps[touring.step()]; }

bool tries(const Step& step) { return std::holds_alternative<Try>(step.motion); }

/// The time limit of a question, or the time of a step without one. Without visitors a question is shorter.
double time_limit_s(const Step& step, bool visitors)
{
    return step.question && !visitors ? std::min(step.seconds, step.question->unattended_s) : step.seconds;
}

/// The step's present duration.
std::int64_t duration_ns(const Touring& now, const Show& show)
{
    const Step& step = step_of(now, show);
    const std::int64_t limit = ns(time_limit_s(step, show.visitors));
    if (!step.question)
        return limit;
    return (now.measured_answer ? now.answered_ns : limit) + ns(step.question->explanation_s);
}

/// The rules for the visitor who flies in this step.
Flying rules_in(const Step& step, const Flying& exhibits)
{
    Flying rules = exhibits;
    if (const Try* tried = std::get_if<Try>(&step.motion)) {
        rules.mode = tried->mode.value_or(rules.mode);
        rules.max_gamma = std::min(rules.max_gamma, tried->max_gamma.value_or(rules.max_gamma));
    }
    return rules;
}

/// Starts the visitor's own flight.
void hand_over(Touring& now, const Flying& rules)
{
    Shot here = shot_of(now.flight.ship);
    const Flight fresh = flight_at(here, rules);
    now.flight.mode = fresh.mode, now.flight.lever = fresh.lever;
    now.flight.coasting = fresh.coasting, now.flight.lever_waits = fresh.lever_waits;
    now.flight.lever_rest.reset(), now.flight.frozen = false;
    now.flight.thrust_inhibited = rapidity_of(now.flight.ship) == 0; // an open throttle then has no effect yet
    now.flight.throttle_rate = 0;
    now.flight.thrust = now.flight.turn_rad_s = now.flight.turn_lead_rad_s = glm::dvec3(0);
    now.flight.homing.reset();
    ++now.flight.leaps.begun;
}

/// Begins the step of the last start, with motion, effects and exposure from `now.flight`. leaps: to there from elsewhere.
void begin(Touring& now, const Show& show, bool leaps)
{
    const Step& step = step_of(now, show);
    Touring::Start& start = now.starts.back();
    if (const Cut* cut = std::get_if<Cut>(&step.motion)) {
        const Ship before = start.flight.ship;
        start.flight.ship = ship_at(cut->shot);
        // The ship's clock and distance go on across a cut.
        start.flight.ship.proper_time = before.proper_time, start.flight.ship.distance = before.distance;
        start.flight.effects = cut->shot.effects;
        start.flight.exposure_ev = step.exposure_ev.value_or(cut->shot.exposure_ev);
        start.since = start.flight.ship;
    }
    if (step.effects)
        start.flight.effects = *step.effects;
    now.into_ns = 0;
    now.chosen = -1, now.right.reset(), now.measured_answer.reset(), now.answered_ns = 0;
    now.nudged = true; // a stick that is still held aside is no answer
    now.nudged_s = -1e9;
    if (step.question)
        if (const auto* set = std::get_if<NumberToSet>(&step.question->answer))
            now.number = set->from;
    const glm::dvec2 look = std::holds_alternative<Cut>(step.motion) ? glm::dvec2(0) : now.flight.look_rad;
    const Flight before = now.flight;
    now.flight = start.flight;
    now.flight.leaps = before.leaps;
    now.flight.leaps.begun += leaps || std::holds_alternative<Cut>(step.motion);
    now.flight.look_rad = look, now.flight.hud = before.hud, now.flight.frozen = false;
    if (tries(step))
        hand_over(now, rules_in(step, show.rules));
}

/// Places the ship by the step's motion after now.into_ns.
void place(Touring& now, const Show& show)
{
    const Step& step = step_of(now, show);
    if (tries(step))
        return;
    const Touring::Start& start = now.starts.back();
    // The motion stops during the explanation, so that the question's subject stays in view.
    const double seconds = double(now.measured_answer ? now.answered_ns : now.into_ns) / second_ns;
    const double part = std::min(1.0, seconds / step.seconds);
    now.flight.ship = along(step, start.flight.ship, part, show.seconds_per_time_unit);
    now.flight.exposure_ev = start.flight.exposure_ev;
    if (step.exposure_ev)
        now.flight.exposure_ev += eased(part) * (*step.exposure_ev - start.flight.exposure_ev);
}

/// leaps: to there before the present step is over
void next(Touring& now, const Show& show, bool leaps)
{
    place(now, show);
    std::size_t to = now.step() + 1;
    while (to < show.tour.steps.size() && !show.visitors && tries(show.tour.steps[to]))
        now.starts.push_back(now.starts.back()), ++to;
    if (to == show.tour.steps.size()) {
        now.over = true;
        now.measured_answer.reset();
        if (show.visitors)
            hand_over(now, show.rules);
        return;
    }
    Touring::Start start{now.flight, now.starts.back().since};
    now.starts.push_back(start);
    begin(now, show, leaps);
}

double number_now(const Touring& now, const Show& show, const Measure& measure)
{
    return measured(measure, now.flight.ship, now.starts.back().since, show.seconds_per_time_unit);
}

/// Shows the explanation from here on. right: the verdict; nullopt: none possible.
void show_answer(Touring& now, const Show& show, std::optional<bool> right)
{
    now.measured_answer = number_now(now, show, step_of(now, show).question->measure);
    now.right = right;
    now.answered_ns = now.into_ns;
}

/// Takes the visitor's answer.
void answer(Touring& now, const Show& show)
{
    const Question& question = *step_of(now, show).question;
    const double value = number_now(now, show, question.measure);
    if (const auto* choices = std::get_if<std::vector<Choice>>(&question.answer)) {
        if (now.chosen >= 0) {
            const Choice& choice = (*choices)[std::size_t(now.chosen)];
            show_answer(now, show, value >= choice.from && value < choice.below);
        }
    } else if (const auto* set = std::get_if<NumberToSet>(&question.answer)) {
        show_answer(now, show, std::abs(value - now.number) <= set->tolerance);
    }
}

/// Moves the choice or the number by one; to the right means more. The last choice is followed by the first one, so that
/// hands with one way to push reach all of them.
void nudge(Touring& now, const Show& show, int by)
{
    const Question& question = *step_of(now, show).question;
    if (const auto* choices = std::get_if<std::vector<Choice>>(&question.answer)) {
        const int count = int(choices->size());
        now.chosen = now.chosen < 0 ? (by > 0 ? 0 : count - 1) : (now.chosen + by + count) % count;
    } else if (const auto* set = std::get_if<NumberToSet>(&question.answer)) {
        now.number = std::clamp(now.number + by * set->step, set->from, set->to);
    }
}

void run_question(Touring& now, const Show& show, const Controls& controls, double dt_s)
{
    const Question& question = *step_of(now, show).question;
    const double aside = -controls.turn.y;
    const int by = aside > 0.5 ? 1 : aside < -0.5 ? -1 : 0;
    if (by == 0)
        now.nudged = false, now.nudged_s = 0;
    else if (!now.nudged)
        nudge(now, show, by), now.nudged = true, now.nudged_s = 0;
    else if ((now.nudged_s += dt_s) > first_repeat_s && std::holds_alternative<NumberToSet>(question.answer))
        nudge(now, show, by), now.nudged_s -= repeat_s;
    constexpr Switch keys[]{Switch::aberration, Switch::doppler, Switch::headlight}; // 1, 2, 3
    if (const auto* choices = std::get_if<std::vector<Choice>>(&question.answer))
        for (int i = 0; i < int(choices->size()); ++i)
            if (controls[keys[i]]) {
                now.chosen = i;
                answer(now, show);
                return;
            }
    if (controls[Switch::stop])
        answer(now, show);
}

/// The visitor flies; the tour's own controls do not reach the ship.
void fly_by_hand(Touring& now, const Show& show, Controls controls, std::int64_t dt_ns, const Flying& rules)
{
    controls.set(Switch::home, controls[Switch::home] && now.over);
    controls.set(Switch::undo, false), controls.set(Switch::reset, false);
    controls.exposure = 0; // the tour itself applies it
    now.flight = step(
        now.flight, controls, dt_ns, rules, show.seconds_per_time_unit, std::get<Cut>(show.tour.steps[0].motion).shot);
}

/// Applies the controls that work at any time. Returns true if they lead to another place in the tour.
bool press(Touring& now, const Show& show, const Controls& controls)
{
    const bool by_hand = flies(now, show);
    now.flight.hud ^= controls[Switch::hud] && !by_hand;
    if (!by_hand) {
        constexpr double half_pi = 1.57079632679489662;
        glm::dvec2& look = now.flight.look_rad;
        look = controls[Switch::look_ahead] ? glm::dvec2(0) : look + controls.look_rad;
        look.y = std::clamp(look.y, -half_pi, half_pi);
    }
    if (controls[Switch::reset]) {
        const Flight before = now.flight;
        now = touring_at(show);
        count_beginning(now.flight, before);
        return true;
    }
    if (controls[Switch::undo] && !now.over) {
        // Soon after a step's beginning, undo leads to the step before.
        if (now.into_ns < ns(2) && now.starts.size() > 1)
            now.starts.pop_back();
        begin(now, show, true);
        now.paused = false;
        return true;
    }
    if (controls[Switch::home] && !now.over) {
        now.paused = false;
        // Skips to the step's end and its final state.
        now.into_ns = std::max(now.into_ns, ns(step_of(now, show).seconds));
        next(now, show, true);
        return true;
    }
    if ((controls[Switch::stop] || controls[Switch::freeze]) && !by_hand
        && !(step_of(now, show).question && !now.measured_answer))
        now.paused = !now.paused;
    return false;
}

/// Ends a visitor's flight to a place, and counts the time in which the place is reached.
void watch(Touring& now, const Show& show, std::int64_t dt_ns)
{
    const Step& step = step_of(now, show);
    if (!step.question || now.measured_answer)
        return;
    const auto& reach = std::get<PlaceToReach>(step.question->answer);
    const double value = number_now(now, show, step.question->measure);
    now.number = value >= reach.from && value <= reach.to ? now.number + double(dt_ns) / second_ns : 0;
    if (now.number > reached_s)
        show_answer(now, show, true);
}

} // namespace

bool asks(const Touring& now, const Show& show)
{
    return !now.over && step_of(now, show).question && !now.measured_answer && !tries(step_of(now, show));
}

bool flies(const Touring& now, const Show& show)
{
    return show.visitors && (now.over || (tries(step_of(now, show)) && !now.measured_answer));
}

double left_s(const Touring& now, const Show& show)
{
    const Step& step = step_of(now, show);
    return std::max(0.0,
        (now.measured_answer ? double(duration_ns(now, show)) / second_ns : step.seconds) - double(now.into_ns) / second_ns);
}

std::string title_of(const Touring& now, const Show& show)
{
    return now.over || double(now.into_ns) > title_s * second_ns ? "" : step_of(now, show).title;
}

double length_s(const Tour& tour)
{
    double sum = 0;
    for (const Step& step : tour.steps)
        if (!tries(step))
            sum += time_limit_s(step, false) + (step.question ? step.question->explanation_s : 0);
    return sum;
}

Touring touring_at(const Show& show)
{
    Touring touring;
    touring.flight.mode = show.rules.mode;
    touring.starts.push_back({touring.flight, touring.flight.ship});
    begin(touring, show, true);
    place(touring, show);
    return touring;
}

Touring advance(Touring now, const Show& show, const Controls& controls, std::int64_t dt_ns)
{
    const double dt_s = double(dt_ns) / second_ns;
    press(now, show, controls);
    now.brighter_ev = std::clamp(now.brighter_ev + controls.exposure * exposure_ev_per_s * dt_s, -30.0, 30.0);
    if (now.over) {
        if (show.visitors)
            fly_by_hand(now, show, controls, dt_ns, show.rules);
        return now;
    }
    if (now.paused)
        return now;
    if (asks(now, show))
        run_question(now, show, controls, dt_s);
    for (std::int64_t left = dt_ns; left > 0 && !now.over;) {
        const Step& step = step_of(now, show);
        // The time runs to the end of the step, or of the time to answer if that is earlier.
        const std::int64_t limit = ns(time_limit_s(step, show.visitors));
        std::int64_t end = duration_ns(now, show);
        if (step.question && !now.measured_answer)
            end = limit;
        const std::int64_t some = std::min(left, std::max<std::int64_t>(0, end - now.into_ns));
        if (flies(now, show)) {
            fly_by_hand(now, show, controls, some, rules_in(step, show.rules));
            watch(now, show, some);
        }
        now.into_ns += some;
        left -= some;
        place(now, show);
        if (now.into_ns < end)
            continue;
        if (step.question && !now.measured_answer)
            show_answer(now, show, {});
        else
            next(now, show, false);
    }
    return now;
}

} // namespace starbow
