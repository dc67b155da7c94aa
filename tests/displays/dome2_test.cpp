// The meshes of the layout dome2: their generator writes the same bytes, and they light the dome.
#include "config/model/layout.h"
#include "tests/support/files.h"
#include <cmath>
#include <sstream>

namespace dome2_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const std::filesystem::path& folder()
{
    static const std::filesystem::path path = source_dir() / "config/layouts/dome2";
    return path;
}

struct Mesh {
    int columns = 0, rows = 0;
    struct Point {
        double x, y, u, v, i;
    };
    std::vector<Point> points;
};

Mesh read_mesh(const std::string& name)
{
    std::istringstream in(read_text(folder() / name));
    Mesh mesh;
    int type = 0;
    in >> type >> mesh.columns >> mesh.rows;
    EXPECT_EQ(type, 2);
    for (Mesh::Point p; in >> p.x >> p.y >> p.u >> p.v >> p.i;)
        mesh.points.push_back(p);
    EXPECT_EQ(mesh.points.size(), std::size_t(mesh.columns) * std::size_t(mesh.rows));
    EXPECT_TRUE(in.eof());
    return mesh;
}

/// The direction of a place in the layout's domemaster, from the dome's centre and in its own frame.
glm::dvec3 dome_direction(double u, double v)
{
    const double right = (u - 0.5) / 0.45, front = (0.5 - v) / 0.45; // the circle's diameter is 0.9
    const double radius = std::hypot(right, front), angle = radius * std::acos(-1) / 2;
    const double side = radius > 0 ? std::sin(angle) / radius : 0;
    return {right * side, std::cos(angle), -front * side};
}

/// The place in the left or right projector's picture that lights a direction: the inverse of make.py's lens.
glm::dvec2 in_picture(bool left, const glm::dvec3& direction)
{
    const glm::dvec3 lens(left ? -3.9 : 3.9, -0.1, 0), ray = 4.0 * direction - lens;
    const double inwards = left ? 1 : -1, depth = ray.x * inwards;
    EXPECT_GT(depth, 0);
    return {ray.z * inwards / depth / 1.2 * 1.6, (ray.y / depth + 0.0875) / 1.5 * 2 - 1};
}

} // namespace

TEST(Dome2Test, GeneratorWritesTheCommittedBytes)
{
    const auto made = scratch("dome2");
    std::filesystem::create_directory(made);
    ASSERT_NO_FATAL_FAILURE(run_generator(folder(), made));
    for (const char* name : {"left.data", "right.data"}) {
        EXPECT_TRUE(read_text(made / name) == read_text(folder() / name)) << "run make.py and commit what it writes";
        EXPECT_LT(std::filesystem::file_size(folder() / name), 150000u);
    }
}

TEST(Dome2Test, PointsLieOnTheProjectorsRays)
{
    for (const bool left : {true, false}) {
        const Mesh mesh = read_mesh(left ? "left.data" : "right.data");
        int shown = 0;
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            const Mesh::Point& p = mesh.points[i];
            EXPECT_NEAR(p.x, (2.0 * double(i % std::size_t(mesh.columns)) / (mesh.columns - 1) - 1) * 1.6, 1e-5);
            EXPECT_NEAR(p.y, 2.0 * double(i / std::size_t(mesh.columns)) / (mesh.rows - 1) - 1, 1e-5);
            if (p.i < 0)
                continue;
            ++shown;
            // Five decimals of u are 0.07 mm on a dome of 4 m; the lens is at least a metre away.
            const glm::dvec2 back = in_picture(left, dome_direction(p.u, p.v));
            ASSERT_NEAR(back.x, p.x, 3e-4) << i;
            ASSERT_NEAR(back.y, p.y, 3e-4) << i;
        }
        EXPECT_GT(shown, 9 * int(mesh.points.size()) / 10);
    }
}

/// A mesh is linear between its points: in the middle of each edge it is off by less than a third of a pixel.
TEST(Dome2Test, TheMeshIsFineEnough)
{
    double worst_px = 0;
    for (const bool left : {true, false}) {
        const Mesh mesh = read_mesh(left ? "left.data" : "right.data");
        const auto check = [&](std::size_t a, std::size_t b) {
            const Mesh::Point &p = mesh.points[a], &q = mesh.points[b];
            if (p.i < 0 || q.i < 0)
                return;
            const glm::dvec2 seen = in_picture(left, dome_direction((p.u + q.u) / 2, (p.v + q.v) / 2));
            const glm::dvec2 off = seen - glm::dvec2((p.x + q.x) / 2, (p.y + q.y) / 2);
            worst_px = std::max(worst_px, glm::length(off) * 600);
        };
        for (int y = 0; y < mesh.rows; ++y)
            for (int x = 0; x < mesh.columns; ++x) {
                const std::size_t at = std::size_t(y * mesh.columns + x);
                if (x + 1 < mesh.columns)
                    check(at, at + 1);
                if (y + 1 < mesh.rows)
                    check(at, at + std::size_t(mesh.columns));
            }
    }
    EXPECT_LT(worst_px, 1.0 / 3);
    EXPECT_GT(worst_px, 0.05); // otherwise this measures nothing
}

TEST(Dome2Test, TheWholeDomeIsLitAndTheMiddleTwice)
{
    const Mesh meshes[2] = {read_mesh("left.data"), read_mesh("right.data")};
    int lit_by[3] = {0, 0, 0};
    for (int i = 0; i <= 200; ++i)
        for (int k = 0; k < 400; ++k) {
            const double angle = std::acos(1 - i / 200.0), azimuth = k * std::acos(-1) / 200; // evenly over the half sphere
            const glm::dvec3 d(std::sin(angle) * std::sin(azimuth), std::cos(angle), -std::sin(angle) * std::cos(azimuth));
            int lit = 0;
            for (const bool left : {true, false}) {
                const glm::dvec3 ray = 4.0 * d - glm::dvec3(left ? -3.9 : 3.9, -0.1, 0);
                if (ray.x * (left ? 1 : -1) <= 0)
                    continue;
                const glm::dvec2 at = in_picture(left, d);
                if (std::abs(at.x) > 1.6 || std::abs(at.y) > 1)
                    continue;
                // No corner of its cell is a hole.
                const Mesh& mesh = meshes[left ? 0 : 1];
                const int x = std::min(int((at.x / 1.6 + 1) / 2 * (mesh.columns - 1)), mesh.columns - 2);
                const int y = std::min(int((at.y + 1) / 2 * (mesh.rows - 1)), mesh.rows - 2);
                bool whole = true;
                for (int corner : {0, 1, mesh.columns, mesh.columns + 1})
                    whole = whole && mesh.points[std::size_t(y * mesh.columns + x + corner)].i > 0;
                lit += whole;
            }
            ++lit_by[lit];
            if (std::abs(d.x) < 0.1) {
                EXPECT_EQ(lit, 2) << i << " " << k; // 0.4 m to either side of the middle
            }
        }
    EXPECT_EQ(lit_by[0], 0);
    EXPECT_GT(lit_by[1], lit_by[2]); // somewhat more than half of the directions, not all
}

TEST(Dome2Test, TheLayoutDescribesTheMeshesDomemaster)
{
    const Layout layout = load_layout(source_dir() / "config/layouts/dome2.json");
    ASSERT_EQ(layout.outputs.size(), 2u);
    EXPECT_TRUE(layout.blend.ramps);
    for (const Output& output : layout.outputs) {
        const Viewport& viewport = output.viewports.at(0);
        EXPECT_TRUE(std::filesystem::equivalent(viewport.warp.value().file, folder() / (output.name + ".data")));
        EXPECT_EQ(output.size.x * 1000 / output.size.y, 1600);
        const Fisheye& fisheye = std::get<Fisheye>(viewport.projection);
        EXPECT_EQ(fisheye.diameter, 0.9);
        EXPECT_EQ(fisheye.aperture_deg, 180);
        EXPECT_EQ(fisheye.mapping, FisheyeMapping::equidistant);
    }
}

} // namespace dome2_test
