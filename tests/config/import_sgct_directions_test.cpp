// The directions of imported viewports against SGCT's own formulas: BaseViewport::setViewPlaneCoordsUsingFOVs,
// Projection::calculateProjection, the planes that initViewports of each panorama turns, the shaders that sample the cube
// map, and correction/pfm.cpp. They are written here anew, in double.
#include "config/import/import_sgct.h"
#include "config/model/layout_reader.h"
#include "displays/projections/views.h"
#include "displays/warp/mesh.h"
#include "tests/support/files.h"
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

namespace import_sgct_directions_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// The layout file's numbers are doubles, and every formula here is well conditioned: what remains is rounding.
constexpr double rounding = 1e-9;

glm::dmat3 about(double angle_deg, const glm::dvec3& axis)
{
    return glm::mat3_cast(glm::angleAxis(glm::radians(angle_deg), axis));
}
const glm::dvec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

/// SGCT's ProjectionPlane and calculateProjection: the direction through the fraction (s, t) of it, t upwards. SGCT looks
/// against the plane's normal, also where the plane lies behind the eye.
struct SgctPlane {
    glm::dvec3 lower_left, upper_left, upper_right;

    glm::dvec3 direction(double s, double t, const glm::dvec3& eye) const
    {
        const glm::dvec3 x = glm::normalize(upper_right - upper_left), y = glm::normalize(upper_left - lower_left),
                         z = glm::cross(x, y);
        const glm::dvec3 point = lower_left + s * (upper_right - upper_left) + t * (upper_left - lower_left) - eye;
        return glm::normalize(glm::dot(point, x) * x + glm::dot(point, y) * y - std::abs(glm::dot(point, z)) * z);
    }
};

/// The layout that an import makes of one window, read as the program reads it.
Layout imported(const std::string& window, const std::string& users)
{
    const std::string text
        = R"({ "version": 1, "nodes": [{ "windows": [{ )" + window + R"( }] }], "users": [)" + users + "] }";
    const Import import = import_sgct(read_document(write_text("directions.json", text)), 0, "");
    const Document document = parse_document("layout.json", import.layout.dump());
    return read_layout(root(document), scratch("layout.json"));
}

std::string user(const glm::dvec3& eye, double separation = 0.06)
{
    return R"({ "eyeseparation": )" + std::to_string(separation) + R"(, "pos": { "x": )" + std::to_string(eye.x)
        + R"(, "y": )" + std::to_string(eye.y) + R"(, "z": )" + std::to_string(eye.z) + " } }";
}

std::string window(const std::string& projection, const std::string& more = "")
{
    return R"("size": { "x": 1280, "y": 720 }, )" + more + R"( "viewports": [{ "projection": )" + projection + " }]";
}

/// Compares a view with `right`, a function of fractions of the picture from its lower left, and returns the largest angle
/// between the two in degrees.
template <class Right> double worst_degrees(const View& view, Right right)
{
    double worst = 0;
    for (double s : {0.01, 0.2, 0.37, 0.5, 0.74, 0.99})
        for (double t : {0.01, 0.3, 0.5, 0.81, 0.99}) {
            const auto seen = direction(view.picture, glm::dvec2(s, 1 - t) * glm::dvec2(view.picture.size));
            if (!seen)
                return 180;
            const glm::dvec3 wanted = right(s, t);
            worst
                = std::max(worst, glm::degrees(std::atan2(glm::length(glm::cross(*seen, wanted)), glm::dot(*seen, wanted))));
        }
    return worst;
}

struct Flat {
    double left, right, down, up; ///< degrees outwards
    glm::dmat3 turn{1};
    glm::dvec3 offset{0};
    double distance = 10;

    SgctPlane plane() const
    {
        const auto corner = [&](double across, double upright) {
            return turn
                * glm::dvec3(
                    distance * std::tan(glm::radians(across)), distance * std::tan(glm::radians(upright)), -distance)
                + offset;
        };
        return {corner(-left, -down), corner(-left, up), corner(right, up)};
    }
};

} // namespace

TEST(ImportSgctDirectionsTest, AFlatPictureStaysInTheRoomWhenTheUserIsElsewhere)
{
    const std::string usual = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50 } })";
    const std::string turned = R"({ "type": "PlanarProjection", "fov": { "down": 35, "up": 15, "left": 10, "right": 50 },
        "orientation": { "yaw": 25, "pitch": 10, "roll": -5 } })";
    const glm::dmat3 turn = about(-25, y_axis) * about(10, x_axis) * about(5, z_axis);
    const std::string moved = R"({ "type": "TextureMappedProjection", "fov": { "hfov": 80, "vfov": 50 },
        "offset": { "x": 0.5, "y": -0.25, "z": -1 } })";
    const std::string near = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50, "distance": 2 } })",
                      nearer = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50 }, "distance": 2 })",
                      mixed = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "down": 20, "up": 30 } })";
    const std::vector<std::pair<std::string, Flat>> pictures{{usual, {40, 40, 25, 25}}, {turned, {10, 50, 35, 15, turn}},
        {moved, {40, 40, 25, 25, glm::dmat3(1), {0.5, -0.25, -1}}}, {near, {40, 40, 25, 25, glm::dmat3(1), {}, 2}},
        {nearer, {40, 40, 25, 25, glm::dmat3(1), {}, 2}}, {mixed, {40, 40, 20, 30}}};
    for (const glm::dvec3 eye : {glm::dvec3(0), glm::dvec3(0, 0, 4), glm::dvec3(0.5, -0.25, 1)})
        for (const auto& [text, flat] : pictures) {
            SCOPED_TRACE(text + " from " + std::to_string(eye.z));
            const Layout layout = imported(window(text), user(eye));
            const std::vector<View> views = views_of(layout, 0, layout.outputs[0].size);
            ASSERT_EQ(views.size(), 1u);
            EXPECT_LT(
                worst_degrees(views[0], [&](double s, double t) { return flat.plane().direction(s, t, eye); }), rounding);
        }
}

TEST(ImportSgctDirectionsTest, TwoEyesConvergeOnThePicturesPlane)
{
    const std::string near = R"({ "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50, "distance": 2 } })";
    const Flat flat{40, 40, 25, 25, glm::dmat3(1), {}, 2};
    for (const char* stereo : {"side_by_side", "top_bottom", "anaglyph_red_cyan"}) {
        SCOPED_TRACE(stereo);
        const Layout layout = imported(window(near, R"("stereo": ")" + std::string(stereo) + "\","), user({0, 0, 0}, 0.07));
        const std::vector<View> views = views_of(layout, 0, layout.outputs[0].size);
        ASSERT_EQ(views.size(), 2u);
        for (const View& view : views) {
            const glm::dvec3 eye(view.eye == Eye::left ? -0.035 : 0.035, 0, 0);
            EXPECT_LT(worst_degrees(view, [&](double s, double t) { return flat.plane().direction(s, t, eye); }), rounding);
            // Each eye's picture keeps the window's shape, squeezed into its half.
            EXPECT_EQ(view.picture.size, glm::ivec2(1280, 720));
        }
        EXPECT_EQ(layout.stereo.hyper_stereo, 1.5e8);
    }
}

namespace {

/// The cube map of a panorama: GL's table of major axes, and the planes of initViewports, which a tilt of 90 degrees and a
/// roll of 45 turn. The base plane lies at +z.
glm::dvec3 panorama_sample(const glm::dvec3& along)
{
    const glm::dvec3 size = glm::abs(along);
    glm::dmat3 face(1);
    double sc = 0, tc = 0, ma = 0;
    if (size.x >= size.y && size.x >= size.z) {
        face = about(along.x > 0 ? -90 : 90, y_axis);
        sc = along.x > 0 ? -along.z : along.z, tc = -along.y, ma = size.x;
    } else if (size.y >= size.z) {
        face = about(along.y > 0 ? -90 : 90, x_axis); // "bottom" is drawn into the face of +y
        sc = along.x, tc = along.y > 0 ? along.z : -along.z, ma = size.y;
    } else {
        face = about(along.z > 0 ? 0 : 180, y_axis);
        sc = along.z > 0 ? along.x : -along.x, tc = -along.y, ma = size.z;
    }
    const glm::dmat3 turn = about(90, x_axis) * about(45, z_axis) * face;
    const SgctPlane plane{turn * glm::dvec3(-1, -1, 1), turn * glm::dvec3(-1, 1, 1), turn * glm::dvec3(1, 1, 1)};
    return plane.direction((sc / ma + 1) / 2, (tc / ma + 1) / 2, glm::dvec3(0));
}

constexpr double pi = 3.14159265358979323846;

} // namespace

TEST(ImportSgctDirectionsTest, PanoramasLookWhereTheShadersSampleTheCubeMap)
{
    const auto view = [](const std::string& projection) {
        const Layout layout = imported(window(projection), user({0, 0, 0}));
        return views_of(layout, 0, layout.outputs[0].size)[0];
    };
    for (const auto& [text, rotation, height] : {std::tuple(R"({ "type": "CylindricalProjection" })", 0.0, 0.0),
             std::tuple(R"({ "type": "CylindricalProjection", "rotation": 30, "heightoffset": -0.5 })", 30.0, -0.5),
             std::tuple(R"({ "type": "CylindricalProjection", "rotation": -200 })", -200.0, 0.0)}) {
        SCOPED_TRACE(text);
        EXPECT_LT(worst_degrees(view(text),
                      [&, turn = glm::radians(rotation), low = height](double s, double t) {
                          const double angle = turn - 2 * pi * s;
                          return panorama_sample({std::cos(angle), std::sin(angle), t + low});
                      }),
            rounding);
    }
    EXPECT_LT(
        worst_degrees(view(R"({ "type": "EquirectangularProjection" })"),
            [](double s, double t) {
                const double phi = pi * (1 - t), theta = 2 * pi * (s - 0.5);
                return panorama_sample({std::sin(phi) * std::sin(theta), std::sin(phi) * std::cos(theta), std::cos(phi)});
            }),
        rounding);
}

TEST(ImportSgctDirectionsTest, ACubeMapsSixPicturesAreWhereTheShaderPutsThem)
{
    const Layout layout = imported(window(R"({ "type": "CubemapProjection", "quality": "1k" })"), user({0, 0, 0}));
    const std::vector<View> views = views_of(layout, 0, {1200, 800});
    ASSERT_EQ(views.size(), 6u);
    // By column from the left and row from below: the turn of initViewports' base plane, whose normal points backwards.
    const std::map<std::pair<int, int>, glm::dmat3> faces{{{0, 0}, about(180, y_axis)}, {{1, 0}, about(90, x_axis)},
        {{2, 0}, glm::dmat3(1)}, {{0, 1}, about(90, y_axis)}, {{1, 1}, about(-90, x_axis)}, {{2, 1}, about(-90, y_axis)}};
    for (const View& view : views) {
        const std::pair<int, int> at(view.corner.x / 400, 1 - view.corner.y / 400);
        SCOPED_TRACE(std::to_string(at.first) + " " + std::to_string(at.second));
        EXPECT_EQ(view.size, glm::ivec2(400));
        const glm::dmat3& turn = faces.at(at);
        const SgctPlane plane{turn * glm::dvec3(-1, -1, 1), turn * glm::dvec3(-1, 1, 1), turn * glm::dvec3(1, 1, 1)};
        EXPECT_LT(worst_degrees(view, [&](double s, double t) { return plane.direction(s, t, glm::dvec3(0)); }), rounding);
    }
    const Layout some = imported(
        window(R"({ "type": "CubemapProjection", "channels": { "right": true, "zleft": true, "bottom": false, "top": true,
            "left": true, "zright": false } })"),
        user({0, 0, 0}));
    EXPECT_EQ(some.outputs[0].viewports.size(), 4u);
}

// SphericalMirrorProjection: initViewports turns the base plane, whose normal points backwards, by 45 degrees less the tilt
// about x, and then each side. render draws bottom with the front's picture, then left, right and top, each over those
// before it. A vertex is at x over the window's aspect, and over the window's aspect times the viewport's shape once more.
TEST(ImportSgctDirectionsTest, AMirrorsFourMeshesShowTheSidesThatSgctGivesThem)
{
    // One cell that ends at a third of the way to the right edge, seen in the corners of its picture.
    write_text("bottom.data", "2\n2 2\n-1 -0.8 0 0 1\n1 -0.8 1 0 1\n-1 0.6 0 1 1\n1 0.6 1 1 1\n");
    for (const char* name : {"left.data", "right.data", "top.data"})
        write_text(name, read_text(scratch("bottom.data")));
    const std::string geometry
        = R"("geometry": { "bottom": "bottom.data", "left": "left.data", "right": "right.data", "top": "top.data" })";
    for (const double tilt : {0.0, 20.0}) {
        SCOPED_TRACE(tilt);
        const Layout layout = imported(R"("size": { "x": 1600, "y": 800 }, "viewports": [{ "size": { "x": 0.75, "y": 1 },
            "projection": { "type": "SphericalMirrorProjection", "tilt": )"
                + std::to_string(tilt) + ", " + geometry + " } }]",
            user({0, 0, 0}));
        const std::vector<View> views = views_of(layout, 0, {1600, 800});
        ASSERT_EQ(views.size(), 4u);
        const glm::dmat3 tilted = about(45 - tilt, x_axis);
        const std::pair<const char*, glm::dmat3> sides[]
            = {{"bottom.data", tilted}, {"left.data", tilted * about(90, y_axis)},
                {"right.data", tilted * about(-90, y_axis)}, {"top.data", tilted * about(90, x_axis)}};
        for (std::size_t i = 0; i < 4; ++i) {
            SCOPED_TRACE(sides[i].first);
            const Viewport& viewport = layout.outputs[0].viewports[i];
            EXPECT_EQ(viewport.order, int(i));
            EXPECT_EQ(viewport.warp.value().file.filename(), sides[i].first);
            EXPECT_EQ(viewport.rect, glm::dvec4(0, 0, 0.75, 1));
            const glm::dmat3& turn = sides[i].second;
            const SgctPlane plane{turn * glm::dvec3(-1, -1, 1), turn * glm::dvec3(-1, 1, 1), turn * glm::dvec3(1, 1, 1)};
            EXPECT_LT(
                worst_degrees(views[i], [&](double s, double t) { return plane.direction(s, t, glm::dvec3(0)); }), rounding);
            // x = 1 over the window's aspect 2, and over the viewport's 1.5, is a third: two thirds of the way to the right.
            const WarpMesh mesh = load_warp(*viewport.warp);
            EXPECT_NEAR(mesh.vertices[1].at.x, 0.5 + 1 / (2 * 1.5) / 2, rounding);
            EXPECT_NEAR(mesh.vertices[2].at.x, 0.5 - 1 / (2 * 1.5) / 2, rounding);
            EXPECT_NEAR(mesh.vertices[0].at.y, (1 - 0.6) / 2, rounding);
            EXPECT_EQ(glm::dvec2(mesh.vertices[0].sees[0]), glm::dvec2(0, 0)); // the picture's upper left
        }
    }
    // By hand: without a tilt the front's middle is 45 degrees up, and the top's 45 degrees up behind.
    const Layout level = imported(window(R"({ "type": "SphericalMirrorProjection", )" + geometry + " }"), user({0, 0, 0}));
    const std::vector<View> views = views_of(level, 0, {1280, 720});
    const double h = std::sqrt(0.5);
    const glm::dvec3 middles[] = {{0, h, -h}, {-1, 0, 0}, {1, 0, 0}, {0, h, h}};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT(
            glm::length(direction(views[i].picture, glm::dvec2(views[i].picture.size) / 2.).value() - middles[i]), rounding);
}

// SGCT draws viewports in their order, without blending.
TEST(ImportSgctDirectionsTest, LaterViewportsLieOverEarlierOnes)
{
    const std::string flat = R"("projection": { "type": "PlanarProjection", "fov": { "hfov": 80, "vfov": 50 } })";
    const Layout layout = imported(R"("size": { "x": 1280, "y": 720 }, "viewports": [{ )" + flat
            + R"( }, { "pos": { "x": 0.5, "y": 0 }, "size": { "x": 0.5, "y": 1 }, )" + flat
            + R"( }, { "pos": { "x": 0, "y": 0 }, "size": { "x": 0.25, "y": 1 }, )" + flat + " }]",
        user({0, 0, 0}));
    const std::vector<Viewport>& viewports = layout.outputs[0].viewports;
    EXPECT_EQ(viewports[0].order, 0);
    EXPECT_EQ(viewports[1].order, 1);
    EXPECT_EQ(viewports[2].order, 1);
}

TEST(ImportSgctDirectionsTest, AMeshsOwnViewIsAPlaneTenMetresFromTheOriginToo)
{
    const Planar frustum{.sides = Sides{-40, 45, -20, 30}, .turn = {-30, 20, 10}};
    const std::string text = R"({ "version": 1, "nodes": [{ "windows": [{ "size": { "x": 1280, "y": 720 }, "viewports": [
        { "mesh": "a.ol", "projection": { "type": "PlanarProjection", "fov": { "hfov": 95, "vfov": 70 } } }] }] }],
        "users": [{ "pos": { "x": 0, "y": 1, "z": 3 } }] })";
    write_text("a.ol", "x");
    const Import import
        = import_sgct(read_document(write_text("directions.json", text)), 0, "", [&](const std::filesystem::path&) {
              return MeshView{true, {}, frustum};
          });
    const Document document = parse_document("layout.json", import.layout.dump());
    const Layout layout = read_layout(root(document), scratch("layout.json"));
    const glm::dmat3 turn = about(30, y_axis) * about(20, x_axis) * about(-10, z_axis);
    const Flat flat{40, 45, 20, 30, turn};
    EXPECT_LT(worst_degrees(views_of(layout, 0, layout.outputs[0].size)[0],
                  [&](double s, double t) {
                      return flat.plane().direction(s, t, {0, 1, 3});
                  }),
        rounding);
}

TEST(ImportSgctDirectionsTest, ATextureMappedPfmIsReadAsSgctReadsIt)
{
    constexpr int columns = 5, rows = 4;
    std::string pfm = "PF\n5 4\n-1.0\n";
    std::vector<glm::vec2> values;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const std::array<float, 3> value{0.1f + 0.19f * c + 0.01f * r, 0.95f - 0.2f * r + 0.005f * c, 0};
            values.push_back({value[0], value[1]});
            pfm.append(reinterpret_cast<const char*>(value.data()), sizeof value);
        }
    write_text("map.pfm", pfm);
    const Layout layout = imported(R"("size": { "x": 640, "y": 400 }, "viewports": [{ "mesh": "map.pfm", "projection":
        { "type": "TextureMappedProjection", "fov": { "hfov": 80, "vfov": 50 } } }])",
        user({0, 0, 0}));
    const WarpMesh mesh = load_warp(layout.outputs[0].viewports[0].warp.value());
    ASSERT_EQ(mesh.grid, glm::ivec2(columns, rows));
    EXPECT_TRUE(mesh.warnings.empty());
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const WarpVertex& vertex = mesh.vertices[std::size_t(r * columns + c)];
            // In SGCT the vertex is at x, y and the texture at s, t, both upwards; here y counts from the top.
            const double x = c / (columns - 1.0), y = 1 - r / (rows - 1.0);
            EXPECT_NEAR(vertex.at.x, x, 1e-12);
            EXPECT_NEAR(1 - vertex.at.y, y, 1e-12);
            EXPECT_NEAR(vertex.sees[0].x, values[std::size_t(r * columns + c)].x, 1e-7); // floats
            EXPECT_NEAR(1 - vertex.sees[0].y, values[std::size_t(r * columns + c)].y, 1e-7);
        }
}

} // namespace import_sgct_directions_test
