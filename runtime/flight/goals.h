#pragma once
#include "config/model/goal.h"
#include "ship.h"
#include <cstdint>
#include <span>

namespace starbow {

/// A visitor's way through a world's goals, one after the other.
struct GoalState {
    std::size_t current = 0; ///< index of the requested goal; beyond the last none is requested
    std::int64_t held_ns = 0; ///< its conditions have held for so long
    std::int64_t phase_ns = 0; ///< since the request for it began, or since its reward is shown
    bool reached = false; ///< its reward is shown
};

/// The conditions must hold for so long, so that nobody reaches a goal by flitting past.
constexpr std::int64_t goal_held_ns = 500'000'000;
constexpr std::int64_t reward_ns = 9'000'000'000;

/// True while all of a goal's conditions hold. start: the ship at the visit's start. seconds_per_time_unit: of the scene.
bool holds(const Goal& goal, const Ship& ship, const Ship& start, double seconds_per_time_unit);

/// The state dt_ns nanoseconds of the visitor's later.
GoalState advance(GoalState state, std::span<const Goal> goals, const Ship& ship, const Ship& start,
    double seconds_per_time_unit, std::int64_t dt_ns);

/// The text of now: a reward, or for some seconds of every half minute the goal's request; empty otherwise.
std::string goal_text(const GoalState& state, std::span<const Goal> goals, const Words& words);
/// The same as a line of the display, with a sign for a request or a reward before it.
std::string goal_line(const GoalState& state, std::span<const Goal> goals, const Words& words);

} // namespace starbow
