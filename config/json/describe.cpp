#include "describe.h"

namespace starbow {
namespace {

/// A limit as a whole number where it is one, as people write it.
Json limit(double number)
{
    return std::abs(number) < 1e15 && number == std::floor(number) ? Json(std::int64_t(number)) : Json(number);
}

} // namespace

Json Number::schema(Json&) const
{
    return {{"type", "number"}, {range.low_open ? "exclusiveMinimum" : "minimum", limit(range.low)},
        {"maximum", limit(range.high)}};
}

Json Whole::schema(Json&) const { return {{"type", "integer"}, {"minimum", low}, {"maximum", high}}; }
Json Flag::schema(Json&) const { return {{"type", "boolean"}}; }
Json Text::schema(Json&) const
{
    Json schema{{"type", "string"}, {"minLength", 1}};
    if (examples)
        schema["examples"] = Json::parse(examples);
    return schema;
}

glm::ivec2 WholePair::read(const Place& place, const Folder&) const
{
    const std::vector<Place> at = items(place, 2, 2, "whole numbers");
    return {integer(at[0], low, high), integer(at[1], low, high)};
}

Json WholePair::schema(Json& definitions) const
{
    return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", Whole{low, high}.schema(definitions)}};
}

} // namespace starbow
