#include "describe.h"
#include <bit>
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

bool Variation::lacks(const char* name) const { return without && std::string_view(without) == name; }

const Place* described::Members::find(const char* name, bool needed)
{
    now = needed ? member(object, name) : find_member(object, name);
    return now ? &*now : nullptr;
}

void described::reject_others(const Place& place, std::span<const char* const> known, const Variation& as, bool names_schema)
{
    std::vector<std::string_view> names;
    if (as.tag)
        names.emplace_back(as.tag);
    if (names_schema)
        names.emplace_back("$schema");
    for (const char* name : known)
        if (name && !as.lacks(name))
            names.emplace_back(name);
    reject_unknown_members(place, names);
    if (const auto schema = names_schema ? find_member(place, "$schema") : std::nullopt)
        text(*schema);
}

void described::add(
    std::vector<Property>& all, const char* name, const char* says, bool is_needed, Json&& shape, Json&& usual)
{
    all.push_back({name, says, is_needed, std::move(shape), std::move(usual)});
}

Json described::schema_of(const char* name, const char* says, const char* rules, bool names_schema, const Variation& as,
    std::vector<Property> fields)
{
    Json required = Json::array(), properties = Json::object();
    if (as.tag) {
        properties[as.tag] = {{"description", "The kind of this object."}, {"const", name}};
        required.push_back(as.tag);
    }
    if (names_schema)
        properties["$schema"]
            = {{"description", "The path of this schema, for editors."}, {"type", "string"}, {"minLength", 1}};
    for (Property& field : fields) {
        Json& shape = field.shape;
        if (!shape.contains("$ref")) {
            shape["description"] = field.says;
            const Json& usual = field.usual;
            // A number beyond its range stands for none.
            const bool none = field.is_needed || usual.is_null() || usual.empty()
                || (usual.is_string() && usual.get_ref<const std::string&>().empty())
                || (usual.is_number() && shape.contains("maximum")
                    && (usual > shape["maximum"] || (shape.contains("minimum") && usual < shape["minimum"])));
            if (!none)
                shape["default"] = usual;
        }
        properties[field.name] = std::move(shape);
        if (field.is_needed)
            required.push_back(field.name);
    }
    Json schema{{"description", says}, {"type", "object"}, {"additionalProperties", false}};
    if (!required.empty())
        schema["required"] = required;
    schema["properties"] = properties;
    schema.update(Json::parse(rules));
    return schema;
}

Json described::whole_schema(const char* name, const Json& object, const Json& definitions)
{
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", std::string("Starbow ") + name}};
    schema.update(object);
    if (!definitions.empty())
        schema["definitions"] = definitions;
    return schema;
}

Json described::reference(Json& definitions, const char* name, Json (*made)(Json& definitions))
{
    if (!definitions.contains(name)) {
        definitions[name] = nullptr; // in its place, before those inside it
        Json schema = made(definitions);
        definitions[name] = std::move(schema);
    }
    return {{"$ref", std::string("#/definitions/") + name}};
}

bool described::are_same(const Json& a, const Json& b)
{
    if (a.is_number_float() && b.is_number_float())
        return std::bit_cast<std::uint64_t>(a.get<double>()) == std::bit_cast<std::uint64_t>(b.get<double>());
    if (a.is_array() && b.is_array())
        return std::ranges::equal(a, b, are_same);
    return a == b;
}

Json described::list_schema(std::size_t least, std::size_t most, Json item)
{
    return {{"type", "array"}, {"minItems", least}, {"maxItems", most}, {"items", std::move(item)}};
}

Json described::enum_schema(const std::vector<std::string_view>& names) { return {{"enum", names}}; }

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
    return described::list_schema(2, 2, Whole{low, high}.schema(definitions));
}

} // namespace starbow
