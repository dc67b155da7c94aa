#include "goals.h"
#include "measuring.h"
#include <algorithm>

namespace starbow {

bool holds(const Goal& goal, const Ship& ship, const Ship& start, double seconds_per_time_unit)
{
    return std::ranges::all_of(goal.conditions, [&](const GoalCondition& condition) {
        const double value = measured(condition.measure, ship, start, seconds_per_time_unit);
        return value >= condition.from && value < condition.below;
    });
}

GoalState advance(GoalState state, std::span<const Goal> goals, const Ship& ship, const Ship& start,
    double seconds_per_time_unit, std::int64_t dt_ns)
{
    if (state.current >= goals.size())
        return state;
    state.phase_ns += dt_ns;
    if (state.reached) {
        if (state.phase_ns > reward_ns)
            state = {.current = state.current + 1};
        return state;
    }
    state.held_ns = holds(goals[state.current], ship, start, seconds_per_time_unit) ? state.held_ns + dt_ns : 0;
    if (state.held_ns >= goal_held_ns)
        state = {.current = state.current, .reached = true};
    return state;
}

std::string goal_text(const GoalState& state, std::span<const Goal> goals, const Words& words)
{
    constexpr std::int64_t turn_ns = 24'000'000'000, rests_ns = 6'000'000'000, requests_until_ns = 16'000'000'000;
    if (state.current >= goals.size())
        return {};
    const Goal& goal = goals[state.current];
    if (state.reached)
        return said(goal.reward, words);
    const std::int64_t at = state.phase_ns % turn_ns; // in between the picture is explained
    return at >= rests_ns && at < requests_until_ns ? said(goal.ask, words) : "";
}

std::string goal_line(const GoalState& state, std::span<const Goal> goals, const Words& words)
{
    const std::string text = goal_text(state, goals, words);
    return text.empty() ? "" : (state.reached ? "★ " : "▸ ") + text;
}

} // namespace starbow
