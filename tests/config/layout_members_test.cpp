// Every member of a layout: its effect, and the rules between members. Limits are in file_members_test.cpp.
#include "config/model/layout.h"
#include "tests/support/files.h"

namespace layout_members_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const std::string vp = "/outputs/0/viewports/0", at_projection = vp + "/projection";

/// A layout with further top members, members of one output or viewport, or one projection.
std::string top(const std::string& members, const std::string& output = "", const std::string& viewport = "")
{
    return "{ " + members + (members.empty() ? "" : ", ") + R"("outputs": [{ "name": "a", )" + output
        + (output.empty() ? "" : ", ") + R"("viewports": [{ )" + viewport + (viewport.empty() ? "" : ", ")
        + R"("projection": { "type": "planar" } }] }] })";
}
std::string output(const std::string& members) { return top("", members); }
std::string viewport(const std::string& members) { return top("", "", members); }
std::string projection(const std::string& members, const std::string& viewport = "", const std::string& output = "")
{
    return R"({ "outputs": [{ "name": "a", )" + output + (output.empty() ? "" : ", ") + R"("viewports": [{ )" + viewport
        + (viewport.empty() ? "" : ", ") + R"("projection": { )" + members + " } }] }] }";
}
std::string outputs(const std::string& list) { return R"({ "outputs": [)" + list + "] }"; }
std::string plain(const std::string& name, const std::string& members = "")
{
    return R"({ "name": ")" + name + R"(", )" + members + (members.empty() ? "" : ", ")
        + R"("viewports": [{ "projection": { "type": "planar" } }] })";
}

Layout load(const std::string& text) { return load_layout(write_text("right.json", text)); }
Output first(const std::string& text) { return load(text).outputs.at(0); }
template <class Type> Type shown_by(const std::string& text)
{
    return std::get<Type>(load(text).outputs.at(0).viewports.at(0).projection);
}

void expect_right(const std::vector<std::string>& texts)
{
    for (const std::string& text : texts) {
        SCOPED_TRACE(text);
        EXPECT_NO_THROW(load(text));
    }
}

void expect_sides(const Sides& sides, double left, double right, double down, double up)
{
    EXPECT_EQ(sides.left_deg, left);
    EXPECT_EQ(sides.right_deg, right);
    EXPECT_EQ(sides.down_deg, down);
    EXPECT_EQ(sides.up_deg, up);
}

void expect_turn(const Turn& turn, double yaw, double pitch, double roll)
{
    EXPECT_EQ(turn.yaw_deg, yaw);
    EXPECT_EQ(turn.pitch_deg, pitch);
    EXPECT_EQ(turn.roll_deg, roll);
}

const std::string turn = R"("turn_deg": { "yaw": 1, "pitch": -2, "roll": 3 })";
const std::string wall
    = R"("type": "wall", "lower_left_m": [-1, -1, -2], "lower_right_m": [1, -1, -2], "upper_left_m": [-1, 1, -2])";
const std::string mirror = R"("type": "mirror", "projector_m": [0, 0.5, -2], "projector": { "fov_y_deg": 30 },
    "mirror_m": [0, 0.5, -2.8], "mirror_radius_m": 0.3, "dome_radius_m": 3)";
const std::string lens = R"("type": "lens", "green": { "k": [0.1, 0.02, 0, 0] })";

} // namespace

TEST(LayoutMembersTest, StereoBlendAndHudAreRead)
{
    const Layout layout = load(top(R"("$schema": "x", "stereo": { "method": "reprojected", "separation_m": 0.06,
        "hyper_stereo": 2, "baseline": "turning", "full_from_zenith_deg": 30 }, "blend": { "ramps": true, "power": 2.5 },
        "hud": { "azimuth_deg": 5, "elevation_deg": -6, "width_deg": 70 })"));
    EXPECT_EQ(layout.stereo.method, StereoMethod::reprojected);
    EXPECT_EQ(layout.stereo.separation_m, 0.06);
    EXPECT_EQ(layout.stereo.hyper_stereo, 2);
    EXPECT_FALSE(layout.stereo.by_light);
    EXPECT_TRUE(layout.stereo.turning);
    EXPECT_EQ(layout.stereo.full_from_zenith_deg, 30);
    EXPECT_TRUE(layout.blend.ramps);
    EXPECT_EQ(layout.blend.power, 2.5);
    EXPECT_EQ(layout.hud.value().azimuth_deg, 5);
    EXPECT_EQ(layout.hud.value().elevation_deg, -6);
    EXPECT_EQ(layout.hud.value().width_deg, 70);
    expect_right({top(R"("stereo": {})"), top(R"("stereo": { "method": "shared", "separation_m": 0 })"),
        top(R"("stereo": { "method": "exact", "baseline": "fixed" })"), top(R"("stereo": { "separation_m": 10 })"),
        top(R"("stereo": { "full_from_zenith_deg": 0 })"), top(R"("blend": {})"), top(R"("blend": { "power": 0.1 })")});
    expect_wrong(load_layout,
        {
            {top(R"("stereo": { "separation_m": 0 })"), "/stereo/separation_m", "0", "puts both eyes in one place"},
            {top(R"("stereo": { "separation_m": 0, "method": "reprojected" })"), "/stereo/separation_m", "0",
                "puts both eyes in one place; a number above 0, or the method \"shared\""},
            {top(R"("stereo": { "hyper_stereo": 1e999 })"), "/stereo/hyper_stereo", "1e999", "is too large for a number"},
            {top(R"("stereo": { "hyper_stereo": 1, "hyper_stereo": 1 })"), "/stereo/hyper_stereo", "\"hyper_stereo\"",
                "is given twice"},
            {top(R"("stereo": { "baseline": "turning" })"), "/stereo/baseline", "\"turning\"", "the method \"reprojected\""},
        });
}

TEST(LayoutMembersTest, PackingsAreRead)
{
    const std::vector<std::pair<std::string, Packing>> names{{"mono", Packing::mono},
        {"side-by-side", Packing::side_by_side}, {"side-by-side-half", Packing::side_by_side_half},
        {"top-and-bottom", Packing::top_and_bottom}, {"top-and-bottom-half", Packing::top_and_bottom_half},
        {"rows", Packing::rows}, {"columns", Packing::columns}, {"checkerboard", Packing::checkerboard},
        {"anaglyph-red-cyan", Packing::anaglyph_red_cyan}, {"anaglyph-dubois", Packing::anaglyph_dubois},
        {"anaglyph-amber-blue", Packing::anaglyph_amber_blue}};
    for (const auto& [name, packing] : names) {
        EXPECT_EQ(first(output("\"packing\": \"" + name + "\"")).packing, packing) << name;
        if (packing != Packing::mono)
            expect_wrong(load_layout,
                {{top("", "\"packing\": \"" + name + "\"", R"("eye": "left")"), vp + "/eye", "\"left\"",
                    "shows both eyes"}});
    }
    expect_right(
        {output(R"("packing": "side-by-side", "size": [802, 601])"), output(R"("packing": "rows", "size": [801, 601])"),
            output(R"("packing": "top-and-bottom-half", "size": [801, 600])"),
            top("", R"("packing": "mono")", R"("eye": "right")")});
    expect_wrong(load_layout,
        {
            {output(R"("packing": true)"), "/outputs/0/packing", "true", "is not known here"},
            {output(R"("packing": "side-by-side", "size": [801, 600])"), "/outputs/0/size", "[801,600]",
                "no two equal halves"},
            {output(R"("packing": "top-and-bottom", "size": [800, 601])"), "/outputs/0/size", "[800,601]",
                "no two equal halves"},
            {top("", R"("packing": "side-by-side", "size": [20, 20])", R"("rect": [0, 0, 0.04, 1])"), vp + "/rect",
                "[0,0,0.04,1]", "smaller than a pixel of the 10 x 20 output"},
        });
}

TEST(LayoutMembersTest, WindowsAndMonitorsAreRead)
{
    const Output o = first(output(R"("resizable": true, "place": [-1920, 0], "monitor": { "connector": "HDMI-1",
        "model": "DELL U2412M", "serial": "XYZ", "position": [1920, -5] })"));
    EXPECT_TRUE(o.resizable);
    EXPECT_EQ(o.place, glm::ivec2(-1920, 0));
    EXPECT_EQ(o.monitor.connector, "HDMI-1");
    EXPECT_EQ(o.monitor.model, "DELL U2412M");
    EXPECT_EQ(o.monitor.serial, "XYZ");
    EXPECT_EQ(o.monitor.position, glm::ivec2(1920, -5));
    EXPECT_TRUE(first(output(R"("whole_monitor": true)")).whole_monitor);
    const std::string hdmi = R"("monitor": { "connector": "HDMI-1" })", whole = R"(, "whole_monitor": true)";
    expect_right({outputs(plain("a", hdmi) + ", " + plain("b", hdmi + R"(, "place": [900, 0])")),
        outputs(plain("a", hdmi + whole) + ", " + plain("b", R"("monitor": { "connector": "HDMI-2" })" + whole)),
        outputs(plain("a", hdmi + whole) + ", " + plain("b"))});
    const std::string monitor = "/outputs/0/monitor";
    expect_wrong(load_layout,
        {
            {output(R"("monitor": {})"), monitor, "{}", "names no monitor"},
            {output(R"("monitor": { "connector": "" })"), monitor + "/connector", "\"\"", "is empty"},
            {output(R"("place": [0, 0], "whole_monitor": true)"), "/outputs/0/place", "[0,0]", "not both"},
            {outputs(plain("a", hdmi + whole) + ", " + plain("b", hdmi + whole)), "/outputs/1/monitor",
                "{\"connector\":\"HDMI-1\"}", "takes the same monitor as output 0"},
            {outputs(plain("a", hdmi) + ", " + plain("b", hdmi + whole)), "/outputs/1/monitor", "{\"connector\":\"HDMI-1\"}",
                "takes the same monitor as output 0"},
            {outputs(plain("a", R"("whole_monitor": true)") + ", " + plain("b", R"("whole_monitor": true)")), "/outputs/1",
                "{\"name\":\"b\"", "takes the same monitor as output 0"},
        });
}

TEST(LayoutMembersTest, PreviewsAreRead)
{
    const Layout layout = load(outputs(plain("a") + R"(, { "name": "operator", "preview": true, "size": [640, 360] })"));
    EXPECT_FALSE(layout.outputs.at(0).preview);
    EXPECT_TRUE(layout.outputs.at(1).preview);
    EXPECT_TRUE(layout.outputs.at(1).viewports.empty());
    expect_right({output(R"("preview": false)"), outputs(R"({ "name": "p", "preview": true }, )" + plain("a"))});
    const std::string preview = R"(, { "name": "p", "preview": true)";
    expect_wrong(load_layout,
        {
            {outputs(plain("a") + preview + R"(, "viewports": [] })"), "/outputs/1/viewports", "[]",
                "stands in the preview"},
            {outputs(plain("a") + preview + R"(, "packing": "rows" })"), "/outputs/1/packing", "\"rows\"",
                "stands in the preview"},
            {outputs(plain("a") + preview + R"( }, { "name": "q", "preview": true })"), "/outputs/2/preview", "true",
                "makes a second preview beside output 1"},
            {outputs(R"({ "name": "p", "preview": true })"), "/outputs", "[{\"name\":\"p\",\"preview\":true}]",
                "holds a preview alone"},
        });
}

TEST(LayoutMembersTest, ColourIsRead)
{
    const Colour colour = first(output(R"("colour": { "gamma": 2.2, "matrix": [[1, 2, 3], [4, 5, 6], [7, 8, 9]] })")).colour;
    EXPECT_EQ(colour.gamma, 2.2);
    const glm::dvec3 product = colour.matrix * glm::dvec3(1, 10, 100); // the rows multiply; calculated by hand
    EXPECT_EQ(product, glm::dvec3(321, 654, 987));
    const std::vector<glm::dvec3> table{{0, 0.1, 0}, {0.5, 0.5, 0.5}, {1, 0.5, 0.75}};
    EXPECT_EQ(first(output(R"("colour": { "lut": [[0, 0.1, 0], 0.5, [1, 0.5, 0.75]] })")).colour.lut, table);
    const std::string at = "/outputs/0/colour";
    expect_right(
        {output(R"("colour": {})"), output(R"("colour": { "lut": [0, 0] })"), output(R"("colour": { "gamma": 0.1 })")});
    expect_wrong(load_layout,
        {
            {output(R"("colour": { "gamma": 2, "lut": [0, 1] })"), at + "/gamma", "2", "stands beside \"lut\""},
            {output(R"("colour": { "lut": 5 })"), at + "/lut", "5", "is not a table"},
            {output(R"("colour": { "lut": [0, 0.5, 0.4, 1] })"), at + "/lut/2", "0.4",
                "is darker in red than the entry before"},
            {output(R"("colour": { "lut": [[0, 0, 0.5], [1, 1, 0.4]] })"), at + "/lut/1", "[1,1,0.4]", "is darker in blue"},
            {output(R"("colour": { "lut": "none.cube" })"), at + "/lut", "\"none.cube\"", "names no file in"},
        });
}

TEST(LayoutMembersTest, CubeFilesAreRead)
{
    const std::string text = output(R"("colour": { "lut": "table.cube" })");
    write_text("table.cube",
        "# from a meter\r\nTITLE \"1 2 3\"\r\n\r\nLUT_1D_SIZE 3\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1.0 1.0 1.0\n0 0 0\n"
        "  0.25\t.5 1e-1 # no\n1 1 1\n");
    EXPECT_NE(
        complaint([&] { load(text); }).find("table.cube:8: \"  0.25?.5 1e-1 # no\" is not known here"), std::string::npos);
    write_text("table.cube",
        "# from a meter\r\nTITLE \"1 2 3\"\r\n\r\nLUT_1D_SIZE 3\nDOMAIN_MIN 0 0 0\nDOMAIN_MAX 1.0 1.0 1.0\n0 0 0\n"
        "  0.25\t.5 1e-1\r\n1 1 1");
    const std::vector<glm::dvec3> table{{0, 0, 0}, {0.25, 0.5, 0.1}, {1, 1, 1}};
    EXPECT_EQ(first(text).colour.lut, table);
    for (const auto& [content, says] : std::vector<std::pair<std::string, std::string>>{
             {"", ": is empty"},
             {"LUT_3D_SIZE 2\n0 0 0", ":1: \"LUT_3D_SIZE 2\" begins a three-dimensional table; "},
             {"LUT_1D_SIZE 1\n", ":1: \"LUT_1D_SIZE 1\" is not a size; "},
             {"LUT_1D_SIZE 2.5\n", "is not a size; "},
             {"LUT_1D_SIZE 65537\n", "is not a size; "},
             {"LUT_1D_SIZE\n", "is not a size; "},
             {"LUT_1D_SIZE 2\nDOMAIN_MAX 2 2 2\n", ":2: \"DOMAIN_MAX 2 2 2\" is a range that"},
             {"LUT_1D_SIZE 2\nDOMAIN_MIN 0 0\n", ":2: \"DOMAIN_MIN 0 0\" is a range that"},
             {"LUT_1D_SIZE 2\n0 0 0\n1 1 x\n", ":3: \"1 1 x\" is not known here"},
             {"LUT_1D_SIZE 2\n0 0 0\n1 1 nan\n", ":3: \"1 1 nan\" is not known here"},
             {"LUT_1D_SIZE 2\n0 0 0\n1 1\n", ":3: \"1 1\" is not known here"},
             {"0 0 0\nLUT_1D_SIZE 2\n", ":1: \"0 0 0\" stands before the table's size"},
             {"LUT_1D_SIZE 2\n0 0 0\n1 1 1\n1 1 1\n", ":4: \"1 1 1\" is one entry too many; 2 entries"},
             {"LUT_1D_SIZE 3\n0 0 0\n1 1 1\n", ":3: has 2 entries; the 3 of LUT_1D_SIZE"},
             {"LUT_1D_SIZE 2\n0 0 0\n1 1.5 1\n", ":3: \"1 1.5 1\" leaves the range"},
             {"LUT_1D_SIZE 2\n0 1 0\n1 0 1\n", ":3: \"1 0 1\" is darker in green"},
             {"# nothing\n", ":1: has 0 entries; LUT_1D_SIZE and as many entries"},
         }) {
        SCOPED_TRACE(content);
        const std::string file = write_text("table.cube", content).string();
        const std::string message = complaint([&] { load(text); });
        EXPECT_TRUE(message.starts_with(file)) << message;
        EXPECT_NE(message.find(says), std::string::npos) << message;
        EXPECT_TRUE(message.ends_with(" is right") || message.ends_with(" are right")) << message;
    }
}

TEST(LayoutMembersTest, ViewportsEyesWarpsAndMasksAreRead)
{
    const auto warp = write_text("left.data", "x"), frustum = write_text("f.csv", "x"), mask = write_text("m.png", "x");
    std::filesystem::create_directory(scratch("folder.png"));
    const Viewport v = first(viewport(R"("eye": "right", "eye_m": [0.1, 0.2, 0.3], "warp": { "file": "left.data",
        "frustum": "f.csv", "region": "left", "first_row": "top", "aspect": 1.6 }, "alpha_mask": "m.png", "black_level": "m.png",
        "mask_gamma": 2.2, "order": -3)"))
                           .viewports.at(0);
    EXPECT_EQ(v.eye, Eye::right);
    EXPECT_EQ(v.eye_m, glm::dvec3(0.1, 0.2, 0.3));
    ASSERT_TRUE(v.warp);
    EXPECT_EQ(v.warp->file, warp);
    EXPECT_EQ(v.warp->frustum, frustum);
    EXPECT_EQ(v.warp->region, "left");
    EXPECT_TRUE(v.warp->map.first_row_on_top);
    EXPECT_EQ(v.alpha_mask, mask);
    EXPECT_EQ(v.black_level, mask);
    EXPECT_EQ(v.mask_gamma, 2.2);
    EXPECT_EQ(v.warp->aspect, 1.6);
    EXPECT_EQ(v.order, -3);
    EXPECT_EQ(first(viewport(R"("eye": "left")")).viewports[0].eye, Eye::left);
    EXPECT_EQ(first(viewport(R"("warp": { "file": ")" + warp.string() + "\" }")).viewports[0].warp->file, warp);
    EXPECT_FALSE(first(viewport(R"("warp": { "file": "left.data", "first_row": "bottom" })"))
                     .viewports[0]
                     .warp->map.first_row_on_top);

    const FloatMapForm places
        = first(viewport(R"("warp": { "file": "left.data", "v": "up", "samples": "edges", "values": "places" })"))
              .viewports[0]
              .warp->map;
    EXPECT_EQ(places, (FloatMapForm{.v_up = true, .edge_to_edge = true}));
    EXPECT_EQ(first(viewport(R"("warp": { "file": "left.data", "values": "offsets" })")).viewports[0].warp->map,
        (FloatMapForm{.offsets = true}));

    const std::string alone = R"({ "outputs": [{ "name": "a", "viewports": [{ "warp": { "file": "left.data" } }] }] })";
    EXPECT_FALSE(first(alone).viewports.at(0).projection_given);
    EXPECT_TRUE(first(viewport(R"("warp": { "file": "left.data" })")).viewports[0].projection_given);
    expect_wrong(load_layout,
        {
            {viewport(R"("warp": { "file": "no.data" })"), vp + "/warp/file", "\"no.data\"", "names no file in"},
            {viewport(R"("warp": { "file": "." })"), vp + "/warp/file", "\".\"", "is a folder"},
            {viewport(R"("warp": { "file": "left.data", "frustum": "no.csv" })"), vp + "/warp/frustum", "\"no.csv\"",
                "names no file in"},
            {viewport(R"("warp": { "file": "left.data", "v": "top" })"), vp + "/warp/v", "\"top\"", "is right"},
            {viewport(R"("warp": { "file": "left.data", "samples": "corners" })"), vp + "/warp/samples", "\"corners\"",
                "is right"},
            {viewport(R"("warp": { "file": "left.data", "values": "shifts" })"), vp + "/warp/values", "\"shifts\"",
                "is right"},
            {viewport(R"("warp": { "file": "left.data", "values": "offsets", "v": "up" })"), vp + "/warp/v", "\"up\"",
                "stands beside \"values\": \"offsets\""},
            {viewport(R"("warp": { "file": "left.data", "values": "offsets", "samples": "edges" })"), vp + "/warp/samples",
                "\"edges\"", "stands beside"},
            {viewport(R"("alpha_mask": "folder.png")"), vp + "/alpha_mask", "\"folder.png\"", "is a folder"},
            {viewport(R"("black_level": "no-such.png")"), vp + "/black_level", "\"no-such.png\"", "names no file in"},
            {viewport(R"("order": 0.5)"), vp + "/order", "0.5", "is right"},
        });
}

TEST(LayoutMembersTest, PlanarViewsAreRead)
{
    const Planar both = shown_by<Planar>(projection(R"("type": "planar", "fov_x_deg": 90, "fov_y_deg": 50, )" + turn));
    expect_sides(both.sides.value(), -45, 45, -25, 25);
    expect_turn(both.turn, 1, -2, 3);
    const Planar sides = shown_by<Planar>(
        projection(R"("type": "planar", "sides_deg": { "left": -10, "right": 20, "down": -30, "up": 40 })"));
    expect_sides(sides.sides.value(), -10, 20, -30, 40);
    const std::string limits = R"({ "left": -89.9, "right": 89.9, "down": 10, "up": 89.9 })";
    expect_right({projection(R"("type": "planar", "sides_deg": )" + limits),
        projection(R"("type": "planar", "turn_deg": {})"), projection(R"("type": "planar", "turn_deg": { "yaw": 360 })")});
    const std::string p = R"("type": "planar", )";
    expect_wrong(load_layout,
        {
            {projection(p + R"("fov_x_deg": 90)"), at_projection + "/fov_x_deg", "90", "stands without \"fov_y_deg\""},
            {projection(p + R"("fov_y_deg": 60, "sides_deg": )" + limits), at_projection + "/sides_deg", "{\"down\":10",
                "stands beside \"fov_y_deg\""},
            {projection(p + R"("fov_x_deg": 60, "sides_deg": )" + limits), at_projection + "/sides_deg", "{\"down\":10",
                "stands beside \"fov_x_deg\""},
            {projection(p + R"("sides_deg": { "left": 10, "right": -10, "down": -10, "up": 10 })"),
                at_projection + "/sides_deg/left", "10", "is not less than \"right\", -10"},
            {projection(p + R"("sides_deg": { "left": -10, "right": 10, "down": 10, "up": 10 })"),
                at_projection + "/sides_deg/down", "10", "is not less than \"up\", 10"},
        });
}

TEST(LayoutMembersTest, WallsAreRead)
{
    const Wall w = shown_by<Wall>(projection(wall));
    EXPECT_EQ(w.lower_left_m, glm::dvec3(-1, -1, -2));
    EXPECT_EQ(w.lower_right_m, glm::dvec3(1, -1, -2));
    EXPECT_EQ(w.upper_left_m, glm::dvec3(-1, 1, -2));
    const std::string from = R"("type": "wall", "lower_left_m": [-1, -1, -2], )";
    expect_right({projection(
                      from + R"("lower_right_m": [1, -1, -2], "upper_left_m": [-0.971, 0.5, -2])"), // 19.3 mm for each metre
        projection(wall, R"("eye_m": [0, 0, -1.99])"), projection(wall, R"("eye_m": [0, 0, -1.96])", R"("packing": "rows")"),
        // A floor as the visitor sees it, with the far edge up.
        projection(
            R"("type": "wall", "lower_left_m": [-1, -1.5, 1], "lower_right_m": [1, -1.5, 1], "upper_left_m": [-1, -1.5, -1])")});
    expect_wrong(load_layout,
        {
            {projection(from + R"("lower_right_m": [1, -1, -2], "upper_left_m": [-0.95, 1, -2])"),
                at_projection + "/upper_left_m", "[-0.95,1,-2]", "makes no right angle with the other corners (25 mm off"},
            {projection(from + R"("lower_right_m": [-1, -1, -2], "upper_left_m": [-1, 1, -2])"),
                at_projection + "/lower_right_m", "[-1,-1,-2]", "is less than a millimetre from"},
            {projection(from + R"("lower_right_m": [1, -1, -2], "upper_left_m": [-1, -1, -2])"),
                at_projection + "/upper_left_m", "[-1,-1,-2]", "is less than a millimetre from"},
            {projection(
                 R"("type": "wall", "lower_left_m": [1, -1, -2], "lower_right_m": [-1, -1, -2], "upper_left_m": [1, 1, -2])"),
                at_projection, "{\"lower_left_m\":[1,-1,-2]", "is seen from behind by the eye at [0, 0, 0]"},
            {projection(wall, R"("eye_m": [0.5, 0, -2.0001])"), at_projection,
                "{\"lower_left_m\":", "touches the eye at [0.5, 0, -2.0001]"},
            {projection(wall, R"("eye_m": [0, 0, -1.97])", R"("packing": "rows")"), at_projection,
                "{\"lower_left_m\":", "an eye more than 0.0335 m before"},
        });
}

TEST(LayoutMembersTest, WallsOfFourCornersAreRead)
{
    const auto corners = [](const std::string& list) { return projection(R"("type": "wall", "corners_m": )" + list); };
    const Wall w = shown_by<Wall>(corners("[[-1, -1, -2], [1, -0.9, -2], [0.8, 1, -2], [-1, 1.1, -2]]"));
    EXPECT_EQ(w.lower_left_m, glm::dvec3(-1, -1, -2));
    EXPECT_EQ(w.lower_right_m, glm::dvec3(1, -0.9, -2));
    EXPECT_EQ(*w.upper_right_m, glm::dvec3(0.8, 1, -2));
    EXPECT_EQ(w.upper_left_m, glm::dvec3(-1, 1.1, -2));
    const std::string at = at_projection + "/corners_m";
    expect_right({corners("[[-1, -1, -2.02], [1, -1, -2], [1, 1, -2.02], [-1, 1, -2]]")});
    expect_wrong(load_layout,
        {
            {corners("[[-1, -1, -2], [1, -1, -2], [1, 1, -2]]"), at, "[[-1,-1,-2],[1,-1,-2],[1,1,-2]]", "has length 3"},
            {corners("[[-1, -1, -2], [1, -1, -2], [-1, 1, -2], [1, 1, -2]]"), at + "/0", "[-1,-1,-2]", "bulges outwards"},
            {corners("[[-1, -1, -2], [1, -1, -2], [0, -0.9, -2], [-1, 1, -2]]"), at + "/2", "[0,-0.9,-2]",
                "bulges outwards"},
            {corners("[[-1, -1, -2], [-1, -1, -2], [1, 1, -2], [-1, 1, -2]]"), at + "/0", "[-1,-1,-2]", "bulges outwards"},
            {corners("[[-1, -1, -2.2], [1, -1, -2], [1, 1, -2.2], [-1, 1, -2]]"), at,
                "[[-1,-1,-2.2],[1,-1,-2],[1,1,-2.2],[-1,1,-2]]", "lies in no plane (70.7 mm off"},
            {projection(wall + R"(, "corners_m": [[-1, -1, -2], [1, -1, -2], [1, 1, -2], [-1, 1, -2]])"), at,
                "[[-1,-1,-2],[1,-1,-2],[1,1,-2],[-1,1,-2]]", "stands beside \"lower_left_m\""},
            {projection(R"("type": "wall", "lower_left_m": [-1, -1, -2])"), at_projection, "{\"lower_left_m\"",
                "lower_right_m"},
            {corners("[[-1, -1, 2], [1, -1, 2], [1, 1, 2], [-1, 1, 2]]"), at_projection, "{\"corners_m\"",
                "is seen from behind"},
        });
}

TEST(LayoutMembersTest, HandlesAreRead)
{
    const Viewport v = first(viewport(R"("quad": { "lower_left": [0.1, 0.9] },
        "grid": { "columns": 3, "rows": 4, "down": [0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0, 0, 0] })"))
                           .viewports.at(0);
    EXPECT_EQ(v.quad->lower_left, glm::dvec2(0.1, 0.9));
    EXPECT_EQ(v.quad->lower_right, glm::dvec2(1, 1));
    EXPECT_EQ(v.grid->down.at(4), 0.1);
    EXPECT_EQ(v.grid->right, std::vector<double>(12, 0));
    expect_wrong(load_layout,
        {
            {viewport(R"("grid": { "columns": 3, "rows": 3, "right": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0] })"), vp + "/grid/right",
                "[0,0,0,0,0,0,0,0,0,0]", "holds 10 numbers for 3 columns and 3 rows; 9 are right"},
            {viewport(R"("quad": { "upper_left": [0.1, 2.5] })"), vp + "/quad/upper_left/1", "2.5", "-1 to 2"},
            {viewport(R"("quad": { "top": [0, 0] })"), vp + "/quad/top", "[0,0]", "upper_left"},
        });
}

TEST(LayoutMembersTest, FisheyesAreRead)
{
    const Fisheye f = shown_by<Fisheye>(projection(R"("type": "fisheye", "aperture_deg": 170, "tilt_deg": 20,
        "rotation_deg": -15, "mapping": "equisolid", "centre": [0.5, 0.75], "diameter": 1.5)"));
    EXPECT_EQ(f.aperture_deg, 170);
    EXPECT_EQ(f.tilt_deg, 20);
    EXPECT_EQ(f.rotation_deg, -15);
    EXPECT_EQ(f.mapping, FisheyeMapping::equisolid);
    EXPECT_EQ(f.centre, glm::dvec2(0.5, 0.75));
    EXPECT_EQ(f.diameter, 1.5);
    const std::string p = R"("type": "fisheye", )";
    for (const auto& [name, mapping] :
        std::vector<std::pair<std::string, FisheyeMapping>>{{"equidistant", FisheyeMapping::equidistant},
            {"stereographic", FisheyeMapping::stereographic}, {"orthographic", FisheyeMapping::orthographic}})
        EXPECT_EQ(shown_by<Fisheye>(projection(p + "\"mapping\": \"" + name + "\"")).mapping, mapping);
    expect_right({projection(p + R"("mapping": "stereographic", "aperture_deg": 350)"),
        projection(p + R"("mapping": "equisolid", "aperture_deg": 360)"), projection(p + R"("diameter": 0.01)")});
    expect_wrong(load_layout,
        {
            {projection(p + R"("mapping": "orthographic", "aperture_deg": 181)"), at_projection + "/aperture_deg", "181",
                "more than an orthographic picture can hold"},
            {projection(p + R"("mapping": "stereographic", "aperture_deg": 351)"), at_projection + "/aperture_deg", "351",
                "more than a stereographic picture can hold"},
        });
}

TEST(LayoutMembersTest, CylindersPanoramasAndCubesAreRead)
{
    const std::string sides = R"("sides_deg": { "left": -90, "right": 100, "down": -20, "up": 30 })";
    const Cylinder c = shown_by<Cylinder>(projection(R"("type": "cylinder", )" + sides + ", " + turn));
    expect_sides(c.sides, -90, 100, -20, 30);
    expect_turn(c.turn, 1, -2, 3);
    const Equirectangular e = shown_by<Equirectangular>(projection(R"("type": "equirectangular", )" + sides + ", " + turn));
    expect_sides(e.sides, -90, 100, -20, 30);
    expect_turn(e.turn, 1, -2, 3);
    expect_sides(shown_by<Cylinder>(projection(R"("type": "cylinder")")).sides, -180, 180, -45, 45);
    expect_sides(shown_by<Equirectangular>(projection(R"("type": "equirectangular")")).sides, -180, 180, -90, 90);
    const CubeFaces cube = shown_by<CubeFaces>(projection(R"("type": "cube", "arrangement": "cross", )" + turn));
    EXPECT_EQ(cube.arrangement, CubeFaces::Arrangement::cross);
    expect_turn(cube.turn, 1, -2, 3);
    EXPECT_EQ(shown_by<CubeFaces>(projection(R"("type": "cube")")).arrangement, CubeFaces::Arrangement::row);
    const std::string at = at_projection + "/sides_deg";
    expect_right({projection(R"("type": "cylinder", "sides_deg": { "left": 0, "right": 360, "down": -89, "up": 89 })"),
        projection(R"("type": "cube", "arrangement": "row")")});
    expect_wrong(load_layout,
        {
            {projection(R"("type": "cylinder", "sides_deg": { "left": -180, "right": 181, "down": -20, "up": 20 })"),
                at + "/right", "181", "is more than a whole turn from \"left\""},
        });
}

TEST(LayoutMembersTest, MirrorsAreRead)
{
    const SphericalMirror m = shown_by<SphericalMirror>(
        projection(mirror + R"(, "dome_m": [0, 0.1, -0.2], "dome_tilt_deg": 10, "dome_aperture_deg": 170)"));
    EXPECT_EQ(m.projector_m, glm::dvec3(0, 0.5, -2));
    EXPECT_EQ(m.projector.fov_y_deg, 30);
    EXPECT_EQ(m.mirror_m, glm::dvec3(0, 0.5, -2.8));
    EXPECT_EQ(m.mirror_radius_m, 0.3);
    EXPECT_EQ(m.dome_m, glm::dvec3(0, 0.1, -0.2));
    EXPECT_EQ(m.dome_radius_m, 3);
    EXPECT_EQ(m.dome_tilt_deg, 10);
    EXPECT_EQ(m.dome_aperture_deg, 170);
    const auto with = [](std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    };
    expect_right({projection(mirror), projection(with(mirror, R"({ "fov_y_deg": 30 })", "{ " + turn + " }")),
        projection(mirror, R"("eye_m": [0, 0, 2.9])")});
    expect_wrong(load_layout,
        {
            {projection(with(mirror, R"("mirror_radius_m": 0.3)", R"("mirror_radius_m": 0.8)")),
                at_projection + "/projector_m", "[0,0.5,-2]", "lies inside the mirror's sphere"},
            {projection(with(mirror, R"("dome_radius_m": 3)", R"("dome_radius_m": 2.5)")), at_projection + "/mirror_m",
                "[0,0.5,-2.8]", "lies outside the dome"},
            {projection(mirror, R"("eye_m": [0, 0, 3])"), at_projection, "{\"dome_radius_m\":3", "is outside; "},
        });
}

TEST(LayoutMembersTest, LensesAreRead)
{
    const Lens l = shown_by<Lens>(projection(R"("type": "lens", "form": "panotools", "fov_y_deg": 100,
        "red": { "centre": [0.4, 0.5], "k": [0.1, 0.2, 0.3, 0.4] }, "green": { "k": [0, 0, 0, 1] },
        "blue": { "centre": [0.6, 0.5], "k": [0.5, 0.6, 0.7, 0.8] }, )"
        + turn));
    EXPECT_EQ(l.form, Lens::Form::panotools);
    EXPECT_EQ(l.fov_y_deg, 100);
    expect_turn(l.turn, 1, -2, 3);
    EXPECT_EQ(l.colours[0].centre, glm::dvec2(0.4, 0.5));
    EXPECT_EQ(l.colours[0].k, (std::array<double, 4>{0.1, 0.2, 0.3, 0.4}));
    EXPECT_EQ(l.colours[1].centre, glm::dvec2(0.5, 0.5));
    EXPECT_EQ(l.colours[1].k, (std::array<double, 4>{0, 0, 0, 1}));
    EXPECT_EQ(l.colours[2].k, (std::array<double, 4>{0.5, 0.6, 0.7, 0.8}));
    const Lens alike = shown_by<Lens>(projection(lens));
    EXPECT_EQ(alike.form, Lens::Form::vive);
    EXPECT_EQ(alike.colours[0].k, alike.colours[1].k);
    EXPECT_EQ(alike.colours[2].k, alike.colours[1].k);
    expect_wrong(load_layout,
        {
            {projection(lens + R"(, "form": "panotools", "red": { "k": [0, 0, 0, 0] })"), at_projection + "/green/k",
                "[0.1,0.02,0,0]", "makes the lens's factor 0 at radius 0"},
            {projection(lens + R"(, "red": { "k": [-2, 0, 0, 0] })"), at_projection + "/red/k", "[-2,0,0,0]",
                "makes the lens's factor "},
        });
}

/// The files that the layouts name exist, so that the mutations also reach warps and masks.
TEST(LayoutMembersTest, MutatedLayoutsLoadOrAreRefused)
{
    write_text("left.data", "x");
    write_text("table.cube", "LUT_1D_SIZE 2\n0 0 0\n1 1 1\n");
    expect_survives(load_layout,
        {projection(wall), projection(mirror), projection(lens + ", " + turn),
            top(R"("stereo": { "method": "reprojected", "baseline": "turning" }, "blend": { "ramps": true, "power": 2 })",
                R"("packing": "rows", "colour": { "lut": "table.cube" }, "monitor": { "position": [0, 0] })",
                R"("warp": { "file": "left.data" }, "eye_m": [0, 0, 1], "mask_gamma": 2)"),
            projection(R"("type": "fisheye", "mapping": "stereographic", "centre": [0.5, 0.5], "diameter": 1)")});
}

TEST(LayoutMembersTest, MutatedTablesLoadOrAreRefused)
{
    std::mt19937 random(1861);
    const std::string text = output(R"("colour": { "lut": "table.cube" })");
    int loaded = 0;
    for (int i = 0; i < fuzz_count() / 3; ++i) {
        write_text(
            "table.cube", mutated("TITLE \"a\"\nLUT_1D_SIZE 3\nDOMAIN_MIN 0 0 0\n0 0 0\n0.5 0.25 0.5\n1 1 1\n", random));
        try {
            const auto table = first(text).colour.lut;
            ++loaded;
            ASSERT_GE(table.size(), 2u);
            for (std::size_t k = 1; k < table.size(); ++k)
                for (int channel = 0; channel < 3; ++channel)
                    ASSERT_LE(table[k - 1][channel], table[k][channel]);
        } catch (const InputError& error) {
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(loaded, 0);
}

} // namespace layout_members_test
