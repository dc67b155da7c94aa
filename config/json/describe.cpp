#include "describe.h"
#include <cstdio>

namespace starbow {
namespace {

/// A whole number where it is one, as people write it.
Json plain(double number)
{
    return std::abs(number) < 1e15 && number == std::floor(number) ? Json(std::int64_t(number)) : Json(number);
}

/// The texts in brackets, with a space inside { }.
std::string bracketed(const std::vector<std::string>& texts, char open, char close)
{
    std::string all;
    for (const std::string& text : texts)
        all += (all.empty() ? "" : ", ") + text;
    const char* space = open == '{' && !all.empty() ? " " : "";
    return open + (space + all + space) + close;
}

} // namespace

void described::add_number(std::string& text, double number)
{
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g ", number);
    text += digits;
}

std::string on_one_line(const Json& value)
{
    std::vector<std::string> parts;
    if (value.is_object())
        for (const auto& [name, one] : value.items())
            parts.push_back(Json(name).dump() + ": " + on_one_line(one));
    else if (value.is_array())
        for (const Json& one : value)
            parts.push_back(on_one_line(one));
    if (value.is_structured())
        return value.is_object() ? bracketed(parts, '{', '}') : bracketed(parts, '[', ']');
    return (value.is_number_float() ? plain(value.get<double>()) : value)
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json Number::schema(Json&) const
{
    return {{"type", "number"}, {range.low_open ? "exclusiveMinimum" : "minimum", plain(range.low)},
        {"maximum", plain(range.high)}};
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
