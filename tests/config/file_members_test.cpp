// Every member of every kind of file: the reader and a validator of the editors' schemas refuse the same wrong values of it.
#include "config/model/exhibit_file.h"
#include "config/model/layout.h"
#include "config/model/profile.h"
#include "config/model/programme_file.h"
#include "config/model/quality.h"
#include "config/model/scene_file.h"
#include "config/model/schemas.h"
#include "config/model/shot.h"
#include "config/model/tour_file.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

namespace file_members_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;
using Pointer = json::json_pointer;

namespace {

std::filesystem::path shipped_shot(const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); }

/// The reader of each kind of file, and the folder of such files.
struct Kind {
    const char* folder;
    void (*load)(const std::filesystem::path& file);
};

const std::map<std::string, Kind>& kinds()
{
    static const std::map<std::string, Kind> all{
        {"exhibit", {"exhibits", [](const auto& file) { load_exhibit(file); }}},
        {"ladder", {"qualities", [](const auto& file) { load_ladder(file); }}},
        {"layout", {"layouts", [](const auto& file) { load_layout(file); }}},
        {"profile", {"profiles", [](const auto& file) { load_profile(file); }}},
        {"programme", {"programmes", [](const auto& file) { load_programme(file); }}},
        {"quality", {"qualities", [](const auto& file) { load_quality(file); }}},
        {"scene", {"scenes", [](const auto& file) { load_scene_file(file); }}},
        {"shot", {"shots", [](const auto& file) { load_shot(file); }}},
        {"tour", {"tours", [](const auto& file) { load_tour(file, words(), shipped_shot); }}},
    };
    return all;
}

json parsed(const std::string& text) { return json::parse(text, nullptr, true, true); }

/// A copy of the folder of a kind's files, with links to the folders beside it.
std::filesystem::path folder_of(const std::string& kind)
{
    const std::filesystem::path tree = scratch("members-" + kind), folder = tree / "config" / kinds().at(kind).folder;
    if (std::filesystem::exists(folder))
        return folder;
    std::filesystem::create_directories(tree / "config");
    std::filesystem::create_symlink(source_dir() / "scenes", tree / "scenes");
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "config"))
        if (entry.path().filename() != kinds().at(kind).folder)
            std::filesystem::create_symlink(entry.path(), tree / "config" / entry.path().filename());
    std::filesystem::copy(
        source_dir() / "config" / kinds().at(kind).folder, folder, std::filesystem::copy_options::recursive);
    for (const char* file : {"left.data", "f.csv", "m.png"})
        write_bytes(folder / file, "x");
    return folder;
}

/// The reader's message without the file's name and line, or "" where it takes the file.
std::string message_for(const std::string& kind, const json& content)
{
    const std::filesystem::path file = folder_of(kind) / "changed.json";
    write_bytes(file, content.dump());
    try {
        kinds().at(kind).load(file);
        return "";
    } catch (const InputError& error) {
        return line_and_rest(error.what(), file).second;
    }
}

/// A schema, whose nodes are named by their place in it.
class Schema {
public:
    explicit Schema(const std::string& kind)
        : all_(json::parse(schema_text(kind)))
    {
    }

    const json& at(const std::string& place) const { return all_.at(Pointer(place)); }

    /// The place that a place refers to.
    std::string resolved(const std::string& place) const
    {
        const json& node = at(place);
        return node.contains("$ref") ? node.at("$ref").get<std::string>().substr(1) : place;
    }

    /// The places of the values of several kinds that a place takes, or none.
    std::vector<std::string> alternatives(const std::string& place) const
    {
        std::vector<std::string> all;
        for (const char* choice : {"oneOf", "anyOf"})
            if (at(place).contains(choice) && !at(place).contains("properties"))
                for (std::size_t i = 0; i < at(place).at(choice).size(); ++i)
                    all.push_back(resolved(place + "/" + choice + "/" + std::to_string(i)));
        return all;
    }

    /// The place that describes a value: that of the alternative which has its type.
    std::string of(std::string place, const json& value) const
    {
        place = resolved(place);
        for (const std::string& one : alternatives(place))
            if (is_like(at(one), value))
                return of(one, value);
        return place;
    }

    /// The places of all members, but those that a condition names again.
    std::set<std::string> members(const std::string& place = "") const
    {
        static const std::set<std::string> conditions{"if", "then", "else", "not", "allOf", "dependencies"};
        std::set<std::string> found;
        if (!at(place).is_structured())
            return found;
        for (const auto& [name, child] : at(place).items())
            if (!conditions.contains(name) && name != "default" && name != "examples")
                found.merge(members(place + "/" + (at(place).is_array() ? name : escaped(name))));
        if (at(place).is_object() && at(place).contains("properties") && at(place).value("type", "") == "object")
            for (const auto& [name, child] : at(place).at("properties").items())
                found.insert(place + "/properties/" + escaped(name));
        return found;
    }

    /// A name as a part of a place.
    static std::string escaped(const std::string& name) { return (Pointer() / name).to_string().substr(1); }

private:
    static bool is_like(const json& node, const json& value)
    {
        if (value.is_object() && node.contains("properties") && node.at("properties").contains("type"))
            return value.contains("type") && node.at("properties").at("type").value("const", json()) == value.at("type");
        const std::string type = node.value("type", "");
        return type == "object" ? value.is_object()
            : type == "array"   ? value.is_array()
            : type == "string"  ? value.is_string()
            : type == "boolean" ? value.is_boolean()
                                : value.is_number();
    }

    json all_;
};

/// The name of the member that a place describes.
std::string name_of(const std::string& place) { return Pointer(place).back(); }

/// An object in a file: the file's content and the place in it.
struct Object {
    std::shared_ptr<const json> content;
    Pointer at;
};

/// The objects of a kind's files by the places that describe them, and for each member's place an object that has it or that
/// could have it.
struct Found {
    std::map<std::string, Object> objects, members;
};

/// The plainest value that a node takes, rules between members apart.
json plainest(const Schema& schema, const std::string& place)
{
    const std::string at = schema.resolved(place);
    const json& node = schema.at(at);
    for (const char* given : {"default", "const"})
        if (node.contains(given))
            return node.at(given);
    if (node.contains("enum"))
        return node.at("enum").front();
    if (const std::vector<std::string> all = schema.alternatives(at); !all.empty())
        return plainest(schema, all.front());
    const std::string type = node.value("type", "object");
    if (type == "boolean")
        return false;
    if (type == "string")
        return "x";
    if (type == "array") {
        json list = json::array();
        for (std::size_t i = 0; i < std::max(node.value("minItems", std::size_t(1)), std::size_t(1)); ++i)
            list.push_back(plainest(schema, at + "/items" + (node.at("items").is_array() ? "/" + std::to_string(i) : "")));
        return list;
    }
    if (type == "object") {
        json object = json::object();
        for (const json& name : node.value("required", json::array()))
            object[name.get<std::string>()] = plainest(schema, at + "/properties/" + name.get<std::string>());
        return object;
    }
    return node.contains("minimum") ? node.at("minimum") : node.value("maximum", json(1));
}

/// Adds a value's objects and their members.
void add_value(const Schema& schema, const std::string& node, const Object& there, Found& found)
{
    const json& value = there.content->at(there.at);
    const std::string place = schema.of(node, value);
    const json& described = schema.at(place);
    if (value.is_array() && described.contains("items"))
        for (std::size_t i = 0; i < value.size(); ++i)
            add_value(schema, place + "/items" + (described.at("items").is_array() ? "/" + std::to_string(i) : ""),
                {there.content, there.at / i}, found);
    if (!value.is_object())
        return;
    if (described.contains("properties"))
        found.objects.try_emplace(place, there);
    for (const auto& [name, member] : value.items()) {
        std::string at = place + "/additionalProperties";
        if (described.contains("properties") && described.at("properties").contains(name))
            found.members.try_emplace(at = place + "/properties/" + Schema::escaped(name), there);
        else if (!described.contains("additionalProperties") || !described.at("additionalProperties").is_object())
            continue;
        add_value(schema, at, {there.content, there.at / name}, found);
    }
}

/// Adds the members that no file has, each in an object that is stripped to its required members, for some exclude others;
/// and the objects that no file has where a member takes one of several.
void add_absent(const Schema& schema, Found& found)
{
    const auto add = [&](const std::string& member, const Object& in, json object, const std::string& value) {
        json content = *in.content;
        object[name_of(member)] = plainest(schema, value);
        content.at(in.at) = object;
        const Object with{std::make_shared<json>(content), in.at};
        found.members.try_emplace(member, with);
        add_value(schema, member, {with.content, with.at / name_of(member)}, found);
    };
    for (std::size_t before = 0; before != found.members.size();) {
        before = found.members.size();
        for (const auto& [place, object] : std::map<std::string, Object>(found.objects))
            for (const auto& [name, property] : schema.at(place).at("properties").items()) {
                const std::string member = place + "/properties/" + Schema::escaped(name);
                if (found.members.contains(member))
                    continue;
                const json& there = object.content->at(object.at);
                json stripped = json::object();
                for (const std::string needed : schema.at(place).value("required", json::array()))
                    stripped[needed] = there.contains(needed)
                        ? there.at(needed)
                        : plainest(schema, place + "/properties/" + Schema::escaped(needed));
                add(member, object, stripped, member);
            }
        for (const auto& [member, object] : std::map<std::string, Object>(found.members))
            for (const std::string& alternative : schema.alternatives(schema.resolved(member)))
                if (schema.at(alternative).contains("properties") && !found.objects.contains(alternative))
                    add(member, object, object.content->at(object.at), alternative);
    }
}

/// A value that a node refuses, and parts of the reader's message.
struct Wrong {
    json value;
    std::vector<std::string> words;
};

std::vector<Wrong> wrong_numbers(const json& node, bool of_physics)
{
    const bool whole = node.at("type") == "integer";
    std::vector<Wrong> wrong{{"x", {whole ? "is not a" : "is not a number"}}};
    if (whole)
        wrong.push_back({node.value("minimum", 0) + 0.5, {"is not a whole number"}});
    const auto limit = [&](const std::string& side, int step, const std::string& words) {
        std::string open = "exclusive" + side;
        open[9] = char(std::toupper(open[9]));
        const bool outside = node.contains(open); // the limit itself is outside
        if (!outside && !node.contains(side))
            return;
        const json& at = node.at(outside ? open : side);
        json value = at;
        if (!outside && whole)
            value = at.get<std::int64_t>() + step;
        else if (!outside)
            value = at.get<double>() + step * 1e-6 * std::max(std::abs(at.get<double>()), 1e-3);
        wrong.push_back({value, {}});
        if (!of_physics)
            wrong.back().words = {words, " " + shown(at.get<double>())};
    };
    limit("minimum", -1, "is too small");
    limit("maximum", 1, "is too large");
    return wrong;
}

std::vector<Wrong> wrong_values(const Schema& schema, const std::string& place)
{
    const std::string at = schema.resolved(place);
    const json& node = schema.at(at);
    if (node.contains("enum")) {
        std::vector<std::string> choices;
        for (const json& choice : node.at("enum"))
            choices.push_back(choice.dump());
        return {{"?", choices}};
    }
    const std::string type = node.value("type", "");
    if (type == "boolean")
        return {{1, {"is neither true nor false"}}};
    if (type == "string")
        return {{5, {}}};
    if (type == "object")
        return {{true, {"is not an object"}}};
    if (type == "number" || type == "integer") // the limits of a velocity have words of physics
        return wrong_numbers(node, place.ends_with("/beta") || place.ends_with("/gamma"));
    if (type != "array") // one of several kinds of value
        return {{true, {}}};
    std::vector<Wrong> wrong{{true, {}}};
    const bool each_its_own = node.at("items").is_array();
    const std::size_t least = node.value("minItems", std::size_t(0));
    if (least > 0)
        wrong.push_back({json::array(), {"has length 0"}});
    if (node.contains("maxItems")) {
        json list = plainest(schema, at);
        while (list.size() <= node.at("maxItems").get<std::size_t>())
            list.push_back(list.front());
        wrong.push_back({list, {"has length"}});
    }
    for (std::size_t i = 0; i < (each_its_own ? node.at("items").size() : 1); ++i)
        for (const Wrong& one : wrong_values(schema, at + "/items" + (each_its_own ? "/" + std::to_string(i) : ""))) {
            json list = plainest(schema, at);
            list[i] = one.value;
            wrong.push_back({list, one.words});
        }
    return wrong;
}

/// Files that have what no shipped file has.
std::vector<std::string> further_files(const std::string& kind)
{
    const auto layout = [](const std::string& members) {
        return R"({ "outputs": [{ "name": "a", "viewports": [{ )" + members + " }] }] }";
    };
    if (kind == "layout")
        return {layout(R"("warp": { "file": "left.data" }, "observer": { "beta": 0, "direction": [0, 0, -1] })"),
            layout(R"("projection": { "type": "planar", "fov_x_deg": 80, "fov_y_deg": 60 })"),
            layout(R"("projection": { "type": "mirror", "projector_m": [0, 0.5, -2], "mirror_m": [0, 0.5, -2.8],
                "projector": { "fov_x_deg": 40, "fov_y_deg": 30 }, "mirror_radius_m": 0.3, "dome_radius_m": 3 })"),
            layout(R"("projection": { "type": "planar", "sides_deg": { "left": -9, "right": 9, "down": -9, "up": 9 } })")};
    if (kind == "exhibit")
        return {R"({ "layout": "desk", "remote": { "port": 8080, "osc": { "port": 9000, "from": ["127.0.0.1"] } } })"};
    if (kind == "tour")
        return {R"({ "scene": "avenue", "steps": [{ "seconds": 1, "question": { "ask": { "en": "?" },
            "explanation": { "en": "!" }, "choices": [{ "say": { "en": "one" } }] } }] })"};
    return {};
}

Found found_in(const std::string& kind, const Schema& schema)
{
    Found found;
    const auto add = [&](const json& content) {
        add_value(schema, "", {std::make_shared<json>(content), Pointer()}, found);
    };
    for (const auto& file : shipped(std::string("config/") + kinds().at(kind).folder))
        if (const json content = parsed(read_text(file)); content.at("$schema") == "../schema/" + kind + ".schema.json")
            add(content);
    for (const std::string& text : further_files(kind))
        add(parsed(text));
    add_absent(schema, found);
    return found;
}

} // namespace

TEST(FileMembers, EveryKindHasItsReader)
{
    std::set<std::string> named;
    for (const auto& [kind, reader] : kinds())
        named.insert(kind);
    const std::vector<std::string> all = kinds_with_schema();
    EXPECT_EQ(named, std::set<std::string>(all.begin(), all.end()));
}

TEST(FileMembers, EveryMemberStandsInAFileHere)
{
    for (const auto& [kind, reader] : kinds()) {
        const Schema schema(kind);
        const Found found = found_in(kind, schema);
        for (const std::string& place : schema.members())
            EXPECT_TRUE(found.members.contains(place)) << kind << ": " << place;
    }
}

TEST(FileMembers, WrongValuesAreRefusedByReaderAndSchema)
{
    int tried = 0;
    for (const auto& [kind, reader] : kinds()) {
        const Schema schema(kind);
        for (const auto& [place, object] : found_in(kind, schema).members)
            for (const Wrong& wrong : wrong_values(schema, place)) {
                const Pointer at = object.at / name_of(place);
                SCOPED_TRACE(kind + at.to_string() + " = " + wrong.value.dump());
                json changed = *object.content;
                changed[at] = wrong.value;
                const std::string message = message_for(kind, changed);
                EXPECT_TRUE(message.starts_with(at.to_string())) << message;
                for (const std::string& part : wrong.words)
                    EXPECT_NE(message.find(part), std::string::npos) << message;
                EXPECT_FALSE(schema_accepts(kind, changed));
                ++tried;
            }
    }
    EXPECT_GT(tried, 900);
}

TEST(FileMembers, DefaultsAreTaken)
{
    int tried = 0;
    for (const auto& [kind, reader] : kinds()) {
        const Schema schema(kind);
        for (const auto& [place, object] : found_in(kind, schema).members)
            if (const json& node = schema.at(schema.resolved(place)); node.contains("default")) {
                const Pointer at = object.at / name_of(place);
                SCOPED_TRACE(kind + at.to_string());
                json changed = *object.content;
                changed[at] = node.at("default");
                // A rule between members may refuse it; a rule of the member itself may not.
                EXPECT_EQ(message_for(kind, changed).find(" is too "), std::string::npos) << message_for(kind, changed);
                EXPECT_EQ(message_for(kind, changed).find(" is not "), std::string::npos) << message_for(kind, changed);
                ++tried;
            }
    }
    EXPECT_GT(tried, 100);
}

/// Candidates are the names of all members of the kind, so that an object knows no name of another.
TEST(FileMembers, ReaderAndSchemaKnowTheSameNames)
{
    for (const auto& [kind, reader] : kinds()) {
        const Schema schema(kind);
        const Found found = found_in(kind, schema);
        std::set<std::string> names{"nonsense"};
        for (const auto& [place, object] : found.members)
            names.insert(name_of(place));
        for (const auto& [place, object] : found.objects) {
            const json& described = schema.at(place);
            EXPECT_EQ(described.at("additionalProperties"), false) << kind << place;
            for (const std::string& name : names) {
                SCOPED_TRACE(kind + place + ": " + name);
                json changed = *object.content;
                changed[object.at / name] = nullptr;
                const bool known = message_for(kind, changed).find("stands under an unknown name") == std::string::npos;
                EXPECT_EQ(known, described.at("properties").contains(name));
            }
            for (const std::string needed : described.value("required", json::array())) {
                SCOPED_TRACE(kind + place + " without " + needed);
                json changed = *object.content;
                changed.at(object.at).erase(needed);
                EXPECT_NE(message_for(kind, changed).find("lacks \"" + needed + "\""), std::string::npos)
                    << message_for(kind, changed);
                EXPECT_FALSE(schema_accepts(kind, changed));
            }
        }
    }
}

} // namespace file_members_test
