#include "config/model/layout.h"
#include "tests/support/files.h"

namespace layout_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// A layout with further members of one output, of one viewport, or one projection.
std::string output(const std::string& members)
{
    return R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" } }], )" + members + " }] }";
}
std::string viewport(const std::string& members, const std::string& size = "[800, 600]")
{
    return R"({ "outputs": [{ "name": "a", "size": )" + size + R"(, "viewports": [{ "projection": { "type": "planar" }, )"
        + members + " }] }] }";
}
std::string projection(const std::string& value)
{
    return R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": )" + value + " }] }] }";
}
std::string top(const std::string& members)
{
    return R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" } }] }], )" + members + " }";
}
std::string named(const std::string& name)
{
    return R"({ "outputs": [{ "name": )" + name + R"(, "viewports": [{ "projection": { "type": "planar" } }] }] })";
}
std::string tiled(const std::string& a, const std::string& b)
{
    const std::string planar = R"(, "projection": { "type": "planar" } })";
    return R"({ "outputs": [{ "name": "a", "viewports": [{ "rect": )" + a + planar + R"(, { "rect": )" + b + planar
        + "] }] }";
}

} // namespace

TEST(LayoutTest, ShippedLayoutsLoad)
{
    ASSERT_GE(shipped("config/layouts").size(), 3u);
    for (const auto& file : shipped("config/layouts")) {
        SCOPED_TRACE(file);
        EXPECT_EQ(load_layout(file).name, file.stem());
        EXPECT_EQ(load_layout(file).file, file);
    }
    const auto folder = source_dir() / "config/layouts";
    const Layout desk = load_layout(folder / "desk.json");
    ASSERT_EQ(desk.outputs.size(), 1u);
    EXPECT_TRUE(desk.outputs[0].resizable);
    EXPECT_EQ(desk.outputs[0].size, glm::ivec2(800, 600));
    EXPECT_EQ(std::get<Planar>(desk.outputs[0].viewports.at(0).projection).fov_y_deg, 60);
    EXPECT_EQ(desk.outputs[0].viewports[0].rect, glm::dvec4(0, 0, 1, 1));
    EXPECT_EQ(desk.stereo.hyper_stereo, 1);

    const Layout dome = load_layout(folder / "dome.json");
    const Fisheye fisheye = std::get<Fisheye>(dome.outputs.at(0).viewports.at(0).projection);
    EXPECT_EQ(fisheye.aperture_deg, 180);
    EXPECT_GT(dome.hud.value().elevation_deg, -fisheye.tilt_deg); // above the spring line

    const Layout stereo = load_layout(folder / "stereo.json");
    EXPECT_EQ(stereo.outputs.at(0).packing, Packing::side_by_side);
    EXPECT_EQ(stereo.outputs.at(0).viewports.size(), 1u);
    // The eyes are 0.0325 seconds of light apart, in light-seconds and in metres.
    EXPECT_NEAR(stereo.stereo.separation_m * stereo.stereo.units_per_m(299792458, 299792458), 0.0325, 1e-12);
    EXPECT_NEAR(stereo.stereo.separation_m * stereo.stereo.units_per_m(1, 5), 0.1625, 1e-12);
}

/// The layouts between ``` in the handbook, and a message that it quotes.
TEST(LayoutTest, TheHandbooksExamplesLoadAndItsMessageIsTrue)
{
    int layouts = 0;
    for (const char* name : {"docs/displays.md", "docs/files.md"}) {
        const std::string text = read_text(source_dir() / name), fence = "\n```\n";
        for (std::size_t at = text.find(fence); at != text.npos; at = text.find(fence, at)) {
            const std::size_t begin = at + fence.size(), end = text.find(fence, begin - 1);
            ASSERT_NE(end, text.npos);
            const std::string block = text.substr(begin, end + 1 - begin);
            at = end + fence.size() - 1;
            if (block.find("\"outputs\"") == block.npos)
                continue;
            ++layouts;
            EXPECT_NO_THROW(load_layout(write_text("handbook.json", block))) << block;
        }
    }
    EXPECT_EQ(layouts, 2);

    std::string wall = read_text(source_dir() / "config/layouts/tv3d.json");
    const std::string corners = wall.substr(
        wall.find("\"lower_left_m\""), wall.find('}', wall.find("\"lower_left_m\"")) - wall.find("\"lower_left_m\""));
    wall.replace(wall.find(corners), corners.size(),
        R"("lower_left_m": [-1.2, -0.675, -2], "lower_right_m": [1.2, -0.675, -2], "upper_left_m": [-1.1, 0.675, -2])");
    const std::string message = complaint([&] { load_layout(write_text("wall.json", wall)); });
    const std::string quoted = message.substr(std::min(message.find(": /outputs"), message.size()));
    EXPECT_NE(read_text(source_dir() / "docs/displays.md").find(quoted), std::string::npos) << quoted;
}

TEST(LayoutTest, ValuesAtTheLimitsAreAccepted)
{
    write_text("half.png", "x");
    for (const std::string& text :
        {projection(R"({ "type": "planar", "fov_y_deg": 0.1 })"), projection(R"({ "type": "planar", "fov_y_deg": 179 })"),
            projection(R"({ "type": "fisheye", "aperture_deg": 360, "tilt_deg": -180 })"),
            output(R"("size": [16384, 16384])"), output(R"("size": [1.0, 1])"),
            viewport(R"("rect": [0.3333, 0, 0.6667, 1])"), viewport(R"("rect": [0.1, 0.2, 0.9, 0.8])"),
            viewport(R"("eye_m": [1000, -1000, 0])"), top(R"("stereo": { "hyper_stereo": 1e12 })"), top(R"("hud": {})"),
            tiled("[0, 0, 0.5, 1]", "[0.5, 0, 0.5, 1]"), tiled("[0, 0, 0.3333333, 1]", "[0.3333333, 0, 0.6666667, 1]"),
            tiled("[0, 0, 0.5, 0.5]", "[0.5, 0.5, 0.5, 0.5]"), named("\"A-z_09\""),
            std::string(R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" } },
                { "projection": { "type": "planar" }, "order": -1 }] }] })"),
            std::string(R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" },
                "alpha_mask": "half.png" }, { "projection": { "type": "planar" }, "alpha_mask": "half.png" }] }] })")}) {
        SCOPED_TRACE(text);
        EXPECT_NO_THROW(load_layout(write_text("right.json", text)));
    }
}

TEST(LayoutTest, NeighbouringViewportsHaveNoGapOrOverlap)
{
    for (int width : {1, 7, 100, 801, 1600, 16384})
        for (double cut : {1 / 3., 0.5, 0.123, 0.999}) {
            const glm::ivec4 left = pixel_rect({{0, 0, cut, 1}}, {width, 9});
            const glm::ivec4 right = pixel_rect({{cut, 0, 1 - cut, 1}}, {width, 9});
            EXPECT_EQ(left.x + left.z, right.x);
            EXPECT_EQ(right.x + right.z, width);
        }
}

TEST(LayoutTest, TwoEyesAreThoseOfAPackingOrOfViewports)
{
    const auto has = [](const std::string& text) { return has_two_eyes(load_layout(write_text("eyes.json", text))); };
    EXPECT_FALSE(has(output(R"("packing": "mono")")));
    EXPECT_TRUE(has(output(R"("packing": "anaglyph-dubois")")));
    EXPECT_TRUE(has(viewport(R"("eye": "left")")));
    for (const std::string name : {"cave5", "desk", "dome", "wall3"})
        EXPECT_FALSE(has_two_eyes(load_layout(source_dir() / "config/layouts" / (name + ".json")))) << name;
    for (const std::string name : {"anaglyph", "headset", "passive-pair", "stereo", "tv3d"})
        EXPECT_TRUE(has_two_eyes(load_layout(source_dir() / "config/layouts" / (name + ".json")))) << name;
}

TEST(LayoutTest, WrongLayoutsAreRefused)
{
    const std::string vp = "/outputs/0/viewports/0";
    expect_wrong(load_layout,
        {
            {"[]", "", "[]", "is not an object"},
            {"7", "", "7", "is not an object"},
            {"{}", "", "{}", "lacks \"outputs\""},
            {R"({ "outputs": [] })", "/outputs", "[]", "has length 0; a list of 1 to 64 outputs"},
            {R"({ "outputs": {} })", "/outputs", "{}", "is not a list"},
            {R"({ "outputs": [1] })", "/outputs/0", "1", "is not an object"},
            {R"({ "output": [] })", "/output", "[]", "unknown name; \"outputs\""},
            {R"({ "outputs": [{ "viewports": [] }] })", "/outputs/0", "{\"viewports\":[]}", "lacks \"name\""},
            {R"({ "outputs": [{ "name": "a" }] })", "/outputs/0", "{\"name\":\"a\"}", "lacks \"viewports\""},
            {R"({ "outputs": [{ "name": "a", "viewports": [] }] })", "/outputs/0/viewports", "[]", "has length 0; "},
            {named("\"\""), "/outputs/0/name", "\"\"", "is empty"},
            {named("\"a b\""), "/outputs/0/name", "\"a b\"", "can't be part of a file's name"},
            {named("\"../a\""), "/outputs/0/name", "\"../a\"", "can't be part of a file's name"},
            {named("\"ä\""), "/outputs/0/name", "\"ä\"", "can't be part of a file's name"},
            {named("\"a\\n\""), "/outputs/0/name", "\"a\\n\"", "holds a control character"},
            {named("\"" + std::string(65, 'x') + "\""), "/outputs/0/name", "\"" + std::string(65, 'x') + "\"", "up to 64"},
            {named("5"), "/outputs/0/name", "5", "is not a text"},
            {R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" } }] },
                { "name": "a", "viewports": [{ "projection": { "type": "planar" } }] }] })",
                "/outputs/1/name", "\"a\"", "is the name of output 0 too"},
            {output(R"("size": [0, 600])"), "/outputs/0/size/0", "0", "is too small; a number from 1 to 16384"},
            {output(R"("size": [800, 16385])"), "/outputs/0/size/1", "16385", "is too large"},
            {output(R"("size": [800.5, 600])"), "/outputs/0/size/0", "800.5", "is not a whole number"},
            {output(R"("size": [800])"), "/outputs/0/size", "[800]", "has length 1; "},
            {output(R"("size": "800x600")"), "/outputs/0/size", "\"800x600\"", "is not a list"},
            {output(R"("resizable": 1)"), "/outputs/0/resizable", "1", "is neither true nor false"},
            {output(R"("fullscreen": true)"), "/outputs/0/fullscreen", "true", "unknown name"},
            {top(R"("hyper_stereo": 1e8)"), "/hyper_stereo", "100000000.0", "\"stereo\""},
            {top(R"("$schema": 7)"), "/$schema", "7", "is not a text"},
            {projection("60"), vp + "/projection", "60", "is not an object"},
            {projection("{}"), vp + "/projection", "{}", "lacks \"type\""},
            {projection(R"({ "type": "dome" })"), vp + "/projection/type", "\"dome\"",
                "\"planar\", \"wall\", \"fisheye\", "},
            {projection(R"({ "type": "planar", "fov_y_deg": 0 })"), vp + "/projection/fov_y_deg", "0", "is too small"},
            {projection(R"({ "type": "planar", "fov_y_deg": 180 })"), vp + "/projection/fov_y_deg", "180",
                "is too large; a number from 0.1 to 179"},
            {projection(R"({ "type": "planar", "aperture_deg": 180 })"), vp + "/projection/aperture_deg", "180",
                "\"fov_y_deg\""},
            {projection(R"({ "type": "planar", "fov_deg": 60 })"), vp + "/projection/fov_deg", "60", "\"fov_y_deg\""},
            {projection(R"({ "type": "fisheye", "fov_y_deg": 60 })"), vp + "/projection/fov_y_deg", "60", "unknown name"},
            {projection(R"({ "type": "fisheye", "aperture_deg": 361 })"), vp + "/projection/aperture_deg", "361",
                "is too large"},
            {projection(R"({ "type": "fisheye", "aperture_deg": 0.5 })"), vp + "/projection/aperture_deg", "0.5",
                "is too small"},
            {projection(R"({ "type": "fisheye", "tilt_deg": 181 })"), vp + "/projection/tilt_deg", "181", "is too large"},
            {projection(R"({ "type": "fisheye", "tilt_deg": "30" })"), vp + "/projection/tilt_deg", "\"30\"",
                "is not a number"},
            {R"({ "outputs": [{ "name": "a", "viewports": [{}] }] })", vp, "{}", "lacks \"projection\""},
            {viewport(R"("eye": [0, 0, 0])"), vp + "/eye", "[0,0,0]", "\"middle\", \"left\" or \"right\""},
            {viewport(R"("eyes": [0, 0, 0])"), vp + "/eyes", "[0,0,0]", "\"eye_m\""},
            {viewport(R"("eye_m": [0, 0])"), vp + "/eye_m", "[0,0]", "has length 2; "},
            {viewport(R"("eye_m": [0, 1001, 0])"), vp + "/eye_m/1", "1001", "is too large"},
            {viewport(R"("eye_m": [0, null, 0])"), vp + "/eye_m/1", "null", "is not a number"},
            {viewport(R"("rect": [0, 0, 1])"), vp + "/rect", "[0,0,1]", "has length 3; "},
            {viewport(R"("rect": [0, 0, 0, 1])"), vp + "/rect", "[0,0,0,1]", "is empty"},
            {viewport(R"("rect": [0, 0, 1, -1])"), vp + "/rect/3", "-1", "is too small"},
            {viewport(R"("rect": [-0.1, 0, 1, 1])"), vp + "/rect/0", "-0.1", "is too small"},
            {viewport(R"("rect": [0, 0, 800, 600])"), vp + "/rect/2", "800", "is too large"},
            {viewport(R"("rect": [0.5, 0, 0.6, 1])"), vp + "/rect", "[0.5,0,0.6,1]", "reaches beyond the output"},
            {viewport(R"("rect": [0, 0.1, 1, 1])"), vp + "/rect", "[0,0.1,1,1]", "reaches beyond the output"},
            {viewport(R"("rect": [0, 0, 0.0001, 1])"), vp + "/rect", "[0,0,0.0001,1]", "is smaller than a pixel"},
            {viewport(R"("rect": [0, 0, 1, 0.4])", "[800, 1]"), vp + "/rect", "[0,0,1,0.4]", "800 x 1 output"},
            {tiled("[0, 0, 0.6, 1]", "[0.5, 0, 0.5, 1]"), "/outputs/0/viewports/1/rect", "[0.5,0,0.5,1]",
                "overlaps viewport 0"},
            {tiled("[0, 0, 1, 1]", "[0.4, 0.4, 0.2, 0.2]"), "/outputs/0/viewports/1/rect", "[0.4,0.4,0.2,0.2]",
                "overlaps viewport 0"},
            {R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" } },
                { "projection": { "type": "planar" } }] }] })",
                "/outputs/0/viewports/1", "{\"projection\":{\"type\":\"planar\"}}", "overlaps viewport 0"},
            {R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" }, "order": 2 },
                { "rect": [0, 0, 1, 0.5], "projection": { "type": "planar" }, "order": 2 }] }] })",
                "/outputs/0/viewports/1/rect", "[0,0,1,0.5]",
                "overlaps viewport 0 of this output, and nothing says which is on top; a higher \"order\" in one of them, "
                "or an \"alpha_mask\" in each as its share, is right"},
            {top(R"("hud": [])"), "/hud", "[]", "is not an object"},
            {top(R"("hud": { "width_deg": 0 })"), "/hud/width_deg", "0", "is too small"},
            {top(R"("hud": { "width_deg": 121 })"), "/hud/width_deg", "121", "is too large; a number from 1 to 120"},
            {top(R"("hud": { "elevation_deg": 91 })"), "/hud/elevation_deg", "91", "is too large"},
            {top(R"("hud": { "azimuth_deg": -181 })"), "/hud/azimuth_deg", "-181", "is too small"},
            {top(R"("hud": { "height_deg": 5 })"), "/hud/height_deg", "5", "\"width_deg\""},
        });
}

TEST(LayoutTest, MutatedLayoutsLoadOrAreRefused)
{
    std::vector<std::string> seeds;
    for (const auto& file : shipped("config/layouts"))
        seeds.push_back(read_text(file));
    expect_survives(load_layout, seeds);
}

} // namespace layout_test
