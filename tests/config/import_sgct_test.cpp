#include "config/import/import_sgct.h"
#include "config/model/layout_reader.h"
#include "config/model/turn.h"
#include "tests/support/files.h"
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace import_sgct_test {

using namespace starbow;
using namespace starbow::testing;
using Json = nlohmann::ordered_json;

namespace {

Import imported(const std::string& text, int node = 0)
{
    return import_sgct(read_document(write_text("sgct.json", text)), node, "from");
}

Import sample(const std::string& name)
{
    return import_sgct(read_document(source_dir() / "tests/warp/sgct-configs" / (name + ".json")), 0, "from");
}

/// A configuration with one window of 800 x 400, its further members and its viewports.
std::string config(const std::string& viewports, const std::string& members = "", const std::string& users = "[]")
{
    return R"({ "version": 1, "masteraddress": "a", "nodes": [{ "address": "a", "port": 1, "windows": [{ "size": { "x": 800, "y": 400 }, )"
        + members + R"( "viewports": [)" + viewports + R"(] }] }], "users": )" + users + " }";
}
std::string with(const std::string& projection, const std::string& more = "")
{
    return R"({ "projection": )" + projection + more + " }";
}
const std::string sphere = R"({ "type": "EquirectangularProjection" })";

Json viewport(const std::string& text) { return imported(config(text)).layout["outputs"][0]["viewports"][0]; }

bool has(const Import& import, const std::string& line)
{
    return std::find(import.lines.begin(), import.lines.end(), line) != import.lines.end();
}

/// The pointers of all members without further objects or lists of objects.
void leaves(const nlohmann::json& json, const std::string& pointer, std::vector<std::string>& out)
{
    if (json.is_array() && !json.empty() && json[0].is_object())
        for (std::size_t i = 0; i < json.size(); ++i)
            leaves(json[i], pointer + "/" + std::to_string(i), out);
    else if (json.is_object())
        for (const auto& [name, value] : json.items())
            leaves(value, pointer + "/" + escaped(name), out);
    else
        out.push_back(pointer);
}

} // namespace

TEST(ImportSgctTest, EveryMemberOfEverySampleHasItsLine)
{
    int members = 0;
    for (const char* name : {"multi_window", "single", "single_cylindrical", "single_fisheye", "single_sbs_stereo",
             "single_two_win", "spherical_mirror"}) {
        SCOPED_TRACE(name);
        const Import import = sample(name);
        std::vector<std::string> pointers;
        leaves(read_document(source_dir() / "tests/warp/sgct-configs" / (std::string(name) + ".json")).root, "", pointers);
        for (const std::string& pointer : pointers) {
            ++members;
            const bool has_line = std::any_of(import.lines.begin(), import.lines.end(), [&](const std::string& line) {
                const std::string place = line.substr(0, line.find("  "));
                return pointer == place || pointer.starts_with(place + "/");
            });
            EXPECT_TRUE(has_line) << pointer;
        }
    }
    EXPECT_GT(members, 100);
}

TEST(ImportSgctTest, SamplesBecomeTheirLayouts)
{
    const Json walls = sample("multi_window").layout;
    ASSERT_EQ(walls["outputs"].size(), 5u);
    EXPECT_EQ(walls["stereo"]["separation_m"], 0.06);
    const Json& wall = walls["outputs"][0]["viewports"][0];
    EXPECT_EQ(wall["eye_m"], Json::parse("[0.0, 0.0, 4.0]"));
    EXPECT_EQ(wall["projection"],
        Json::parse(R"({ "type": "wall", "lower_left_m": [-1.778, 0.0, 0.0], "lower_right_m": [0.0, 0.0, 0.0],
        "upper_left_m": [-1.778, 1.0, 0.0] })"));
    EXPECT_EQ(walls["outputs"][4]["place"], Json::parse("[1000, 30]"));

    // The user stands 4 m before the origin, and the plane 10 m behind it.
    const Json flat = sample("single").layout["outputs"][0];
    EXPECT_EQ(flat["size"], Json::parse("[1280, 720]"));
    EXPECT_EQ(flat["viewports"][0]["projection"]["type"], "wall");
    EXPECT_EQ(flat["viewports"][0]["projection"]["lower_left_m"][2], -10.0);
    EXPECT_EQ(sample("single_sbs_stereo").layout["outputs"][0]["packing"], "side-by-side-half");
    EXPECT_EQ(sample("single_two_win").layout["outputs"][1]["viewports"][0]["projection"]["type"], "wall");
    const Json mirror = sample("spherical_mirror").layout["outputs"][0];
    EXPECT_EQ(mirror["name"], "Spherical-Projection");
    EXPECT_EQ(mirror["viewports"][0]["warp"]["file"], "from/mesh/standard_16x9.data");
    EXPECT_EQ(mirror["viewports"][0]["projection"]["type"], "fisheye");
}

TEST(ImportSgctTest, ViewportsCountFromTheUpperLeftCorner)
{
    // SGCT's upper right quarter, and a viewport that the window cuts off.
    EXPECT_EQ(viewport(R"({ "pos": { "x": 0.5, "y": 0.5 }, "size": { "x": 0.5, "y": 0.5 }, "projection": )" + sphere
                  + "}")["rect"],
        Json::parse("[0.5, 0.0, 0.5, 0.5]"));
    EXPECT_EQ(
        viewport(R"({ "pos": { "x": 0, "y": -0.25 }, "size": { "x": 2, "y": 0.5 }, "projection": )" + sphere + "}")["rect"],
        Json::parse("[0.0, 0.75, 1.0, 0.25]"));
}

TEST(ImportSgctTest, PlanarAnglesCountOutwards)
{
    const Json p = viewport(
        with(R"({ "type": "PlanarProjection", "fov": { "down": 35, "up": 15, "left": 10, "right": 70 } })"))["projection"];
    EXPECT_EQ(p["sides_deg"], Json::parse(R"({ "left": -10.0, "right": 70.0, "down": -35.0, "up": 15.0 })"));
    // A quaternion of the y-up frame: yaw to the right, then pitch up, then roll clockwise.
    const auto turn = [](double angle, const glm::dvec3& axis) { return glm::angleAxis(glm::radians(angle), axis); };
    const glm::dquat q = turn(-40, {0, 1, 0}) * turn(25, {1, 0, 0}) * turn(-10, {0, 0, 1});
    const Json t = viewport(with(R"({ "type": "PlanarProjection", "fov": { "hfov": 60, "vfov": 40 }, "orientation": { "x": )"
        + std::to_string(q.x) + ", \"y\": " + std::to_string(q.y) + ", \"z\": " + std::to_string(q.z)
        + ", \"w\": " + std::to_string(q.w) + " } }"))["projection"]["turn_deg"];
    EXPECT_NEAR(t["yaw"].get<double>(), 40, 1e-3); // six decimals above
    EXPECT_NEAR(t["pitch"].get<double>(), 25, 1e-3);
    EXPECT_NEAR(t["roll"].get<double>(), 10, 1e-3);
}

TEST(ImportSgctTest, TurnsAreRecoveredFromTheirAxes)
{
    for (double yaw : {-170.0, -90.0, 0.0, 33.0, 180.0})
        for (double pitch : {-89.0, -20.0, 0.0, 70.0})
            for (double roll : {-150.0, 0.0, 12.0}) {
                const auto turn = [](double angle, const glm::dvec3& axis) {
                    return glm::mat3_cast(glm::angleAxis(glm::radians(angle), axis));
                };
                const Turn back = turn_of(turn(-yaw, {0, 1, 0}) * turn(pitch, {1, 0, 0}) * turn(-roll, {0, 0, 1}));
                EXPECT_NEAR(std::remainder(back.yaw_deg - yaw, 360.0), 0, 1e-9);
                EXPECT_NEAR(back.pitch_deg, pitch, 1e-9);
                EXPECT_NEAR(back.roll_deg, roll, 1e-9);
            }
    // Straight up, the roll becomes a yaw, and the picture's axes stay.
    const Turn up = turn_of(glm::dmat3({0, 0, 1}, {-1, 0, 0}, {0, -1, 0}));
    EXPECT_NEAR(up.pitch_deg, 90, 1e-9);
    const double yaw = glm::radians(up.yaw_deg);
    EXPECT_NEAR(std::cos(yaw), 0, 1e-9); // its right is (0, 0, 1)
    EXPECT_NEAR(std::sin(yaw), 1, 1e-9);
}

TEST(ImportSgctTest, FisheyeCropsMoveTheCircle)
{
    // A quarter is cut off at the top and the bottom: the rest of the square is twice as wide as high, like the window.
    const Json p = viewport(with(
        R"({ "type": "FisheyeProjection", "fov": 200, "tilt": 27, "crop": { "left": 0, "right": 0, "bottom": 0.25, "top": 0.25 } })"))
        ["projection"];
    EXPECT_EQ(p["aperture_deg"], 200.0);
    EXPECT_EQ(p["tilt_deg"], 27.0);
    EXPECT_NEAR(p["diameter"].get<double>(), 2, 1e-12); // 800 of the shorter side's 400 pixels
    EXPECT_NEAR(p["centre"][0].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(p["centre"][1].get<double>(), 0.5, 1e-12);
    // Half is cut off at the bottom: the circle's centre lies on the window's lower edge.
    const Json low = viewport(with(
        R"({ "type": "FisheyeProjection", "crop": { "left": 0, "right": 0, "bottom": 0.5, "top": 0 } })"))["projection"];
    EXPECT_NEAR(low["centre"][1].get<double>(), 1, 1e-12);
    EXPECT_NEAR(low["diameter"].get<double>(), 2, 1e-12);
}

TEST(ImportSgctTest, EveryMemberOfAFieldOfViewHasItsLine)
{
    const std::string flat
        = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50, "distance": 2, "depth": 1 } })",
        at = "/nodes/0/windows/0/viewports/0/projection/fov/";
    const Import near = imported(config(with(flat)));
    EXPECT_TRUE(has(near, at + "hfov  -> the picture's edges"));
    EXPECT_TRUE(has(near, at + "distance  -> nothing: one eye at the origin sees the same at any distance"));
    EXPECT_TRUE(has(near, at + "depth  not mapped: SGCT's configurations have no such name here"));
    const Import two = imported(config(with(flat), R"("stereo": "side_by_side",)"));
    EXPECT_TRUE(has(two, at + "distance  -> the distance of the wall from the origin, m"));
    EXPECT_EQ(two.layout["outputs"][0]["viewports"][0]["projection"]["lower_left_m"][2], -2.0);
}

TEST(ImportSgctTest, PanoramasAreTurnedAsTheCubeMapIs)
{
    const Json p
        = viewport(with(R"({ "type": "CylindricalProjection", "rotation": 30, "heightoffset": -0.5 })"))["projection"];
    EXPECT_NEAR(p["turn_deg"]["yaw"].get<double>(), -75, 1e-12);
    EXPECT_NEAR(p["sides_deg"]["down"].get<double>(), -26.565051177, 1e-9); // atan 1/2
    EXPECT_NEAR(p["sides_deg"]["up"].get<double>(), 26.565051177, 1e-9);
    EXPECT_EQ(viewport(with(sphere))["projection"]["turn_deg"]["yaw"], 45.0);
}

TEST(ImportSgctTest, UsersMasksEyesAndNodesAreImported)
{
    const std::string users
        = R"([{ "eyeseparation": 0.07, "pos": { "x": 0, "y": 1, "z": 0 } }, { "name": "guide", "pos": { "x": 2, "y": 0, "z": 0 } }])";
    const Import import = imported(config(
        with(sphere,
            R"(, "user": "guide", "eye": "left", "blendmask": "m/../a.png", "blacklevelmask": "b.png", "tracked": true)"),
        R"("fullscreen": true, "monitor": 1, "name": "a", "stereo": "side_by_side_inverted", "shine": 3, "border": false,)",
        users));
    const Json output = import.layout["outputs"][0];
    EXPECT_EQ(output["whole_monitor"], true);
    EXPECT_EQ(output["packing"], "mono");
    EXPECT_EQ(output["viewports"][0]["eye"], "left");
    EXPECT_EQ(output["viewports"][0]["eye_m"], Json::parse("[2.0, 0.0, 0.0]"));
    EXPECT_EQ(output["viewports"][0]["alpha_mask"], "from/a.png");
    EXPECT_EQ(output["viewports"][0]["mask_gamma"], 2.2);
    EXPECT_FALSE(output["viewports"][0].contains("black_level"));
    EXPECT_TRUE(has(import, "/nodes/0/windows/0/shine  not mapped: SGCT's configurations have no such name here"));
    EXPECT_TRUE(has(import, "/nodes/0/windows/0/fullscreen  -> whole_monitor"));
    EXPECT_TRUE(has(import,
        "/nodes/0/windows/0/border  not mapped: a window has a frame unless it has monitor, whole_monitor or place"));

    const std::string two
        = R"({ "version": 1, "nodes": [{ "windows": [{ "size": { "x": 10, "y": 10 }, "name": "one", "viewports": [)"
        + with(sphere) + R"(] }] }, { "windows": [{ "size": { "x": 20, "y": 10 }, "name": "two", "viewports": [)"
        + with(sphere) + "] }] }] }";
    EXPECT_EQ(imported(two, 1).layout["outputs"][0]["name"], "two");
    EXPECT_TRUE(has(
        imported(two), "/nodes/1  not mapped: node 0 is taken; --node 1 takes this one, and all are taken without --node"));
    EXPECT_FALSE(imported(two, 1).layout["outputs"][0].contains("node"));
    EXPECT_NE(
        complaint([&] { imported(two, 2); }).find("/nodes: has no node 2; one from 0 to 1 is right"), std::string::npos);
}

TEST(ImportSgctTest, AMeshsOwnViewReplacesTheProjection)
{
    const std::string planar = R"({ "type": "PlanarProjection", "fov": { "hfov": 95, "vfov": 70 } })",
                      users = R"([{ "pos": { "x": 0, "y": 0, "z": 4 } }])";
    const auto made = [&](const std::string& mesh, const std::string& projection, const MeshView& view) {
        const std::string text
            = config(R"({ "projection": )" + projection + R"(, "mesh": "m/)" + mesh + R"(" })", "", users);
        return import_sgct(read_document(write_text("sgct.json", text)), 0, "from", [&](const std::filesystem::path& file) {
            EXPECT_EQ(file, "m/" + mesh);
            return view;
        });
    };
    // SCISS and SkySkan files also give the user's place; Scalable's do not.
    for (const auto& [mesh, eye] : {std::pair("a.sgc", "[1.0, 2.0, 3.0]"), std::pair("a.txt", "[1.0, 2.0, 3.0]"),
             std::pair("a.skyskan", "[1.0, 2.0, 3.0]"), std::pair("a.ol", "[0.0, 0.0, 4.0]")}) {
        SCOPED_TRACE(mesh);
        const Import import = made(mesh, planar, {true, glm::dvec3(1, 2, 3)});
        const Json viewport = import.layout["outputs"][0]["viewports"][0];
        EXPECT_FALSE(viewport.contains("projection"));
        EXPECT_EQ(viewport["warp"]["file"], "from/m/" + std::string(mesh));
        EXPECT_EQ(viewport["eye_m"], Json::parse(eye));
        EXPECT_TRUE(has(import, "/nodes/0/windows/0/viewports/0/projection  not mapped: replaced by the mesh's own"));
    }
    const auto viewport = [](const Import& import) { return import.layout["outputs"][0]["viewports"][0]; };
    EXPECT_FALSE(viewport(made("a.sgc", planar, {true, glm::dvec3(0)})).contains("eye_m"));
    // Files without a view, formats from which SGCT takes none, and projections that are not flat.
    EXPECT_EQ(viewport(made("a.ol", planar, {false, {}}))["projection"]["type"], "wall");
    EXPECT_EQ(viewport(made("a.csv", planar, {true, {}}))["projection"]["type"], "wall");
    EXPECT_EQ(viewport(made("a.sgc", sphere, {true, {}}))["projection"]["type"], "equirectangular");
}

TEST(ImportSgctTest, FullscreenWindowsGetMonitorsOfTheirOwn)
{
    const auto window = [](const std::string& members) {
        return R"({ "size": { "x": 80, "y": 40 }, )" + members + R"( "viewports": [)" + with(sphere) + "] }";
    };
    const auto both = [](const std::string& windows) {
        const Import import = imported(R"({ "version": 1, "nodes": [{ "windows": [)" + windows + "] }] }");
        const Document document = parse_document("layout.json", import.layout.dump());
        read_layout(root(document), scratch("layout.json")); // the layout must be readable
        return import;
    };
    const Import two = both(window(R"("fullscreen": true, "monitor": 0, "pos": { "x": 0, "y": 0 },)") + ","
        + window(R"("fullscreen": true, "monitor": 1,)"));
    EXPECT_EQ(two.layout["outputs"][0]["monitor"]["connector"], "SGCT-monitor-0");
    EXPECT_EQ(two.layout["outputs"][1]["monitor"]["connector"], "SGCT-monitor-1");
    EXPECT_FALSE(two.layout["outputs"][0].contains("place"));
    ASSERT_EQ(two.to_mend.size(), 2u);
    EXPECT_EQ(two.to_mend[1],
        "/outputs/1/monitor/connector: SGCT-monitor-1 stands in for the monitor's name; one that 'starbow displays' lists "
        "is "
        "right");
    const Import one = both(window(R"("fullscreen": true, "monitor": 1,)"));
    EXPECT_FALSE(one.layout["outputs"][0].contains("monitor"));
    EXPECT_TRUE(one.to_mend.empty());
    const Import mixed = both(window(R"("pos": { "x": 5, "y": 6 },)") + "," + window(R"("fullscreen": true,)"));
    EXPECT_FALSE(mixed.layout["outputs"][0].contains("monitor"));
    EXPECT_EQ(mixed.layout["outputs"][1]["monitor"]["connector"], "SGCT-monitor-0");
}

TEST(ImportSgctTest, AWindowWithoutSizeGetsOne)
{
    const auto of = [](const std::string& members) {
        return imported(R"({ "version": 1, "nodes": [{ "windows": [{ )" + members + R"( "viewports": [)"
            + with(R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50 } })") + "] }] }] }");
    };
    const Import wide = of(R"("res": { "x": 3840, "y": 2160 },)");
    EXPECT_EQ(wide.layout["outputs"][0]["size"], Json::parse("[1280, 720]"));
    ASSERT_EQ(wide.to_mend.size(), 1u);
    EXPECT_TRUE(wide.to_mend[0].starts_with("/outputs/0/size: [1280,720] stands in for two thirds of the main monitor"));
    EXPECT_EQ(of(R"("res": { "x": 4096, "y": 4096 },)").layout["outputs"][0]["size"], Json::parse("[720, 720]"));
    EXPECT_EQ(of("").layout["outputs"][0]["size"], Json::parse("[1280, 720]"));
    EXPECT_TRUE(of(R"("size": { "x": 10, "y": 20 },)").to_mend.empty());
}

TEST(ImportSgctTest, AClusterComesOverWhole)
{
    const auto node = [](const std::string& address, const std::string& name) {
        return R"({ "address": ")" + address + R"(", "port": 20401, "windows": [{ "name": ")" + name
            + R"(", "fullscreen": true, "size": { "x": 640, "y": 480 }, "viewports": [)" + with(sphere) + "] }] }";
    };
    const std::string text
        = R"({ "version": 1, "masteraddress": "10.0.0.2", "users": [{ "position": { "x": 0, "y": 0, "z": 4 },
        "eyeseparation": 0.06 }], "nodes": [)"
        + node("10.0.0.1", "wall") + ", " + node("10.0.0.2", "wall") + "] }";
    const Import import = import_sgct(read_document(write_text("cluster.json", text)), {}, "from");
    const Json& outputs = import.layout["outputs"];
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_EQ(outputs[0]["node"], "node0");
    EXPECT_EQ(outputs[1]["node"], "node1");
    EXPECT_NE(outputs[0]["name"], outputs[1]["name"]);
    EXPECT_FALSE(outputs[0].contains("monitor")) << "each covers the only monitor of its own machine";
    EXPECT_EQ(outputs[1]["viewports"][0]["eye_m"], Json::parse("[0.0, 0.0, 4.0]"));
    EXPECT_TRUE(has(import, "/users/0/position  -> eye_m of every viewport without a user of its own"));
    EXPECT_TRUE(std::ranges::any_of(import.lines, [](const std::string& line) {
        return line.starts_with("/masteraddress  -> ") && line.find(R"("master": "node1")") != line.npos;
    }));
    const Layout layout = load_layout(write_text("cluster-layout.json", import.layout.dump()));
    EXPECT_EQ(nodes_of(layout), (std::vector<std::string>{"node0", "node1"}));

    std::string elsewhere = text;
    elsewhere.replace(elsewhere.find("10.0.0.2"), 8, "dome.lan");
    const Import guessed = import_sgct(read_document(write_text("cluster.json", elsewhere)), {}, "from");
    EXPECT_TRUE(std::ranges::any_of(guessed.lines, [](const std::string& line) {
        return line.find(R"("master": "node0")") != line.npos
            && line.ends_with("No node has the address dome.lan, so node0 is a guess");
    }));
}

TEST(ImportSgctTest, AWindowOfControlsIsLeftOut)
{
    const auto window = [](const std::string& members) {
        return R"({ "size": { "x": 80, "y": 40 }, )" + members + R"( "viewports": [)" + with(sphere) + "] }";
    };
    const Import import
        = imported(R"({ "version": 1, "nodes": [{ "windows": [)" + window(R"("name": "controls", "draw3d": false,)") + ", "
            + window(R"("name": "world", "draw3d": true,)") + "] }] }");
    ASSERT_EQ(import.layout["outputs"].size(), 1u);
    EXPECT_EQ(import.layout["outputs"][0]["name"], "world");
    EXPECT_TRUE(has(import,
        "/nodes/0/windows/0  not mapped: draws no 3D scene (\"draw3d\": false), only SGCT's controls; the window is left "
        "out"));
    EXPECT_TRUE(has(import, "/nodes/0/windows/1/draw3d  -> the output shows the world"));
}

TEST(ImportSgctTest, TwoEyesGetTheFactorOfTheShippedWorlds)
{
    const std::string users = R"([{ "eyeseparation": 0.07 }])";
    const auto stereo = [&](const std::string& viewport, const std::string& members) {
        return imported(config(viewport, members, users)).layout["stereo"];
    };
    EXPECT_EQ(stereo(with(sphere), R"("stereo": "none",)"), Json::parse(R"({ "separation_m": 0.07 })"));
    const Json two = Json::parse(R"({ "separation_m": 0.07, "hyper_stereo": 1.5e8 })");
    EXPECT_EQ(stereo(with(sphere), R"("stereo": "top_bottom",)"), two);
    EXPECT_EQ(stereo(with(sphere, R"(, "eye": "left")"), ""), two);
    EXPECT_TRUE(has(imported(config(with(sphere), R"("stereo": "top_bottom",)", users)),
        "/nodes  -> /stereo/hyper_stereo 150000000, for the shipped worlds, whose unit is a light-second; 1 for worlds "
        "in "
        "metres"));
}

TEST(ImportSgctTest, AnotherPfmThanATextureMappedOneIsNotRead)
{
    const std::string flat = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50 } })",
                      mapped = R"({ "type": "TextureMappedProjection", "fov": { "hfov": 80, "vfov": 50 } })",
                      mesh = R"(, "mesh": "m.pfm")";
    EXPECT_FALSE(viewport(with(flat, mesh)).contains("warp"));
    EXPECT_EQ(viewport(with(mapped, mesh))["warp"],
        Json::parse(R"({ "file": "from/m.pfm", "first_row": "top", "v": "up", "samples": "edges" })"));
    EXPECT_FALSE(viewport(with(mapped, mesh + R"(, "size": { "x": 0.5, "y": 1 })")).contains("warp"));
    EXPECT_EQ(viewport(with(flat, R"(, "mesh": "m.obj")"))["warp"], Json::parse(R"({ "file": "from/m.obj" })"));
}

TEST(ImportSgctTest, OldXmlIsNamed)
{
    for (const char* text :
        {"<?xml version=\"1.0\" ?>\n<Cluster masterAddress=\"localhost\"/>", "\xef\xbb\xbf \n<Cluster/>"})
        EXPECT_NE(complaint([&] {
            read_sgct(write_text("old.xml", text));
        }).find("old.xml: is XML, which SGCT read until its version 2; the JSON that SGCT reads since version 3"),
            std::string::npos);
    EXPECT_EQ(read_sgct(write_text("new.json", "{}")).root.size(), 0u);
    EXPECT_NE(complaint([] { read_sgct(scratch("none.json")); }).find("none.json"), std::string::npos);
}

TEST(ImportSgctTest, UnsupportedMembersAreNamed)
{
    const std::string mirror = R"({ "type": "SphericalMirrorProjection",
        "geometry": { "bottom": "b.sgc", "left": "l", "right": "r", "top": "t" } })";
    const Import import = imported(config(with(mirror) + ", " + with(sphere)));
    EXPECT_EQ(import.layout["outputs"][0]["viewports"].size(), 1u);
    EXPECT_TRUE(has(import,
        "/nodes/0/windows/0/viewports/0  not mapped: has no projection of a kind that a layout has; the viewport is left "
        "out"));
    const std::string nothing = complaint([&] { imported(config(with(mirror))); });
    EXPECT_NE(nothing.find("/nodes/0: has no window that can be imported: "
                           "/nodes/0/windows/0/viewports/0/projection/geometry/bottom is not a Bourke mesh (.data)"),
        std::string::npos)
        << nothing;
    EXPECT_NE(complaint([&] { imported(R"({ "version": 2, "nodes": [{}] })"); }).find("/version: 2 is too large"),
        std::string::npos);
    EXPECT_NE(complaint([&] { imported("{}"); }).find("lacks \"nodes\""), std::string::npos);
    const auto fov
        = [](const std::string& value) { return config(with(R"({ "type": "PlanarProjection", "fov": )" + value + " }")); };
    const std::string at = "/nodes/0/windows/0/viewports/0/projection/fov";
    EXPECT_NE(complaint([&] { imported(fov(R"({ "hfov": 200, "vfov": 40 })")); }).find(at + "/hfov: 200 is too large"),
        std::string::npos);
    EXPECT_NE(complaint([&] { imported(fov(R"({ "left": -20, "right": 10, "up": 1, "down": 1 })")); }).find(at + ": "),
        std::string::npos);
    EXPECT_NE(complaint([&] { imported(fov(R"({ "left": 20 })")); }).find("lacks \"right\""), std::string::npos);
}

TEST(ImportSgctTest, MutatedConfigurationsAreReadOrRefused)
{
    std::vector<std::string> seeds;
    for (const auto& file : shipped("tests/warp/sgct-configs"))
        seeds.push_back(read_text(file));
    expect_survives(
        [](const std::filesystem::path& file) { import_sgct(read_document(file), 0, "from"); }, seeds, fuzz_count() / 10);
}

} // namespace import_sgct_test
