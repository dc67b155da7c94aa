#include "tests/support/warp_fixture.h"
#include <limits>

namespace starbow::warp_test::warp_writer_test {
namespace {

/// Compares two meshes in their used vertices. A hole's numbers have no meaning.
void expect_same(const WarpMesh& a, const WarpMesh& b, double tolerance)
{
    ASSERT_EQ(a.grid, b.grid);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    const std::vector<char> flags = used(a);
    EXPECT_EQ(flags, used(b));
    double worst = 0;
    for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i]) {
            worst = std::max({worst, glm::length(a.vertices[i].at - b.vertices[i].at),
                glm::length(a.vertices[i].sees[0] - b.vertices[i].sees[0]),
                std::abs(a.vertices[i].intensity - b.vertices[i].intensity)});
        }
    EXPECT_LE(worst, tolerance);
}

TEST(WarpWriterTest, BourkeReadsBack)
{
    // x is multiplied and divided by the aspect: a few units in the last place.
    for (const std::string name : {"standard_16x9.data", "channel2_warp_mesh.csv", "correction_mesh.mpcdi"})
        for (double aspect : {16.0 / 9, 1.0, 0.3}) {
            const WarpMesh mesh = read(
                name, sample(name), "", {.first_row_on_top = name.ends_with(".mpcdi"), .offsets = name.ends_with(".mpcdi")});
            expect_same(mesh, read("b.data", write_bourke(mesh, name, aspect)), 1e-14);
        }
    const WarpMesh holes = read("a.data", bourke);
    expect_same(holes, read("b.data", write_bourke(holes, "a", 1.6)), 1e-14);
}

TEST(WarpWriterTest, DomeprojectionReadsBackToTheBit)
{
    for (const std::string name :
        {"channel1_warp_mesh.csv", "channel1_warp.simcad", "channel3_warp_u2.sgc", "correction_mesh.mpcdi"}) {
        const WarpMesh mesh = read(name, sample(name), "", {.offsets = name.ends_with(".mpcdi")});
        expect_same(mesh, read("b.csv", write_domeprojection(mesh, name)), 0);
        if (mesh.frustum) {
            const WarpFrustum back = read_frustum({"f", write_frustum({*mesh.frustum, {1, 2, 3}})});
            EXPECT_EQ(back.planar.turn.roll_deg, mesh.frustum->turn.roll_deg);
            EXPECT_EQ(back.planar.turn.yaw_deg, mesh.frustum->turn.yaw_deg);
            EXPECT_EQ(back.planar.sides->down_deg, mesh.frustum->sides->down_deg);
            EXPECT_EQ(back.planar.sides->left_deg, mesh.frustum->sides->left_deg);
            EXPECT_EQ(back.eye_m, glm::dvec3(1, 2, 3));
        }
    }
}

TEST(WarpWriterTest, PfmReadsBackToTheBit)
{
    std::vector<float> values = identity_map(5, 4);
    values[3 * 7 + 1] = std::numeric_limits<float>::quiet_NaN();
    const std::string bytes = pfm(5, 4, values);
    const WarpMesh mesh = read("a.pfm", bytes);
    const std::string written = write_pfm(mesh, "a");
    expect_same(mesh, read("b.pfm", written), 0);
    EXPECT_EQ(write_pfm(read("b.pfm", written), "b"), written);
}

TEST(WarpWriterTest, SampledMeshesShowTheSamePicture)
{
    // A mesh of 33 x 33 is sampled at four times as many places per axis, and compared between these.
    const WarpMesh mesh = read("a.csv", sample("channel1_warp_mesh.csv"));
    const WarpMesh back = read("b.pfm", write_pfm(resampled(mesh, {480, 300}), "a"));
    const WarpRaster before(mesh, {120, 75}), after(back, {120, 75});
    std::vector<WarpSample> a(120), b(120);
    std::size_t compared = 0, differ = 0;
    for (int y = 0; y < 75; ++y) {
        before.row(y, a);
        after.row(y, b);
        for (std::size_t x = 0; x < 120; ++x) {
            differ += a[x].shown != b[x].shown;
            if (a[x].shown && b[x].shown) {
                ++compared;
                EXPECT_LE(glm::length(a[x].sees[0] - b[x].sees[0]),
                    2e-4); // the curvature within a cell, far below a pixel of 1/120
            }
        }
    }
    EXPECT_GT(compared, 5000u);
    EXPECT_LT(differ, 150u); // along the outline, where a cell without all its corners is black
}

TEST(WarpWriterTest, AGridHasTheRequestedSize)
{
    const WarpMesh mesh = read("a.csv", sample("channel1_warp_mesh.csv"));
    EXPECT_EQ(read("b.data", write_bourke(gridded(mesh, {10, 7}), "a", 1.6)).grid, glm::ivec2(10, 7));
    EXPECT_EQ(read("b.pfm", write_pfm(resampled(mesh, {10, 7}), "a")).cells, glm::ivec2(10, 7));
    // It reaches from edge to edge, and loses nothing where the mesh fills the viewport.
    const WarpMesh full = read("a.data", sample("standard_16x9.data"));
    const WarpMesh grid = gridded(full, {10, 7});
    EXPECT_EQ(grid.vertices.front().at, glm::dvec2(0));
    EXPECT_LE(glm::length(grid.vertices.back().at - 1.0), 1e-15);
    EXPECT_EQ(differs(full, grid), 0);
}

TEST(WarpWriterTest, AGridEndsWhereTheMeshDoes)
{
    // A disc of triangles that show a third of the picture around its middle and fade to the right.
    WarpMesh disc;
    disc.format = "disc";
    const glm::dvec2 centre(0.51, 0.47);
    const auto seen = [](const glm::dvec2& at) { return glm::dvec3(0.3 + at.x / 3, 0.4 + at.y / 3, 0); };
    const int sides = 720;
    disc.vertices.push_back({centre, 1 - centre.x / 2, {seen(centre)}});
    for (int i = 0; i < sides; ++i) {
        const double angle = glm::radians(i * 360.0 / sides);
        const glm::dvec2 at = centre + 0.4 * glm::dvec2(std::cos(angle), std::sin(angle));
        disc.vertices.push_back({at, 1 - at.x / 2, {seen(at)}});
        disc.triangles.push_back({0, std::uint32_t(i + 1), std::uint32_t((i + 1) % sides + 1)});
    }
    const WarpMesh grid = read("b.data", write_bourke(gridded(disc, {30, 24}), "a", 1));
    const glm::ivec2 size(800, 800);
    const WarpRaster raster(grid, size);
    std::vector<WarpSample> row(800);
    double shown = 0, farthest = 0, worst = 0;
    for (int y = 0; y < size.y; ++y) {
        raster.row(y, row);
        for (int x = 0; x < size.x; ++x)
            if (const WarpSample& s = row[std::size_t(x)]; s.shown) {
                const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size);
                shown += 1.0 / (size.x * size.y);
                farthest = std::max(farthest, glm::length(at - centre));
                worst = std::max({worst, glm::length(s.sees[0] - seen(at)), std::abs(s.intensity - (1 - at.x / 2))});
            }
    }
    EXPECT_NEAR(shown / (glm::radians(180.0) * 0.16), 1, 0.01); // chords of two cells; without its rim 0.87
    EXPECT_LE(farthest, 0.4 + 1e-9);
    EXPECT_LE(worst, 1e-12); // everything is linear
    EXPECT_LE(differs(disc, grid), 0.01);
    EXPECT_GT(differs(disc, resampled(disc, {30, 24})), 0.03);
}

TEST(WarpWriterTest, MeshesThatAFormatCannotHoldAreRefused)
{
    const WarpMesh none = read("a.obj", obj), three = read("a.mesh", headset);
    EXPECT_NE(complaint([&] { write_bourke(none, "a.obj", 1); }).find("not a grid"), std::string::npos);
    EXPECT_NE(complaint([&] { write_domeprojection(three, "a"); }).find("no flat picture"), std::string::npos);
    EXPECT_NE(complaint([&] { write_pfm(three, "a"); }).find("three ways"), std::string::npos);
    EXPECT_NE(complaint([&] { write_pfm(none, "a"); }).find("not one value per pixel"), std::string::npos);
}

TEST(WarpWriterTest, PortraitLinesAreEquallyBrightOnMeshLines)
{
    // The mesh's five columns are at 0, 1/4, 1/2 ... of the picture, so that its lines coincide with some of the portrait's.
    const WarpMesh mesh = gridded(read("a.data", sample("standard_16x9.data")), {5, 3});
    WarpMesh unwarped = mesh;
    for (WarpVertex& v : unwarped.vertices) {
        v.sees[0] = {v.at, 0};
        v.intensity = 1;
    }
    const std::vector<std::uint8_t> rgba = portrait(unwarped, {640, 400});
    const auto light = [&](double place) { // the light of a line at a place, at 0.33 of the height
        const int margin = 640 / 16, middle = margin + int(std::lround(place * (640 - 2 * margin)));
        int sum = 0;
        for (int x = middle - 3; x < middle + 3; ++x)
            sum += rgba[std::size_t(4 * (640 * 140 + x))];
        return sum;
    };
    // The picture becomes steadily redder to the right, so that a line is as bright as the mean of its neighbours.
    EXPECT_NEAR(light(0.5), (light(0.4) + light(0.6)) / 2, 30); // of some 800; a line may fall on a pixel's edge
}

TEST(WarpWriterTest, PortraitShowsHolesBlack)
{
    const std::vector<std::uint8_t> rgba = portrait(read("a.data", bourke), {160, 100});
    ASSERT_EQ(rgba.size(), 160u * 100 * 4);
    const auto at = [&](int x, int y) {
        return std::max({rgba[std::size_t(4 * (160 * y + x))], rgba[std::size_t(4 * (160 * y + x) + 1)],
            rgba[std::size_t(4 * (160 * y + x) + 2)]});
    };
    EXPECT_LT(at(30, 12), 3); // the upper part, where the hole is
    EXPECT_GT(at(145, 88), 60); // the lower right, which shows the picture
}

} // namespace
} // namespace starbow::warp_test::warp_writer_test
