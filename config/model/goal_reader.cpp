#include "goal_reader.h"
#include "measure_reader.h"
#include "words.h"

namespace starbow {
namespace {

Saying read_saying(const Place& place)
{
    if (place.json->is_string()) {
        const std::string key = text(place);
        if (!key.starts_with("goal."))
            complain(place, "is no text; a key of the words that begins with \"goal.\", or { \"en\": \"...\" } is right");
        return {.key = key, .texts = {}};
    }
    if (!place.json->is_object() || place.json->empty())
        complain(place, "is no text; a key of the words that begins with \"goal.\", or { \"en\": \"...\" } is right");
    Saying saying;
    for (const auto& [language, value] : place.json->items())
        saying.texts[language] = text(member(place, language));
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
        complain(place, "holds always; \"from\" or \"below\", or both, are right");
    return condition;
}

} // namespace

std::string said(const Saying& saying, const Words& words)
{
    if (!saying.key.empty()) {
        const auto found = words.texts.find(saying.key);
        return found == words.texts.end() ? saying.key : found->second;
    }
    for (const std::string& language : {words.language, std::string("en")})
        if (const auto found = saying.texts.find(language); found != saying.texts.end())
            return found->second;
    return saying.texts.empty() ? "" : saying.texts.begin()->second;
}

std::vector<Goal> read_goals(const Place& place)
{
    std::vector<Goal> goals;
    for (const Place& one : items(place, 0, 20, "goals")) {
        reject_unknown_members(one, {"ask", "reward", "conditions"});
        Goal goal{.ask = read_saying(member(one, "ask")), .reward = read_saying(member(one, "reward")), .conditions = {}};
        for (const Place& condition : items(member(one, "conditions"), 1, 5, "conditions"))
            goal.conditions.push_back(read_condition(condition));
        goals.push_back(std::move(goal));
    }
    return goals;
}

} // namespace starbow
