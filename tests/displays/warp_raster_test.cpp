#include "tests/support/warp_fixture.h"
#include <random>

namespace starbow::warp_test::warp_raster_test {
namespace {

using Wide = long double;

/// The expected triangle, by barycentric coordinates in extended precision for every triangle at every pixel.
struct Expected {
    int triangle = -1;
    Wide weights[3]{};
    bool close_call = false; ///< the centre is so near an edge that rounding may decide
};

Expected expected_at(const WarpMesh& mesh, glm::ivec2 size, int x, int y)
{
    Expected found;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Wide px[3], py[3];
        for (int k = 0; k < 3; ++k) {
            px[k] = Wide(mesh.vertices[mesh.triangles[t][k]].at.x) * size.x - (x + 0.5L);
            py[k] = Wide(mesh.vertices[mesh.triangles[t][k]].at.y) * size.y - (y + 0.5L);
        }
        Wide w[3];
        for (int k = 0; k < 3; ++k)
            w[k] = px[(k + 1) % 3] * py[(k + 2) % 3] - py[(k + 1) % 3] * px[(k + 2) % 3];
        const Wide sum = w[0] + w[1] + w[2];
        if (sum == 0)
            continue;
        Wide least = 1e30L;
        for (Wide& v : w) {
            v /= sum;
            least = std::min(least, v);
        }
        found.close_call |= std::abs(least) < 1e-12L;
        if (least >= 0 && found.triangle < 0) {
            found.triangle = int(t);
            std::copy(w, w + 3, found.weights);
        }
    }
    return found;
}

/// Gives every triangle corners of its own, whose intensity is the triangle's number.
WarpMesh apart(const WarpMesh& mesh)
{
    WarpMesh out = mesh;
    out.vertices.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            WarpVertex v = mesh.vertices[mesh.triangles[t][k]];
            v.intensity = double(t);
            out.triangles[t][k] = std::uint32_t(out.vertices.size());
            out.vertices.push_back(v);
        }
    return out;
}

WarpMesh random_grid(std::mt19937& random, int columns, int rows, double shake)
{
    WarpMesh mesh;
    std::uniform_real_distribution<double> shift(-shake, shake), any(-1, 2);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            mesh.vertices.push_back({{(x + shift(random)) / (columns - 1), (y + shift(random)) / (rows - 1)}, any(random),
                {glm::dvec3(any(random), any(random), any(random)), glm::dvec3(any(random)), glm::dvec3(any(random))}});
    for (int y = 0; y + 1 < rows; ++y)
        for (int x = 0; x + 1 < columns; ++x) {
            const auto a = std::uint32_t(y * columns + x), b = a + 1, d = a + std::uint32_t(columns), c = d + 1;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

TEST(WarpRasterTest, AgreesWithBarycentricCoordinates)
{
    std::mt19937 random(5);
    int close_calls = 0, shown = 0;
    for (int round = 0; round < 12; ++round) {
        // From small distortions to folded, overlapping triangles that reach far beyond the picture.
        WarpMesh mesh = random_grid(random, 5, 4, 0.1 + round * 0.3);
        mesh.kind = WarpMesh::Kind::colours;
        const glm::ivec2 size(37, 29);
        const WarpMesh named = apart(mesh);
        const WarpRaster raster(mesh, size), names(named, size);
        std::vector<WarpSample> row(37), name_row(37);
        for (int y = 0; y < size.y; ++y) {
            raster.row(y, row);
            names.row(y, name_row);
            for (int x = 0; x < size.x; ++x) {
                const Expected expected = expected_at(mesh, size, x, y);
                close_calls += expected.close_call;
                if (expected.close_call)
                    continue;
                const WarpSample& s = row[std::size_t(x)];
                ASSERT_EQ(s.shown, expected.triangle >= 0) << x << " " << y;
                if (!s.shown)
                    continue;
                ++shown;
                EXPECT_NEAR(name_row[std::size_t(x)].intensity, expected.triangle, 1e-9)
                    << "the file's first triangle must win";
                const auto& t = mesh.triangles[std::size_t(expected.triangle)];
                for (std::size_t c = 0; c < 3; ++c)
                    for (int axis = 0; axis < 3; ++axis) {
                        Wide value = 0;
                        for (int k = 0; k < 3; ++k)
                            value += expected.weights[k] * mesh.vertices[t[std::size_t(k)]].sees[c][axis];
                        EXPECT_NEAR(s.sees[c][axis], double(value), 1e-9); // narrow triangles lose a few digits
                    }
            }
        }
    }
    EXPECT_LT(close_calls, 3);
    EXPECT_GT(shown, 5000);
}

TEST(WarpRasterTest, CentresOnEdgesAreNeverLost)
{
    // Vertices are at pixel centres, so that edges and corners pass exactly through them, with any orientation and order.
    std::mt19937 random(6);
    for (int round = 0; round < 20; ++round) {
        WarpMesh mesh = random_grid(random, 9, 9, 0);
        for (WarpVertex& v : mesh.vertices)
            v.at = (v.at * 8.0 + 0.5) / 9.0; // pixel centres of a 9 x 9 picture
        for (auto& t : mesh.triangles) {
            if (random() % 2)
                std::swap(t[0], t[1]);
            std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        }
        std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
        if (round % 2)
            mesh = apart(mesh); // vertices share places but no index
        for (int size : {9, 18, 27, 45}) {
            const WarpRaster raster(mesh, {size, size});
            std::vector<WarpSample> row(std::size_t(size), WarpSample{});
            const int first = (size / 9 - 1) / 2 + (size / 9 % 2 == 0), last = size - 1 - first;
            for (int y = first; y <= last; ++y) {
                raster.row(y, row);
                for (int x = first; x <= last; ++x)
                    ASSERT_TRUE(row[std::size_t(x)].shown) << size << ": " << x << " " << y;
            }
        }
    }
}

TEST(WarpRasterTest, DistortedGridsHaveNoGaps)
{
    // The inside of a distorted grid has no holes at any size.
    std::mt19937 random(7);
    WarpMesh mesh = random_grid(random, 20, 20, 0.3);
    for (WarpVertex& v : mesh.vertices)
        v.at = v.at * 1.2 - 0.1 + glm::dvec2(1 / 3.0, 1 / 7.0) * 1e-3;
    const WarpRaster raster(mesh, {1021, 997});
    std::vector<WarpSample> row(1021);
    for (int y = 0; y < 997; ++y) {
        raster.row(y, row);
        for (int x = 0; x < 1021; ++x)
            ASSERT_TRUE(row[std::size_t(x)].shown) << x << " " << y;
    }
}

TEST(WarpRasterTest, HolesStayBlack)
{
    const WarpMesh mesh = read("a.data", bourke);
    const WarpRaster raster(mesh, {40, 20});
    std::vector<WarpSample> row(40);
    int shown = 0;
    for (int y = 0; y < 20; ++y) {
        raster.row(y, row);
        for (const WarpSample& s : row)
            shown += s.shown;
    }
    EXPECT_NEAR(shown, 40 * 20 / 4, 20); // one triangle of four, and the centres on its edges
}

// A row takes a step or two for each of its pixels, and some for the triangles that it meets, however many the mesh has.
TEST(WarpRasterTest, ALargePictureIsFast)
{
    const WarpMesh mesh = read("a.data", sample("standard_16x9.data"));
    ASSERT_EQ(mesh.vertices.size(), 6000u);
    const WarpRaster raster(mesh, {4096, 4096});
    std::vector<WarpSample> row(4096);
    double sum = 0;
    std::size_t steps = 0, most = 0;
    for (int y = 0; y < 4096; ++y) {
        const std::size_t taken = raster.row(y, row);
        steps += taken, most = std::max(most, taken);
        sum += row[2048].sees[0].x;
    }
    std::cout << "4096 x 4096 of a 100 x 60 mesh in " << double(steps) / 4096 / 4096 << " steps a pixel\n";
    EXPECT_NEAR(sum / 4096, 0.5, 0.1);
    EXPECT_LT(steps, 2u * 4096 * 4096);
    EXPECT_LT(most, 3u * 4096);
}

} // namespace
} // namespace starbow::warp_test::warp_raster_test
