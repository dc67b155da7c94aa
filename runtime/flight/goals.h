#pragma once
#include "config/model/goal.h"
#include "ship.h"
#include <cstdint>
#include <span>

namespace starbow {

/// A visitor's way through a world's goals, one after the other.
struct GoalState {
    std::size_t current = 0; ///< index of the goal that is asked for; beyond the last there is none
    std::int64_t held_ns = 0; ///< its conditions have held for so long
    std::int64_t asked_ns = 0; ///< it has been asked for, or its reward shown, for so long
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

/// The line to show now: a reward, or for some seconds of every half minute the goal; empty otherwise.
std::string goal_line(const GoalState& state, std::span<const Goal> goals, const Words& words);

} // namespace starbow
