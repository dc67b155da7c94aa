#include "tests/support/warp_fixture.h"
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace starbow::warp_test::warp_formats_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

void expect_turn(const Turn& turn, double yaw, double pitch, double roll, double tolerance)
{
    EXPECT_NEAR(turn.yaw_deg, yaw, tolerance);
    EXPECT_NEAR(turn.pitch_deg, pitch, tolerance);
    EXPECT_NEAR(turn.roll_deg, roll, tolerance);
}

// The four encodings agree to this: the .csv has six decimals, the .sgc floats near 1, the .simcad all digits.
constexpr double encodings_agree = 1e-6;

TEST(WarpFormatsTest, FourEncodingsOfEachChannelAgree)
{
    for (int channel = 1; channel <= 3; ++channel) {
        SCOPED_TRACE(channel);
        const std::string stem = "channel" + std::to_string(channel) + "_warp";
        std::vector<WarpMesh> meshes;
        for (const char* end : {"_mesh.csv", ".simcad", "_u2.sgc", "_u3.sgc"})
            meshes.push_back(load_warp({sample_path(stem + end), {}, {}, {}}));
        for (const WarpMesh& mesh : meshes) {
            SCOPED_TRACE(mesh.format);
            EXPECT_EQ(mesh.grid, glm::ivec2(33));
            ASSERT_EQ(mesh.vertices.size(), 1089u);
            EXPECT_EQ(mesh.triangles, meshes[0].triangles);
            double at = 0, place = 0;
            for (std::size_t i = 0; i < 1089; ++i) {
                const glm::dvec2 there = glm::abs(mesh.vertices[i].at - meshes[0].vertices[i].at),
                                 seen = glm::abs(glm::dvec2(mesh.vertices[i].sees[0] - meshes[0].vertices[i].sees[0]));
                at = std::max({at, there.x, there.y});
                place = std::max({place, seen.x, seen.y});
            }
            EXPECT_LE(at, encodings_agree);
            EXPECT_LE(place, encodings_agree);
        }
        // The .csv has the frustum in degrees, the .sgc a quaternion of floats.
        for (int i : {2, 3}) {
            const Sides csv = meshes[0].frustum.value().sides.value(), sgc = meshes[i].frustum.value().sides.value();
            EXPECT_NEAR(csv.left_deg, sgc.left_deg, 1e-5);
            EXPECT_NEAR(csv.right_deg, sgc.right_deg, 1e-5);
            EXPECT_NEAR(csv.down_deg, sgc.down_deg, 1e-5);
            EXPECT_NEAR(csv.up_deg, sgc.up_deg, 1e-5);
            const Turn turn = meshes[0].frustum->turn;
            expect_turn(meshes[i].frustum->turn, turn.yaw_deg, turn.pitch_deg, turn.roll_deg, 1e-4);
            EXPECT_EQ(meshes[i].eye_m, meshes[0].eye_m);
        }
        EXPECT_NEAR(meshes[0].frustum->turn.yaw_deg, 90 * channel - 135, 1e-5);
    }
}

TEST(WarpFormatsTest, BourkesSampleHasItsGridAndPlaces)
{
    const WarpMesh mesh = load_warp({sample_path("standard_16x9.data"), {}, {}, {}});
    EXPECT_EQ(mesh.grid, glm::ivec2(100, 60));
    EXPECT_EQ(mesh.triangles.size(), 2u * 99 * 59);
    // The file's first row is the picture's lowest. Its first line is "-1.77778 -1 0.160825 0.86737 0.530521".
    const WarpVertex& lower_left = mesh.vertices[59 * 100];
    EXPECT_NEAR(lower_left.at.x, 0, 1e-12);
    EXPECT_NEAR(lower_left.at.y, 1, 1e-12);
    EXPECT_NEAR(lower_left.sees[0].x, 0.160825, 1e-12);
    EXPECT_NEAR(lower_left.sees[0].y, 1 - 0.86737, 1e-12);
    EXPECT_NEAR(lower_left.intensity, 0.530521, 1e-12);
    EXPECT_NEAR(mesh.vertices[99].at.x, 1, 1e-12);
    EXPECT_NEAR(mesh.vertices[99].at.y, 0, 1e-12);
}

TEST(WarpFormatsTest, BourkesNegativeIntensitiesAreHoles)
{
    const WarpMesh mesh = read("a.data", bourke);
    ASSERT_EQ(mesh.grid, glm::ivec2(3, 2));
    EXPECT_EQ(mesh.vertices[2].at, glm::dvec2(1, 0));
    EXPECT_EQ(mesh.vertices[5].intensity, 0.5);
    EXPECT_EQ(mesh.triangles.size(), 1u); // a hole in the middle of the upper row removes three of four triangles
    EXPECT_FALSE(used(mesh)[1]);
    const WarpMesh outside = read("a.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1.01 1\n1 1 1 1 1\n");
    EXPECT_EQ(outside.triangles.size(), 1u);
}

// A mesh that ends before the screen's edge: only the layout knows where that is.
TEST(WarpFormatsTest, ALayoutMaySayABourkeMeshsAspect)
{
    const std::string part = "2\n2 2\n-0.5 -1 0 0 1\n1 -1 1 0 1\n-0.5 1 0 1 1\n1 1 1 1 1\n";
    const auto ends = [](const WarpMesh& mesh) { return glm::dvec2(mesh.vertices[0].at.x, mesh.vertices[1].at.x); };
    EXPECT_EQ(ends(read("a.data", part)), glm::dvec2(0.25, 1));
    EXPECT_EQ(ends(read_warp({"a.data", part}, {.aspect = 2.0})), glm::dvec2(0.375, 0.75));
    EXPECT_EQ(ends(read_warp({"a.data", part + "aspect 4\n"}, {.aspect = 2.0})), glm::dvec2(0.375, 0.75));
    EXPECT_NE(complaint([&] {
        read_warp({"a.obj", "v 0 0 0\n"}, {.aspect = 2.0});
    }).find("whose aspect it does not need"),
        std::string::npos);
}

TEST(WarpFormatsTest, DomeprojectionMissingVerticesAreHoles)
{
    std::string text = "x;y;u;v;column;row\n";
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            if (row != 0 || column != 0)
                text += std::to_string(column / 2.0) + ";" + std::to_string(row / 2.0) + ";0.5;0.25;"
                    + std::to_string(column) + ";" + std::to_string(row) + "\n";
    const WarpMesh mesh = read("a_mesh.csv", text);
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_FALSE(mesh.frustum.has_value());
    EXPECT_EQ(mesh.vertices[4].sees[0], glm::dvec3(0.5, 0.25, 0)); // v points down, as in WarpMesh
}

TEST(WarpFormatsTest, AFrustumsAnglesCountOutwards)
{
    const WarpFrustum f
        = read_frustum({"f.csv", "x;y;z;heading;pitch;bank;left;right;bottom;top\n1;2;3;30;20;10;25;26;-7;40\n"});
    EXPECT_EQ(f.planar.sides->left_deg, -25);
    EXPECT_EQ(f.planar.sides->right_deg, 26);
    EXPECT_EQ(f.planar.sides->down_deg, 7);
    EXPECT_EQ(f.planar.sides->up_deg, 40);
    expect_turn(f.planar.turn, 30, 20, 10, 0);
    EXPECT_EQ(f.eye_m, glm::dvec3(1, 2, 3));
}

TEST(WarpFormatsTest, SimcadOffsetsMoveVertices)
{
    const WarpMesh mesh = read("a.simcad", simcad);
    EXPECT_EQ(mesh.vertices[1].at, glm::dvec2(1.05, 0));
    EXPECT_EQ(mesh.vertices[2].at, glm::dvec2(0, 0.9)); // y points down: up by 5 of 50 pixels
    EXPECT_EQ(mesh.vertices[2].sees[0], glm::dvec3(0, 1, 0));
}

/// Writes a SCISS file.
std::string sgc(int version, std::uint32_t type, const std::vector<float>& view, std::array<std::uint32_t, 2> size,
    const std::vector<float>& vertices, const std::vector<std::uint32_t>& indices)
{
    std::string out = "SGC" + std::string(1, char(version));
    const auto word = [&](std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8)
            out += char(value >> shift);
    };
    word(type);
    for (float v : view)
        word(std::bit_cast<std::uint32_t>(v));
    word(size[0]);
    word(size[1]);
    for (float v : vertices)
        word(std::bit_cast<std::uint32_t>(v));
    word(std::uint32_t(indices.size()));
    for (std::uint32_t i : indices)
        word(i);
    return out;
}

TEST(WarpFormatsTest, ScissTurnsAndTrianglesAreRead)
{
    // Yaw to the right, then pitch up, then roll clockwise, as three quaternions of the y-up frame.
    const auto turn = [](double angle, const glm::dvec3& axis) { return glm::angleAxis(glm::radians(angle), axis); };
    const glm::dquat q = turn(-130, {0, 1, 0}) * turn(40, {1, 0, 0}) * turn(-25, {0, 0, 1});
    const std::vector<float> view{float(q.x), float(q.y), float(q.z), float(q.w), 1, 2, 3, 20, -10, -30, 25};
    const std::vector<float> square{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0};
    const WarpMesh mesh = read("a.sgc", sgc(2, 0, view, {4, 4}, square, {0, 1, 2, 0, 2, 3}));
    expect_turn(mesh.frustum.value().turn, 130, 40, 25, 1e-4); // floats
    EXPECT_NEAR(mesh.frustum->sides->left_deg, -30, 1e-5);
    EXPECT_NEAR(mesh.frustum->sides->down_deg, -10, 1e-5);
    EXPECT_EQ(mesh.eye_m, glm::dvec3(1, 2, 3));
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.vertices[0].at, glm::dvec2(0, 0)); // y down
    EXPECT_EQ(mesh.vertices[0].sees[0], glm::dvec3(0, 0, 0)); // v up
    // A strip whose order is not a grid's.
    EXPECT_EQ(read("a.sgc", sgc(2, 0, view, {5, 4}, square, {1, 0, 2, 3})).triangles.size(), 2u);
    // A cube map's directions, rotated.
    const std::vector<float> ahead{0, 0, 0, 0, 0, -1, 1, 0, 0, 0, 0, -1, 1, 1, 0, 0, 0, -2};
    const WarpMesh cube = read("a.sgc", sgc(2, 1, view, {4, 3}, ahead, {0, 1, 2}));
    EXPECT_EQ(cube.kind, WarpMesh::Kind::colours);
    const double yaw = glm::radians(130.0), pitch = glm::radians(40.0);
    expect_near(cube.vertices[2].sees[1],
        {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)}, 1e-6);
}

TEST(WarpFormatsTest, ScalableCountsFromTheLowerLeft)
{
    const WarpMesh mesh = read("a.ol", scalable);
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[0].at, glm::dvec2(0, 1)); // y up, from the lower left
    EXPECT_EQ(mesh.vertices[0].sees[0], glm::dvec3(0, 1, 0));
    EXPECT_NEAR(mesh.vertices[3].at.y, 0.1, 1e-12);
    EXPECT_NEAR(mesh.vertices[2].intensity, 0.2, 1e-12);
    expect_turn(mesh.frustum.value().turn, 30, 20, 10, 0);
    EXPECT_EQ(mesh.frustum->sides->up_deg, 16);
    std::string turned = scalable;
    turned.replace(turned.find("NATIVEXRES"), 0, "ORTHO_TOP 0\r\nORTHO_BOTTOM 1\r\n");
    EXPECT_EQ(read("a.ol", turned).vertices[0].at, glm::dvec2(0, 0));
}

TEST(WarpFormatsTest, SkyskanHasHolesAndTweaks)
{
    const WarpMesh mesh = read("a.txt", skyskan);
    EXPECT_EQ(mesh.triangles.size(), 2u); // the lower right vertex is a hole, and both triangles of that cell use it
    EXPECT_EQ(mesh.vertices[3].at, glm::dvec2(0, 1));
    EXPECT_EQ(mesh.vertices[3].sees[0], glm::dvec3(0, 1, 0));
    expect_turn(mesh.frustum.value().turn, 30, 40, 0, 0);
    EXPECT_EQ(mesh.frustum->sides->up_deg, 30);
    std::string short_one = skyskan;
    short_one.erase(short_one.find("Vertical"), 16);
    const double half = std::atan(1200.0 / 2048 * std::tan(glm::radians(45.0)));
    EXPECT_NEAR(read("a.txt", short_one).frustum->sides->up_deg, glm::degrees(half), 1e-9);
    std::string tweaked = skyskan;
    tweaked.insert(0, "Horizontal Tweak=0.5\nU Tweak=0.5\n");
    EXPECT_EQ(read("a.txt", tweaked).frustum->sides->right_deg, 22.5);
    EXPECT_EQ(read("a.txt", tweaked).vertices[2].sees[0].x, 0.5);
}

TEST(WarpFormatsTest, ObjIndicesMayCountFromTheEnd)
{
    const WarpMesh mesh = read("a.obj", obj);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.vertices[0].at, glm::dvec2(0, 1));
    EXPECT_EQ(mesh.vertices[0].sees[0], glm::dvec3(0, 1, 0));
    // Indices counted from the end, a polygon, and one vertex with two texture coordinates.
    const WarpMesh other = read("a.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf -4/-4 -3/-3 -2/-2 -1/-1\nf 1/2 2/3 "
        "3/4\n");
    EXPECT_EQ(other.triangles.size(), 3u);
    EXPECT_EQ(other.vertices.size(), 7u);
}

TEST(WarpFormatsTest, ObjMeshesAreReadAsBlenderAndMeshLabWriteThem)
{
    const std::string rest = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    const WarpMesh plain = read("a.obj", "v -1 -1 0\nv 1 -1 0\nv 1 0.5 0\nv -1 0.5 0\n" + rest);
    EXPECT_TRUE(plain.notes.empty());
    // Blender's default axes: its plane's y becomes -z.
    const WarpMesh lying = read("a.obj", "v -1 0 1\nv 1 0 1\nv 1 -0.000000 -0.5\nv -1 0 -0.5\n" + rest);
    // Colours after the place, with opacity and without; and the weight that the format knows.
    const WarpMesh coloured
        = read("a.obj", "v -1 -1 0 1 0.5 0.2\nv 1 -1 0 1 0.5 0.2\nv 1 0.5 0 0.1 0.2 0.3 1\nv -1 0.5 0 1\n" + rest);
    for (const WarpMesh& mesh : {lying, coloured}) {
        ASSERT_EQ(mesh.vertices.size(), plain.vertices.size());
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            EXPECT_EQ(mesh.vertices[i].at, plain.vertices[i].at) << i;
            EXPECT_EQ(mesh.vertices[i].sees[0], plain.vertices[i].sees[0]) << i;
        }
    }
    EXPECT_EQ(plain.vertices[2].at, glm::dvec2(1, 0.25));
    EXPECT_EQ(lying.notes.size(), 1u);
    EXPECT_EQ(coloured.notes, std::vector<std::string>{"colours of vertices are not used"});
    EXPECT_THROW(read("a.obj", "v -1 -1 0 1 0.5\n" + rest), InputError);
    EXPECT_THROW(read("a.obj", "v -1 -1 0 1 red 0.2\n" + rest), InputError);
}

TEST(WarpFormatsTest, HeadsetMeshesHaveThreeDirections)
{
    const WarpMesh mesh = read("a.mesh", headset);
    EXPECT_EQ(mesh.kind, WarpMesh::Kind::colours);
    EXPECT_EQ(mesh.vertices[2].at, glm::dvec2(0, 1));
    expect_near(mesh.vertices[1].sees[0], glm::dvec3(1, 1, -1) / std::sqrt(3.0), 1e-15);
    expect_near(mesh.vertices[1].sees[2], glm::dvec3(1.2, 1.2, -1) / std::sqrt(1 + 2 * 1.44), 1e-15);
}

TEST(WarpFormatsTest, PfmMayHaveEitherByteAndRowOrder)
{
    std::vector<float> values = identity_map(4, 3);
    values[0] = 0.2f; // the lower left pixel
    for (bool little : {true, {}}) {
        const WarpMesh mesh = read("a.pfm", pfm(4, 3, values, little));
        EXPECT_EQ(mesh.grid, glm::ivec2(6, 5));
        const WarpVertex& lower_left = mesh.vertices[3 * 6 + 1];
        EXPECT_NEAR(lower_left.at.x, 0.125, 1e-15);
        EXPECT_NEAR(lower_left.at.y, 2.5 / 3, 1e-15);
        EXPECT_EQ(lower_left.sees[0], glm::dvec3(0.2f, 2.5f / 3, 0));
        const WarpMesh top = read("a.pfm", pfm(4, 3, values, little), "", {true});
        EXPECT_EQ(top.vertices[1 * 6 + 1].sees[0], glm::dvec3(0.2f, 2.5f / 3, 0));
    }
}

TEST(WarpFormatsTest, PfmReachesTheEdgesAndLeavesHoles)
{
    std::vector<float> values = identity_map(4, 3);
    const WarpMesh whole = read("a.pfm", pfm(4, 3, values));
    for (const WarpVertex& vertex : whole.vertices) // floats
        expect_near(vertex.sees[0], glm::dvec3(vertex.at, 0), 1e-6);
    values[3 * 5] = nan; // column 1 of the middle row
    const WarpMesh mesh = read("a.pfm", pfm(4, 3, values));
    EXPECT_FALSE(used(mesh)[2 * 6 + 2]);
    EXPECT_EQ(mesh.triangles.size(), whole.triangles.size() - 6); // the triangles around an inner vertex
}

TEST(WarpFormatsTest, TheMpcdiSampleHasItsFrustumAndOffsets)
{
    const WarpMesh mesh
        = load_warp({sample_path("correction_mesh.mpcdi"), {}, {}, {.first_row_on_top = true, .offsets = true}});
    EXPECT_EQ(mesh.format, "MPCDI 2.0, profile 3d, region surface1_region");
    EXPECT_EQ(mesh.grid, glm::ivec2(32));
    expect_turn(mesh.frustum.value().turn, 326.675157, 27.327616, -14.611227, 0);
    EXPECT_EQ(mesh.frustum->sides->up_deg, 34.644394);
    // Its values are offsets with y up: the first is -0.104621 0.126087.
    EXPECT_NEAR(mesh.vertices[0].at.x, -0.104621, 1e-6);
    EXPECT_NEAR(mesh.vertices[0].at.y, -0.126087, 1e-6);
    EXPECT_EQ(mesh.vertices[31].sees[0], glm::dvec3(1, 0, 0));
    EXPECT_FALSE(mesh.alpha.has_value());
}

TEST(WarpFormatsTest, OnlyTheFormDecidesBetweenPlacesAndOffsets)
{
    // Offsets of one sign, of both, and none at all: each is a map of places too, of one corner of the picture.
    const auto constant = [](float x, float y) {
        std::vector<float> values;
        for (int i = 0; i < 12; ++i)
            values.insert(values.end(), {x, y, 0});
        return pfm(4, 3, values);
    };
    const std::string xml
        = mpcdi_xml("3d", "<buffer id=\"b\">" + region_xml("r", frustum_xml) + "</buffer>", fileset_xml("r", "r.pfm"));
    for (const glm::vec2 offset : {glm::vec2(0), glm::vec2(0.02f, 0.03f), glm::vec2(-0.02f, 0.03f)})
        for (const bool archive : {false, true}) {
            SCOPED_TRACE(std::to_string(offset.x) + (archive ? " in MPCDI" : ""));
            const std::string map = constant(offset.x, offset.y), name = archive ? "a.mpcdi" : "a.pfm",
                              bytes = archive ? zipped({{"mpcdi.xml", xml}, {"r.pfm", map}}) : map;
            const WarpMesh moved = read(name, bytes, "", {.offsets = true});
            ASSERT_EQ(moved.grid, glm::ivec2(4, 3));
            for (std::size_t i = 0; i < moved.vertices.size(); ++i) {
                const glm::dvec2 grid(double(i % 4) / 3, double(i / 4) / 2);
                expect_near(moved.vertices[i].sees[0], glm::dvec3(grid, 0), 1e-12);
                expect_near(glm::dvec3(moved.vertices[i].at, 0), glm::dvec3(grid.x + offset.x, grid.y - offset.y, 0), 1e-7);
            }
            EXPECT_TRUE(moved.warnings.empty());
            if (offset.x < 0) { // half a picture beside the picture can't be meant
                EXPECT_NE(
                    complaint([&] { read(name, bytes); })
                        .find("12 of 12 places outside the picture; places from 0 to 1 are right, or for offsets from a "
                              "regular grid --offsets, and in a layout \"values\": \"offsets\""),
                    std::string::npos);
                continue;
            }
            const WarpMesh placed = read(name, bytes);
            EXPECT_EQ(placed.vertices[0].sees[0].x, offset.x);
            ASSERT_EQ(placed.warnings.size(), 2u);
            EXPECT_NE(placed.warnings[0].find("lie near 0"), std::string::npos);
            EXPECT_NE(placed.warnings[1].find("one and the same direction"), std::string::npos);
        }
    EXPECT_TRUE(read("a.pfm", pfm(4, 3, identity_map(4, 3))).warnings.empty());
    // Without the row order the sample's mesh would fold; the reader says how to try the other one.
    const WarpMesh turned = load_warp({sample_path("correction_mesh.mpcdi"), {}, {}, {.offsets = true}});
    ASSERT_EQ(turned.warnings.size(), 1u);
    EXPECT_NE(turned.warnings[0].find("--first-row-on-top"), std::string::npos);
}

TEST(WarpFormatsTest, PlacesMayCountUpwardsAndReachFromEdgeToEdge)
{
    std::vector<float> values;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            values.insert(values.end(), {0.1f + 0.2f * x, 0.2f + 0.3f * y, 0});
    const WarpMesh up = read("a.pfm", pfm(4, 3, values), "", {.v_up = true});
    EXPECT_EQ(up.cells, glm::ivec2(4, 3));
    EXPECT_NEAR(up.vertices[3 * 6 + 1].sees[0].y, 1 - double(0.2f), 1e-12); // the file's first value, in the lowest row
    const WarpMesh edges = read("a.pfm", pfm(4, 3, values), "", {.edge_to_edge = true});
    EXPECT_EQ(edges.grid, glm::ivec2(4, 3));
    EXPECT_EQ(edges.vertices[8].at, glm::dvec2(0, 1));
    EXPECT_EQ(edges.vertices[8].sees[0], glm::dvec3(0.1f, 0.2f, 0));
    values[3 * 5] = nan;
    EXPECT_FALSE(used(read("a.pfm", pfm(4, 3, values), "", {.edge_to_edge = true}))[5]);
    EXPECT_NE(complaint([&] {
        read("a.pfm", pfm(1, 3, {0, 0, 0, 0, 1, 0, 1, 1, 0}), "", {.edge_to_edge = true});
    }).find("1 x 3 samples reach from no edge to the other"),
        std::string::npos);
    EXPECT_NE(complaint([&] {
        read("a.pfm", pfm(4, 3, values), "", {.v_up = true, .offsets = true});
    }).find("holds offsets, which are upwards"),
        std::string::npos);
    EXPECT_NE(complaint([&] { read("a.data", bourke, "", {.v_up = true}); }).find("says itself whether v counts up or down"),
        std::string::npos);
}

TEST(WarpFormatsTest, AMeshThatShowsOneDirectionIsDoubted)
{
    std::string point = bourke;
    for (const char* from : {" 0 0 1\n", " 0.5 0 1", " 1 0 0.5", " 0 1 1\n", " 0.5 1 -1", " 1 1 1\n"})
        point.replace(point.find(from), std::string(from).size(),
            std::string(" 0.25 0.25 1") + (std::string(from).ends_with('\n') ? "\n" : ""));
    ASSERT_EQ(read("a.data", point).warnings, std::vector<std::string>{"every pixel shows one and the same direction"});
    EXPECT_TRUE(read("a.data", bourke).warnings.empty());
    EXPECT_TRUE(read("a.mesh", headset).warnings.empty());
    std::string straight = headset;
    for (const char* from :
        {"-1 1 -1.1 1.1 -1.2 1.2", "1 1 1.1 1.1 1.2 1.2", "-1 -1 -1.1 -1.1 -1.2 -1.2", "1 -1 1.1 -1.1 1.2 -1.2"})
        straight.replace(straight.find(from), std::string(from).size(), "0 0 0 0 0 0");
    EXPECT_EQ(read("a.mesh", straight).warnings.size(), 1u);
    // Points of a room along one line of sight.
    std::string files = fileset_xml("r", "p.pfm");
    files.insert(
        files.find("<interpolation>"), "<geometricUnit>m</geometricUnit><originOf3DData>idealEyePoint</originOf3DData>");
    const std::string archive
        = zipped({{"mpcdi.xml", mpcdi_xml("a3", "<buffer id=\"b\">" + region_xml("r", "") + "</buffer>", files)},
            {"p.pfm", pfm(2, 2, {1, 2, -3, 1.25f, 2.5f, -3.75f, 1.5f, 3, -4.5f, 1.75f, 3.5f, -5.25f})}});
    EXPECT_EQ(read("a.mpcdi", archive).warnings.size(), 1u);
    EXPECT_NE(complaint([&] { read("a.mpcdi", archive, "", {.offsets = true}); }).find("whose maps hold points in the room"),
        std::string::npos);
}

TEST(WarpFormatsTest, MpcdiMasksAreRead)
{
    const WarpMesh mesh = read("a.mpcdi", mpcdi_3d());
    expect_turn(mesh.frustum.value().turn, 30, 20, 10, 0);
    EXPECT_EQ(mesh.frustum->sides->left_deg, -24);
    ASSERT_TRUE(mesh.alpha && mesh.beta);
    EXPECT_EQ(mesh.alpha->channels, 1); // grey, though its picture has three channels
    EXPECT_EQ(mesh.alpha->gamma, 2.2);
    EXPECT_EQ(mesh.alpha->values, (std::vector<float>{0, 1}));
    EXPECT_EQ(mesh.beta->size, glm::ivec2(1, 2));
    EXPECT_EQ(mesh.beta->channels, 3);
    EXPECT_EQ(mesh.beta->values, (std::vector<float>{51 / 255.f, 0, 0, 0, 0, 102 / 255.f}));
}

TEST(WarpFormatsTest, MpcdiRegionsAreChosenByName)
{
    std::vector<float> half = identity_map(2, 2);
    half[0] = 0.3f;
    const std::string archive
        = zipped({{"Calibration.XML",
                      "\xef\xbb\xbf"
                          + mpcdi_xml("2d",
                              "<buffer id=\"one\">" + region_xml("l", "") + region_xml("r", "")
                                  + "</buffer><buffer id=\"two\">" + region_xml("m", "") + "</buffer>",
                              fileset_xml("l", "L.pfm") + fileset_xml("r", "r.pfm") + fileset_xml("m", "r.pfm"), "1.0")},
            {"folder/other.xml", "<other/>"}, {"l.pfm", pfm(2, 2, identity_map(2, 2))}, {"r.pfm", pfm(2, 2, half)}});
    EXPECT_EQ(complaint([&] { read("a.mpcdi", archive); }),
        "a.mpcdi: 3 regions are in it and none is chosen; the region \"l\", \"r\" or \"m\" is right");
    EXPECT_EQ(complaint([&] { read("a.mpcdi", archive, "x"); }),
        "a.mpcdi: \"x\" is not a region of it; the region \"l\", \"r\" or \"m\" is right");
    EXPECT_EQ(read("a.mpcdi", archive, "l").vertices[2 * 4 + 1].sees[0].x, 0.25);
    EXPECT_EQ(read("a.mpcdi", archive, "two/m").vertices[2 * 4 + 1].sees[0].x, 0.3f);
    EXPECT_FALSE(read("a.mpcdi", archive, "r").frustum.has_value());
}

TEST(WarpFormatsTest, MpcdiPointsAreInTheirFrame)
{
    // A surveyor's axes: x to the right, y ahead, z up. So yaw points along -z, pitch along x, roll along y.
    const std::string frame
        = "<coordinateFrame><posx>1</posx><posy>2</posy><posz>3</posz><yawx>0</yawx><yawy>0</yawy><yawz>-1</yawz>"
          "<pitchx>1</pitchx><pitchy>0</pitchy><pitchz>0</pitchz><rollx>0</rollx><rolly>1</rolly><rollz>0</rollz></"
          "coordinateFrame>";
    const std::vector<float> points{10, 50, 20, 30, 50, 20, 10, 50, 60, nan, 50, 60, 10, 50, 80, 30, 50, 80};
    for (const std::string profile : {"a3", "sl"}) {
        std::string files = fileset_xml("r", "p.pfm");
        files.insert(files.find("<interpolation>"),
            "<geometricUnit>cm</geometricUnit><originOf3DData>idealEyePoint</originOf3DData>");
        const std::string archive
            = zipped({{"mpacs.xml", mpcdi_xml(profile, "<buffer id=\"b\">" + region_xml("r", frame) + "</buffer>", files)},
                {"p.pfm", pfm(2, 3, points)}});
        const WarpMesh mesh = read("a.mpcdi", archive);
        EXPECT_EQ(mesh.kind, WarpMesh::Kind::points);
        expect_near(mesh.vertices[3 * 4 + 1].sees[0], {0.1, 0.2, -0.5}, 1e-7); // the lower left point: right, up, backwards
        EXPECT_FALSE(used(mesh)[2 * 4 + 2]);
        EXPECT_EQ(mesh.eye_m, glm::dvec3(0));
        EXPECT_FALSE(mesh.frustum.has_value());
    }
    const std::string plain = zipped(
        {{"mpcdi.xml", mpcdi_xml("a3", "<buffer id=\"b\">" + region_xml("r", "") + "</buffer>", fileset_xml("r", "p.pfm"))},
            {"p.pfm", pfm(2, 3, points)}});
    expect_near(read("a.mpcdi", plain).vertices[3 * 4 + 1].sees[0], {10, 50, 20}, 1e-5); // metres, y up
}

TEST(WarpFormatsTest, TheContentDecidesTheFormat)
{
    for (const WarpFormat* format : warp_formats()) {
        SCOPED_TRACE(format->name);
        const auto found = small_samples().find(format->name);
        ASSERT_NE(found, small_samples().end()) << "tests/support/warp_fixture.h has no sample of this format";
        EXPECT_TRUE(read("calibration", found->second).format.starts_with(format->name));
    }
}

/// Under each other format's name, too, unless the content says nothing.
TEST(WarpFormatsTest, TheNameDecidesWhereTheContentSaysNothing)
{
    for (const WarpFormat* format : warp_formats())
        for (const std::string_view ending : format->endings)
            if (!ending.empty()) {
                EXPECT_TRUE(
                    read("a" + std::string(ending), small_samples().at(format->name)).format.starts_with(format->name))
                    << ending;
            }
}

} // namespace
} // namespace starbow::warp_test::warp_formats_test
