#include "describe_shot.h"

namespace starbow {

void check(const Place& place, const Measure& measure, const Folder&)
{
    const auto at = find_member(place, "at"), relative_to = find_member(place, "relative_to");
    if (has_place(measure.quantity))
        member(place, "at");
    else if (at || relative_to)
        fail_at(at ? *at : *relative_to, "is a place too many: this is measured on the ship alone; none is right");
}

LocalisedText GoalText::read(const Place& place, const Folder&) const
{
    LocalisedText saying = read_saying(place);
    if (!saying.key.empty() && !saying.key.starts_with("goal."))
        fail_at(place, "is not a text; a key of the words that begins with \"goal.\", or { \"en\": \"...\" } is right");
    return saying;
}

Json saying_schema(const std::string& prefix)
{
    Json schema = Json::parse(R"({ "oneOf": [{ "type": "string" },
        { "type": "object", "minProperties": 1, "additionalProperties": { "type": "string", "minLength": 1 } }] })");
    schema["oneOf"][0]["pattern"] = "^" + prefix + "\\.";
    return schema;
}

void check(const Place& place, const GoalCondition& condition, const Folder&)
{
    if (!(condition.from < condition.below))
        fail_at(member(place, "below"), "leaves nothing from " + shown(condition.from) + " on; a greater number is right");
    if (condition.from < any_measured.low && condition.below > any_measured.high)
        fail_at(place, "always holds; \"from\" or \"below\", or both, are right");
}

} // namespace starbow
