// Quads and grids of handles: bent pictures against maps that are calculated here by other means.
#include "config/json/error.h"
#include "displays/compile/compiled_view.h"
#include "displays/compile/bend.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace bend_test {

using namespace starbow;

namespace {

Layout layout_of(const Projection& projection, glm::ivec2 size)
{
    Layout layout;
    layout.name = "bent";
    layout.outputs.resize(1);
    layout.outputs[0].name = "one";
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return layout;
}

CompiledView compiled(const Layout& layout)
{
    MapStore store((std::filesystem::path()));
    return compile_output(store, layout, 0, layout.outputs[0].size).front();
}

HandleGrid flat_grid(int columns, int rows)
{
    const std::size_t handles = std::size_t(columns * rows);
    return {columns, rows, std::vector<double>(handles, 0), std::vector<double>(handles, 0)};
}

/// The projective map that takes (0,0), (1,0), (1,1), (0,1) to four points: eight linear equations by Gauss' elimination.
std::array<double, 8> eight_equations(const std::array<glm::dvec2, 4>& to)
{
    const glm::dvec2 from[]{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double m[8][9];
    for (int i = 0; i < 4; ++i)
        for (int axis = 0; axis < 2; ++axis) {
            double* row = m[2 * i + axis];
            std::fill(row, row + 9, 0.0);
            row[3 * axis] = from[i].x, row[3 * axis + 1] = from[i].y, row[3 * axis + 2] = 1;
            row[6] = -from[i].x * to[std::size_t(i)][axis], row[7] = -from[i].y * to[std::size_t(i)][axis];
            row[8] = to[std::size_t(i)][axis];
        }
    for (int k = 0; k < 8; ++k) {
        int pivot = k;
        for (int i = k; i < 8; ++i)
            if (std::abs(m[i][k]) > std::abs(m[pivot][k]))
                pivot = i;
        std::swap(m[k], m[pivot]);
        for (int i = 0; i < 8; ++i)
            if (i != k)
                for (int j = 8; j >= k; --j)
                    m[i][j] -= m[k][j] * m[i][k] / m[k][k];
    }
    std::array<double, 8> solved{};
    for (int k = 0; k < 8; ++k)
        solved[std::size_t(k)] = m[k][8] / m[k][k];
    return solved;
}

glm::dvec2 mapped(const std::array<double, 8>& h, glm::dvec2 p)
{
    return glm::dvec2(h[0] * p.x + h[1] * p.y + h[2], h[3] * p.x + h[4] * p.y + h[5]) / (h[6] * p.x + h[7] * p.y + 1);
}

std::string refusal(const std::function<void()>& work)
{
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(BendTest, HandlesInTheirPlacesChangeNothing)
{
    Lens lens;
    lens.colours[0].k[0] = 0.1, lens.colours[2].k[0] = 0.3;
    for (const auto& [projection, size] : std::vector<std::pair<Projection, glm::ivec2>>{{Planar{60}, {160, 100}},
             {Fisheye{180, 40}, {128, 128}}, {Fisheye{200, 10}, {160, 100}}, {Equirectangular{}, {128, 64}},
             {Wall{{-1, -1, -2}, {1, -1, -2}, {-1, 1, -2}}, {90, 90}}, {lens, {100, 110}}}) {
        SCOPED_TRACE(projection.index());
        Layout layout = layout_of(projection, size);
        const DirectionMap straight = compile_direction_map(compiled(layout).view);
        layout.outputs[0].viewports[0].quad = Quad{};
        layout.outputs[0].viewports[0].grid = flat_grid(5, 4);
        const CompiledView bent = compiled(layout);
        ASSERT_TRUE(bent.map);
        ASSERT_EQ(bent.map->channels, straight.channels);
        int shown = 0, differ = 0;
        float worst = 0, angle = 0;
        for (std::size_t i = 0; i < straight.texels.size(); ++i) {
            const glm::vec4 &a = straight.texels[i], &b = bent.map->texels[i];
            shown += a.w > 0;
            differ += (a.w > 0) != (b.w > 0);
            if (a.w > 0 && b.w > 0) {
                worst = std::max(worst, glm::distance(glm::vec3(a), glm::vec3(b)));
                angle = std::max(angle, std::abs(b.w / a.w - 1));
            }
        }
        EXPECT_GT(shown, int(straight.texels.size()) / 3);
        EXPECT_EQ(differ, 0);
        // A step of a float.
        EXPECT_LT(worst, 3e-7f);
    }
}

TEST(BendTest, AQuadIsTheProjectiveMapOfItsCorners)
{
    const Quad quad{{0.03, -0.02}, {0.92, 0.08}, {1.05, 0.9}, {-0.04, 0.97}};
    const std::array<double, 8> there
        = eight_equations({quad.upper_left, quad.upper_right, quad.lower_right, quad.lower_left});
    const Bend bend(quad, {});
    double worst = 0;
    for (int y = -2; y <= 12; ++y)
        for (int x = -2; x <= 12; ++x) {
            const glm::dvec2 place(x / 10.0, y / 10.0);
            worst = std::max(worst, glm::distance(bend.at(place), mapped(there, place)));
        }
    EXPECT_LT(worst, 1e-13);

    // Each pixel shows the place of the picture that is mapped to it; outside the quad it is dark.
    const glm::ivec2 size(400, 300);
    Layout layout = layout_of(Planar{70, {}, {10, 5, 2}}, size);
    const Picture straight = compiled(layout).view.picture;
    layout.outputs[0].viewports[0].quad = quad;
    const CompiledView view = compiled(layout);
    const glm::dvec2 corners[]{quad.upper_left, quad.upper_right, quad.lower_right, quad.lower_left};
    int dark = 0;
    double off = 0;
    for (int y = 0; y < size.y; y += 3)
        for (int x = 0; x < size.x; x += 3) {
            const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size);
            bool inside = true, beside = false;
            for (int k = 0; k < 4; ++k) {
                const glm::dvec2 edge = corners[(k + 1) % 4] - corners[k], to = at - corners[k];
                const double side = (edge.x * to.y - edge.y * to.x) / glm::length(edge);
                inside &= side > 0, beside |= std::abs(side) < 1e-9;
            }
            const glm::vec4 texel = view.map->at(x, y);
            if (!beside) {
                ASSERT_EQ(texel.w > 0, inside) << x << " " << y;
            }
            dark += !inside;
            if (!inside)
                continue;
            // The place by Newton's method on the equations' map.
            glm::dvec2 place(0.5);
            for (int step = 0; step < 40; ++step) {
                const double h = 1e-6;
                const glm::dvec2 error = mapped(there, place) - at,
                                 dx = (mapped(there, place + glm::dvec2(h, 0)) - mapped(there, place)) / h,
                                 dy = (mapped(there, place + glm::dvec2(0, h)) - mapped(there, place)) / h;
                place -= glm::inverse(glm::dmat2(dx, dy)) * error;
            }
            off = std::max(off, glm::distance(glm::dvec3(texel), *direction(straight, place * glm::dvec2(size))));
        }
    EXPECT_GT(dark, 100);
    // A fiftieth of this picture's pixel; the cells of the bend are straight within 2e-6 of the picture.
    EXPECT_LT(off, 0.02 * glm::radians(70.0) / size.y);
}

TEST(BendTest, AGridsSurfaceGoesThroughItsHandlesSmoothly)
{
    HandleGrid grid = flat_grid(5, 4);
    for (std::size_t i = 0; i < 20; ++i)
        grid.right[i] = 0.02 * std::sin(double(3 * i)), grid.down[i] = 0.015 * std::cos(double(5 * i));
    const Bend bend({}, grid);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column) {
            const std::size_t i = std::size_t(5 * row + column);
            const glm::dvec2 place(column / 4.0, row / 3.0);
            EXPECT_LT(glm::distance(bend.at(place), place + glm::dvec2(grid.right[i], grid.down[i])), 1e-14);
            // No kink at a handle: the slopes on both sides are the same.
            const double h = 1e-6;
            for (const glm::dvec2 way : {glm::dvec2(h, 0), glm::dvec2(0, h)}) {
                if (glm::any(glm::lessThan(place - way, glm::dvec2(0)))
                    || glm::any(glm::greaterThan(place + way, glm::dvec2(1))))
                    continue;
                const glm::dvec2 before = bend.at(place) - bend.at(place - way),
                                 after = bend.at(place + way) - bend.at(place);
                EXPECT_LT(glm::distance(before, after) / h, 1e-4);
            }
        }
    // Handles on a plane make a plane.
    HandleGrid sheared = flat_grid(3, 17);
    for (int row = 0; row < 17; ++row)
        for (int column = 0; column < 3; ++column) {
            const std::size_t i = std::size_t(3 * row + column);
            sheared.right[i] = 0.1 * row / 16.0 - 0.03 * column / 2.0 + 0.01, sheared.down[i] = 0.05 * column / 2.0;
        }
    const Bend flat({}, sheared);
    for (const glm::dvec2 place : {glm::dvec2(0.13, 0.71), {0.97, 0.02}, {0, 1}, {0.5, 0.5}})
        EXPECT_LT(
            glm::distance(flat.at(place), place + glm::dvec2(0.1 * place.y - 0.03 * place.x + 0.01, 0.05 * place.x)), 1e-14);
}

TEST(BendTest, ACalibrationIsBentAsWell)
{
    const Warp warp{starbow::testing::source_dir() / "config/layouts/dome2/left.data"};
    const WarpMesh mesh = load_warp(warp);
    HandleGrid grid = flat_grid(5, 5);
    grid.right[12] = 0.03, grid.down[12] = -0.02;
    const Bend bend(Quad{{0.02, 0.01}, {0.97, 0.03}, {0.99, 0.98}, {0.01, 0.96}}, grid);
    const WarpMesh result = bent(bend, &mesh);
    ASSERT_GE(result.vertices.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        EXPECT_EQ(result.vertices[i].at, bend.at(mesh.vertices[i].at));
        EXPECT_EQ(result.vertices[i].sees, mesh.vertices[i].sees);
    }
    // A mesh of two triangles is divided: its middle line bends.
    WarpMesh coarse;
    for (const glm::dvec2 at : {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}})
        coarse.vertices.push_back({.at = at, .sees = {glm::dvec3(at, 0)}});
    coarse.triangles = {{0, 1, 2}, {0, 2, 3}};
    const WarpMesh fine = bent(bend, &coarse);
    double worst = 0;
    for (const WarpVertex& vertex : fine.vertices)
        worst = std::max(worst, glm::distance(vertex.at, bend.at(glm::dvec2(vertex.sees[0]))));
    EXPECT_LT(worst, 1e-14);
    EXPECT_GT(fine.triangles.size(), 4000u);
    double area = 0;
    for (const auto& [a, b, c] : fine.triangles) {
        const glm::dvec2 ab = fine.vertices[b].at - fine.vertices[a].at, ac = fine.vertices[c].at - fine.vertices[a].at;
        area += 0.5 * (ab.x * ac.y - ab.y * ac.x);
    }
    EXPECT_GT(area, 0.9);
    EXPECT_LT(area, 0.95);
}

TEST(BendTest, EveryHandleMakesAnotherMap)
{
    MapStore store((std::filesystem::path()));
    Layout layout = layout_of(Planar{60}, {64, 48});
    Viewport& viewport = layout.outputs[0].viewports[0];
    viewport.quad = Quad{}, viewport.grid = flat_grid(3, 3);
    const auto map = [&] { return compile_output(store, layout, 0, {64, 48}).front().map; };
    const auto first = map();
    EXPECT_EQ(map(), first) << "equal handles share a map";
    std::set<std::shared_ptr<const DirectionMap>> all{first};
    for (int axis : {0, 1})
        for (glm::dvec2 Quad::*corner : {&Quad::upper_left, &Quad::upper_right, &Quad::lower_right, &Quad::lower_left}) {
            ((*viewport.quad).*corner)[axis] += 0.01;
            EXPECT_TRUE(all.insert(map()).second);
        }
    for (std::vector<double>* offsets : {&viewport.grid->right, &viewport.grid->down})
        for (double& offset : *offsets) {
            offset = 0.01;
            EXPECT_TRUE(all.insert(map()).second);
        }
    viewport.grid.reset();
    EXPECT_TRUE(all.insert(map()).second);
}

TEST(BendTest, FoldedPicturesAreRefusedWithTheirPlace)
{
    Layout layout = layout_of(Planar{60}, {64, 48});
    layout.file = "wall.json";
    HandleGrid grid = flat_grid(3, 3);
    grid.right[4] = 0.8;
    layout.outputs[0].viewports[0].grid = grid;
    const std::string folded = refusal([&] { compiled(layout); });
    EXPECT_NE(folded.find("/outputs/0/viewports/0"), folded.npos) << folded;
    EXPECT_NE(folded.find("folds the picture at 0."), folded.npos) << folded;
    layout.outputs[0].viewports[0].grid.reset();
    for (const Quad& quad : {Quad{{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}}, Quad{{1, 0}, {0, 0}, {1, 1}, {0, 1}},
             Quad{{0, 0}, {1, 0}, {2, 0}, {0, 1}}, Quad{{0, 0}, {0, 0}, {1, 1}, {0, 1}}}) {
        layout.outputs[0].viewports[0].quad = quad;
        const std::string said = refusal([&] { compiled(layout); });
        EXPECT_NE(said.find("make no quadrilateral"), said.npos) << said;
    }
}

} // namespace bend_test
