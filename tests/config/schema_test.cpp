// The schema from which editors complete layouts must agree with the reader.
#include "config/model/layout_reader.h"
#include "config/model/schemas.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace schema_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;
using namespace std::string_literals;
using Pointer = json::json_pointer;

namespace {

const json& schema()
{
    static const json loaded = json::parse(read_text(source_dir() / "config/schema/layout.schema.json"));
    return loaded;
}

bool schema_accepts(const json& layout) { return starbow::testing::schema_accepts("layout", layout); }

/// The reader's message, or "" for a valid text.
std::string reader_message(const std::string& text)
{
    try {
        const Document document = parse_document("layout.json", text);
        read_layout(root(document), scratch("layout.json"));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

json parsed(const std::string& text) { return json::parse(text, nullptr, true, true); }

/// A schema's node, or the node that it refers to.
const json& resolved(const json& node)
{
    return node.contains("$ref") ? schema().at(Pointer(node.at("$ref").get<std::string>().substr(1))) : node;
}

/// An object of a layout: a valid layout that has it, its pointer, and the pointer of its description in the schema.
struct Sample {
    json layout;
    std::string at, described;
};

const std::string viewport_at = "/outputs/0/viewports/0", projection_at = viewport_at + "/projection";

json around(const std::string& projection)
{
    return parsed(R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": )" + projection + " }] }] }");
}

std::vector<Sample> samples()
{
    for (const char* file : {"left.data", "f.csv", "m.png"})
        write_text(file, "x");
    const json plain
        = parsed(R"({ "stereo": { "method": "reprojected" }, "blend": {}, "hud": {}, "head_tracker": {}, "outputs": [
        { "name": "a", "packing": "mono", "colour": {}, "monitor": { "connector": "HDMI-1" }, "viewports": [
            { "projection": { "type": "planar" }, "warp": { "file": "left.data" } }] }] })");
    const json flat = around(R"({ "type": "planar", "fov_x_deg": 80, "fov_y_deg": 60, "turn_deg": {} })");
    const json off_axis = around(R"({ "type": "planar", "sides_deg": { "left": -9, "right": 9, "down": -9, "up": 9 } })");
    const json wall = around(
        R"({ "type": "wall", "lower_left_m": [-1, -1, -2], "lower_right_m": [1, -1, -2], "upper_left_m": [-1, 1, -2] })");
    const std::string sides = R"("sides_deg": { "left": -90, "right": 90, "down": -20, "up": 20 })";
    const json cylinder = around(R"({ "type": "cylinder", )" + sides + " }"),
               panorama = around(R"({ "type": "equirectangular", )" + sides + " }");
    const json mirror
        = around(R"({ "type": "mirror", "projector_m": [0, 0.5, -2], "projector": { "fov_x_deg": 40, "fov_y_deg": 30 },
        "mirror_m": [0, 0.5, -2.8], "mirror_radius_m": 0.3, "dome_radius_m": 3 })");
    const json lens = around(R"({ "type": "lens", "red": { "k": [0, 0, 0, 0] }, "green": { "k": [0, 0, 0, 0] } })");
    return {
        {plain, "", ""},
        {plain, "/stereo", "/definitions/stereo"},
        {plain, "/blend", "/definitions/blend"},
        {plain, "/hud", "/definitions/hud"},
        {plain, "/head_tracker", "/definitions/head_tracker"},
        {plain, "/outputs/0", "/definitions/output"},
        {plain, "/outputs/0/colour", "/definitions/colour"},
        {plain, "/outputs/0/monitor", "/definitions/monitor"},
        {plain, viewport_at, "/definitions/viewport"},
        {plain, viewport_at + "/warp", "/definitions/warp"},
        {flat, projection_at, "/definitions/planar"},
        {flat, projection_at + "/turn_deg", "/definitions/turn_deg"},
        {off_axis, projection_at + "/sides_deg", "/definitions/planar/properties/sides_deg"},
        {wall, projection_at, "/definitions/wall"},
        {around(R"({ "type": "fisheye" })"), projection_at, "/definitions/fisheye"},
        {cylinder, projection_at, "/definitions/cylinder"},
        {cylinder, projection_at + "/sides_deg", "/definitions/cylinder/properties/sides_deg"},
        {panorama, projection_at, "/definitions/equirectangular"},
        {panorama, projection_at + "/sides_deg", "/definitions/equirectangular/properties/sides_deg"},
        {around(R"({ "type": "cube" })"), projection_at, "/definitions/cube"},
        {mirror, projection_at, "/definitions/mirror"},
        {mirror, projection_at + "/projector", "/definitions/mirror/properties/projector"},
        {lens, projection_at, "/definitions/lens"},
        {lens, projection_at + "/red", "/definitions/lens_colour"},
        {lens, projection_at + "/green", "/definitions/lens_colour"},
    };
}

/// The reader's message when a sample's member has this value.
std::string reader_message(const Sample& sample, const std::string& name, const json& value)
{
    json changed = sample.layout;
    changed[Pointer(sample.at)][name] = value;
    return reader_message(changed.dump());
}

/// All texts in double quotes after `from`.
std::set<std::string> quoted_in(const std::string& text, std::size_t from)
{
    static const std::regex quoted("\"([^\"]*)\"");
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin() + std::ptrdiff_t(std::min(from, text.size())), text.end(), quoted), end;
         at != end; ++at)
        found.insert((*at)[1]);
    return found;
}

} // namespace

TEST(SchemaTest, EveryShippedFileNamesItsSchemaAndIsValid)
{
    std::set<std::string> named;
    for (const char* folder : {"exhibits", "layouts", "profiles", "qualities", "scenes", "shots", "tours"})
        for (const auto& file : shipped(std::string("config/") + folder)) {
            SCOPED_TRACE(file);
            const json content = parsed(read_text(file));
            const std::string schema = content.value("$schema", "");
            ASSERT_TRUE(schema.starts_with("../schema/") && schema.ends_with(".schema.json")) << schema;
            ASSERT_TRUE(std::filesystem::exists(file.parent_path() / schema)) << schema;
            named.insert(schema.substr(10, schema.size() - 22));
            EXPECT_TRUE(starbow::testing::schema_accepts(*named.find(schema.substr(10, schema.size() - 22)), content));
        }
    const std::vector<std::string> kinds = kinds_with_schema();
    EXPECT_EQ(named.size(), kinds.size());
    for (const std::string& kind : kinds) {
        EXPECT_TRUE(named.count(kind)) << kind;
        EXPECT_EQ(read_text(source_dir() / "config/schema" / (kind + ".schema.json")), schema_text(kind));
    }
    for (const auto& file : shipped("config/layouts"))
        EXPECT_TRUE(read_text(file).starts_with("//")) << file << " must begin with its purpose";
}

TEST(SchemaTest, EveryFieldHasADescriptionWithItsUnit)
{
    int fields = 0;
    const std::function<void(const json&, const std::string&)> walk = [&](const json& node, const std::string& at) {
        if (node.is_array())
            for (std::size_t i = 0; i < node.size(); ++i)
                walk(node[i], at + "/" + std::to_string(i));
        if (!node.is_object())
            return;
        // A condition names members again without a description.
        for (const auto& [name, child] : node.items())
            if (name != "if" && name != "then" && name != "else" && name != "not" && name != "allOf"
                && name != "dependencies" && name != "properties")
                walk(child, at + "/" + name);
        if (!node.contains("properties"))
            return;
        for (const auto& [name, child] : node.at("properties").items()) {
            SCOPED_TRACE(at + "/" + name);
            ++fields;
            const std::string description = resolved(child).value("description", "");
            EXPECT_GE(description.size(), 10u);
            EXPECT_TRUE(description.ends_with(".")) << description;
            if (name.ends_with("_deg")) {
                EXPECT_NE(description.find("egrees"), std::string::npos) << description;
            }
            if (name.ends_with("_m")) {
                EXPECT_NE(description.find("etres"), std::string::npos) << description;
            }
            if (name == "size" || name == "place" || name == "position") {
                EXPECT_NE(description.find("ixels"), std::string::npos) << description;
            }
            if (resolved(child).value("type", "") == "number") {
                EXPECT_TRUE(std::regex_search(description, std::regex("egrees|etres|ixels|No unit|shorter side")))
                    << description;
            }
            walk(child, at + "/" + name);
        }
    };
    walk(schema(), "");
    EXPECT_GT(fields, 80);
}

TEST(SchemaTest, SamplesCoverEveryObjectOfTheSchema)
{
    std::set<std::string> covered;
    for (const Sample& sample : samples()) {
        EXPECT_EQ(reader_message(sample.layout.dump()), "");
        EXPECT_TRUE(schema_accepts(sample.layout)) << sample.layout;
        covered.insert(sample.described);
    }
    for (const auto& [name, node] : schema().at("definitions").items())
        if (node.contains("properties")) {
            EXPECT_TRUE(covered.count("/definitions/" + name)) << name;
        }
}

/// Candidates are all words of the schema and of the reader's sources, so that neither can know a name that the other lacks.
TEST(SchemaTest, ReaderAndSchemaKnowTheSameMembers)
{
    std::set<std::string> words;
    for (const char* file : {"layout.cpp", "projection_reader.cpp", "colour_reader.cpp", "describe_layout.h"}) {
        const std::string source = read_text(source_dir() / "config/model" / file);
        for (const std::string& word : quoted_in(source, 0))
            if (std::regex_match(word, std::regex("[$a-z_]+")))
                words.insert(word);
    }
    for (const std::string& word : quoted_in(schema().dump(), 0))
        if (std::regex_match(word, std::regex("[$a-z_]+")))
            words.insert(word);
    ASSERT_TRUE(words.count("dome_aperture_deg") && words.count("$schema") && words.count("first_row"));
    for (const Sample& sample : samples()) {
        const json& described = schema().at(Pointer(sample.described));
        EXPECT_EQ(described.at("additionalProperties"), false) << sample.described;
        for (const std::string& word : words) {
            const bool unknown
                = reader_message(sample, word, nullptr).find("stands under an unknown name") != std::string::npos;
            EXPECT_EQ(!unknown, described.at("properties").contains(word)) << sample.described << ": " << word;
        }
        for (const json& name : described.value("required", json::array())) {
            const std::string shown_name = name.dump();
            json without = sample.layout;
            without[Pointer(sample.at)].erase(name.get<std::string>());
            EXPECT_NE(reader_message(without.dump()).find("lacks " + shown_name), std::string::npos)
                << sample.described << shown_name;
        }
    }
}

TEST(SchemaTest, ReaderAndSchemaKnowTheSameChoicesAndRanges)
{
    int choices = 0, ranges = 0;
    for (const Sample& sample : samples())
        for (const auto& [name, property] : schema().at(Pointer(sample.described + "/properties")).items()) {
            SCOPED_TRACE(sample.described + ": " + name);
            const json& field = resolved(property);
            if (field.contains("enum")) {
                ++choices;
                const std::string message = reader_message(sample, name, "?");
                EXPECT_EQ(quoted_in(message, message.find("; ")), field.at("enum").get<std::set<std::string>>()) << message;
            }
            const json* item = &field; // the field itself, or the innermost item of a list
            for (; item->contains("items") && item->at("items").is_object(); item = &item->at("items")) { }
            if (!item->contains("maximum"))
                continue;
            ++ranges;
            json wrong = -1e300;
            if (field.contains("items"))
                wrong = json(field.at("minItems").get<std::size_t>(), item == &field.at("items") ? wrong : json(3, wrong));
            const bool open = item->contains("exclusiveMinimum");
            const std::string low = shown(item->at(open ? "exclusiveMinimum" : "minimum")),
                              high = shown(item->at("maximum"));
            const std::string message = reader_message(sample, name, wrong);
            EXPECT_NE(
                message.find(open ? "above " + low + " up to " + high : "from " + low + " to " + high), std::string::npos)
                << message;
            if (field.contains("default")) {
                EXPECT_EQ(reader_message(sample, name, field.at("default")), "");
            }
        }
    EXPECT_GE(choices, 8);
    EXPECT_GE(ranges, 45);
    // The schema describes each type of projection separately.
    std::set<std::string> types;
    for (const json& one : schema().at("/definitions/viewport/properties/projection/oneOf"_json_pointer))
        types.insert(resolved(one).at("properties").at("type").at("const"));
    const std::string message = reader_message(around(R"({ "type": "?" })").dump());
    EXPECT_EQ(quoted_in(message, message.find("; ")), types);
}

TEST(SchemaTest, BothAcceptValidLayouts)
{
    samples(); // writes the files that some of these layouts name
    const std::string planar = R"("viewports": [{ "projection": { "type": "planar" } }])";
    for (const std::string& text :
        {
            R"({ "outputs": [{ "name": "a", "viewports": [{ "warp": { "file": "left.data" } }] }] })"s,
            R"({ "outputs": [{ "name": "a", )" + planar + R"( }, { "name": "b", "preview": true }] })",
            R"({ "outputs": [{ "name": "a", "preview": false, "packing": "rows", )" + planar + " }] }",
            R"({ "outputs": [{ "name": "a", "whole_monitor": false, "place": [3, -4], )" + planar + " }] }",
            R"({ "outputs": [{ "name": "a", "colour": { "gamma": 2.2, "matrix": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }, )"
                + planar + " }] }",
            R"({ "outputs": [{ "name": "a", "colour": { "lut": [0, [0.25, 0.5, 0.5], 1] }, )" + planar + " }] }",
            R"({ "stereo": { "method": "reprojected", "baseline": "turning" }, "outputs": [{ "name": "a", )" + planar
                + " }] }",
            around(R"({ "type": "fisheye", "mapping": "orthographic", "aperture_deg": 180 })").dump(),
            around(R"({ "type": "fisheye", "mapping": "equisolid", "aperture_deg": 360 })").dump(),
            around(
                R"({ "type": "lens", "green": { "centre": [0.5, 0.5], "k": [0, 0, 0, 0.5] }, "blue": { "k": [0, 0, 0, 0] } })")
                .dump(),
        }) {
        SCOPED_TRACE(text);
        EXPECT_EQ(reader_message(text), "");
        EXPECT_TRUE(schema_accepts(parsed(text)));
    }
}

TEST(SchemaTest, BothRefuseInvalidLayouts)
{
    const std::string planar = R"("viewports": [{ "projection": { "type": "planar" } }])";
    const auto output
        = [&](const std::string& members) { return R"({ "outputs": [{ "name": "a", )" + members + ", " + planar + " }] }"; };
    const auto viewport = [](const std::string& members) {
        return R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" }, )" + members + " }] }] }";
    };
    std::vector<std::string> broken{"[]", "7", "{}", R"({ "outputs": [] })", R"({ "outputs": [1] })",
        R"({ "outputs": [{ "name": "a" }] })", R"({ "outputs": [{ "name": "a", "viewports": [] }] })",
        R"({ "outputs": [{ "name": "a", "viewports": [{}] }] })", R"({ "outputs": [{ )" + planar + " }] }",
        R"({ "outputs": [{ "name": "a b", )" + planar + " }] }",
        R"({ "hyper_stereo": 2, "outputs": [{ "name": "a", )" + planar + " }] }",
        R"({ "stereo": { "baseline": "turning" }, "outputs": [{ "name": "a", )" + planar + " }] }",
        R"({ "stereo": { "baseline": "turning", "method": "exact" }, "outputs": [{ "name": "a", )" + planar + " }] }",
        R"({ "outputs": [{ "name": "a", "preview": true, )" + planar + " }] }",
        R"({ "outputs": [{ "name": "b", )" + planar + R"( }, { "name": "a", "preview": true, "packing": "rows" }] })",
        output(R"("size": [800])"), output(R"("size": [800.5, 600])"), output(R"("size": [0, 600])"),
        output(R"("resizable": 1)"), output(R"("packing": "sbs")"), output(R"("fullscreen": true)"),
        output(R"("place": [0, 0], "whole_monitor": true)"), output(R"("monitor": {})"),
        output(R"("monitor": { "connector": "" })"), output(R"("colour": { "gamma": 2, "lut": [0, 1] })"),
        output(R"("colour": { "lut": [0] })"), output(R"("colour": { "lut": [0, 2] })"),
        output(R"("colour": { "lut": [0, [1, 1]] })"), output(R"("colour": { "lut": true })"),
        output(R"("colour": { "matrix": [[1, 0, 0]] })"), viewport(R"("rect": [0, 0, 2, 1])"), viewport(R"("eye": "both")"),
        viewport(R"("eye_m": [0, 0])"), viewport(R"("warp": {})"), viewport(R"("warp": "left.data")"),
        viewport(R"("warp": { "file": "left.data", "first_row": "up" })"),
        viewport(R"("warp": { "file": "left.data", "v": 1 })"),
        viewport(R"("warp": { "file": "left.data", "samples": "cells" })"),
        viewport(R"("warp": { "file": "left.data", "values": "points" })"), viewport(R"("alpha_mask": "")"),
        viewport(R"("mask_gamma": 0)")};
    for (const char* projection : {"60", "{}", R"({ "type": "dome" })", R"({ "type": "planar", "fov_x_deg": 60 })",
             R"({ "type": "planar", "fov_y_deg": 180 })", R"({ "type": "planar", "aperture_deg": 60 })",
             R"({ "type": "planar", "fov_y_deg": 60, "sides_deg": { "left": -9, "right": 9, "down": -9, "up": 9 } })",
             R"({ "type": "planar", "sides_deg": { "left": -9, "right": 9, "down": -9 } })",
             R"({ "type": "planar", "turn_deg": { "heading": 3 } })", R"({ "type": "wall" })",
             R"({ "type": "wall", "lower_left_m": [-1, -1], "lower_right_m": [1, -1, -2], "upper_left_m": [-1, 1, -2] })",
             R"({ "type": "fisheye", "mapping": "orthographic", "aperture_deg": 181 })",
             R"({ "type": "fisheye", "mapping": "stereographic", "aperture_deg": 351 })",
             R"({ "type": "fisheye", "diameter": 0 })",
             R"({ "type": "cylinder", "sides_deg": { "left": -9, "right": 9, "down": -90, "up": 9 } })",
             R"({ "type": "equirectangular", "fov_y_deg": 90 })", R"({ "type": "cube", "arrangement": "column" })",
             R"({ "type": "mirror" })", R"({ "type": "lens" })", R"({ "type": "lens", "green": { "k": [1, 2, 3] } })"})
        broken.push_back(around(projection).dump());
    samples();
    for (const std::string& text : broken) {
        SCOPED_TRACE(text);
        EXPECT_NE(reader_message(text), "");
        EXPECT_FALSE(schema_accepts(parsed(text)));
    }
}

} // namespace schema_test
