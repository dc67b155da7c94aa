#include "goal_reader.h"
#include "measure_reader.h"

namespace starbow {
namespace {

Saying read_goal_text(const Place& place)
{
    Saying saying = read_saying(place);
    if (!saying.key.empty() && !saying.key.starts_with("goal."))
        complain(place, "is not a text; a key of the words that begins with \"goal.\", or { \"en\": \"...\" } is right");
    return saying;
}

GoalCondition read_condition(const Place& place)
{
    constexpr Range any_number{-1e12, 1e12};
    reject_unknown_members(place, {"measure", "from", "below"});
    GoalCondition condition{.measure = read_measure(member(place, "measure"))};
    take(place, "from", condition.from, any_number);
    take(place, "below", condition.below, any_number);
    if (!(condition.from < condition.below))
        complain(member(place, "below"), "leaves nothing from " + shown(condition.from) + " on; a greater number is right");
    if (condition.from < -1e12 && condition.below > 1e12)
        complain(place, "always holds; \"from\" or \"below\", or both, are right");
    return condition;
}

} // namespace

std::vector<Goal> read_goals(const Place& place)
{
    std::vector<Goal> goals;
    for (const Place& one : items(place, 0, 20, "goals")) {
        reject_unknown_members(one, {"ask", "reward", "conditions"});
        Goal goal{
            .ask = read_goal_text(member(one, "ask")), .reward = read_goal_text(member(one, "reward")), .conditions = {}};
        for (const Place& condition : items(member(one, "conditions"), 1, 5, "conditions"))
            goal.conditions.push_back(read_condition(condition));
        goals.push_back(std::move(goal));
    }
    return goals;
}

} // namespace starbow
