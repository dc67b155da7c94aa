// Every shipped file names its schema; descriptions have units; a layout's rules between members hold in schema and reader.
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

json around(const std::string& projection)
{
    return parsed(R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": )" + projection + " }] }] }");
}

/// Writes the files that layouts here name.
void write_named_files()
{
    for (const char* file : {"left.data", "f.csv", "m.png"})
        write_text(file, "x");
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
    for (const char* folder : {"exhibits", "layouts", "profiles", "programmes", "qualities", "scenes", "shots", "tours"})
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

TEST(SchemaTest, ReaderAndSchemaKnowTheSameProjections)
{
    std::set<std::string> types;
    for (const json& one : schema().at("/definitions/viewport/properties/projection/oneOf"_json_pointer))
        types.insert(resolved(one).at("properties").at("type").at("const"));
    const std::string message = reader_message(around(R"({ "type": "?" })").dump());
    EXPECT_EQ(quoted_in(message, message.find("; ")), types);
}

TEST(SchemaTest, BothAcceptValidLayouts)
{
    write_named_files();
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

/// Rules between members; those of one member are in file_members_test.cpp.
TEST(SchemaTest, BothRefuseInvalidLayouts)
{
    const std::string planar = R"("viewports": [{ "projection": { "type": "planar" } }])";
    const auto output
        = [&](const std::string& members) { return R"({ "outputs": [{ "name": "a", )" + members + ", " + planar + " }] }"; };
    std::vector<std::string> broken{"[]", "7", R"({ "outputs": [{ "name": "a" }] })",
        R"({ "outputs": [{ "name": "a", "viewports": [{}] }] })", R"({ "outputs": [{ "name": "a b", )" + planar + " }] }",
        R"({ "stereo": { "baseline": "turning" }, "outputs": [{ "name": "a", )" + planar + " }] }",
        R"({ "stereo": { "baseline": "turning", "method": "exact" }, "outputs": [{ "name": "a", )" + planar + " }] }",
        R"({ "outputs": [{ "name": "a", "preview": true, )" + planar + " }] }",
        R"({ "outputs": [{ "name": "b", )" + planar + R"( }, { "name": "a", "preview": true, "packing": "rows" }] })",
        output(R"("place": [0, 0], "whole_monitor": true)"), output(R"("monitor": {})"),
        output(R"("colour": { "gamma": 2, "lut": [0, 1] })")};
    for (const char* projection : {"{}", R"({ "type": "dome" })", R"({ "type": "planar", "fov_x_deg": 60 })",
             R"({ "type": "planar", "fov_y_deg": 60, "sides_deg": { "left": -9, "right": 9, "down": -9, "up": 9 } })",
             R"({ "type": "fisheye", "mapping": "orthographic", "aperture_deg": 181 })",
             R"({ "type": "fisheye", "mapping": "stereographic", "aperture_deg": 351 })"})
        broken.push_back(around(projection).dump());
    write_named_files();
    for (const std::string& text : broken) {
        SCOPED_TRACE(text);
        EXPECT_NE(reader_message(text), "");
        EXPECT_FALSE(schema_accepts(parsed(text)));
    }
}

} // namespace schema_test
