#include "schemas.h"
#include "describe_exhibit.h"
#include "describe_layout.h"
#include "describe_profile.h"
#include "describe_programme.h"
#include "describe_quality.h"
#include "describe_scene.h"
#include "describe_tour.h"
#include <algorithm>

namespace starbow {
namespace {

template <class... Files> std::vector<std::pair<std::string_view, Json (*)()>> all()
{
    return {{description<Files>.name, file_schema<Files>}...};
}
const std::vector<std::pair<std::string_view, Json (*)()>>& schemas()
{
    static const auto known = all<Exhibit, Layout, Profile, Programme, Quality, Ladder, SceneFile, Shot, Tour>();
    return known;
}

/// A text in lines of at most 100 letters, each after some spaces.
std::string wrapped(const std::string& text, std::size_t indent)
{
    std::string lines, line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        if (!line.empty() && indent + line.size() + 1 + end - at > 100) {
            lines += std::string(indent, ' ') + line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + text.substr(at, end - at);
        at = end + 1;
    }
    return lines + std::string(indent, ' ') + line + "\n";
}

/// The values that a schema allows: "a number from 0 to 1", "row or cross", "see stereo".
std::string values_of(const Json& schema)
{
    const auto all = [](const Json& list, const auto& name) {
        std::string text;
        for (std::size_t i = 0; i < list.size(); ++i)
            text += (i == 0 ? "" : i + 1 == list.size() ? " or " : ", ") + name(list[i]);
        return text;
    };
    if (schema.contains("$ref"))
        return "see " + schema["$ref"].get<std::string>().substr(std::string_view("#/definitions/").size());
    if (schema.contains("const"))
        return schema["const"].get<std::string>();
    if (schema.contains("enum"))
        return all(
            schema["enum"], [](const Json& one) { return one.is_string() ? one.get<std::string>() : on_one_line(one); });
    for (const char* choice : {"oneOf", "anyOf"})
        if (schema.contains(choice) && !schema.contains("properties"))
            return all(schema[choice], values_of);
    const std::string type = schema.value("type", "object");
    if (type == "boolean")
        return "true or false";
    if (type == "string")
        return "a text";
    if (type == "object") {
        std::string names;
        if (schema.contains("properties"))
            for (const auto& [name, member] : schema["properties"].items())
                names += (names.empty() ? "" : ", ") + name;
        return names.empty() ? "an object" : "{ " + names + " }";
    }
    if (type == "array") {
        const std::size_t least = schema.value("minItems", std::size_t(0)), most = schema.value("maxItems", least);
        const Json& item = schema["items"];
        return "[ " + std::to_string(least) + (least == most ? "" : " to " + std::to_string(most)) + ": "
            + (item.is_array() ? all(item, values_of) : values_of(item)) + " ]";
    }
    const std::string kind = type == "integer" ? "a whole number" : "a number";
    if (schema.contains("exclusiveMaximum"))
        return kind + " from " + on_one_line(schema["minimum"]) + " to below " + on_one_line(schema["exclusiveMaximum"]);
    if (!schema.contains("maximum"))
        return kind;
    return kind
        + (schema.contains("exclusiveMinimum") ? " above " + on_one_line(schema["exclusiveMinimum"]) + " up to "
                                               : " from " + on_one_line(schema["minimum"]) + " to ")
        + on_one_line(schema["maximum"]);
}

std::string members_of(const Json& object)
{
    std::string text;
    for (const auto& [name, member] : object["properties"].items()) {
        if (name == "$schema" || (name == "type" && member.contains("const")))
            continue;
        const Json needed = object.value("required", Json::array());
        const bool must = std::find(needed.begin(), needed.end(), name) != needed.end();
        text += wrapped(name + ": " + values_of(member) + (must ? "; must be there" : "")
                + (member.contains("default") ? "; usual: " + on_one_line(member["default"]) : ""),
            2);
        if (member.contains("description"))
            text += wrapped(member["description"], 6);
    }
    return text;
}

} // namespace

std::vector<std::string> kinds_with_schema()
{
    std::vector<std::string> names;
    for (const auto& [name, schema] : schemas())
        names.emplace_back(name);
    return names;
}

namespace {

Json schema_of(const std::string& kind)
{
    return schemas()[index_named(kind, names_of(schemas()), "kind of file")].second();
}

} // namespace

std::string schema_text(const std::string& kind) { return schema_of(kind).dump(4) + "\n"; }

std::string members_text(const std::string& kind)
{
    const Json schema = schema_of(kind);
    std::string text = wrapped(schema["description"], 0) + members_of(schema);
    if (schema.contains("definitions"))
        for (const auto& [name, part] : schema["definitions"].items()) {
            const bool tagged = part["properties"].contains("type") && part["properties"]["type"].contains("const");
            text += "\n"
                + wrapped(name + (tagged ? " (type " + name + "): " : ": ") + part["description"].get<std::string>(), 0)
                + members_of(part);
        }
    return text;
}

} // namespace starbow
