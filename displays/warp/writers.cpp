#include "parts.h"
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// The shortest text that reads back as the very same number.
std::string exact(double value)
{
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value == 0 ? 0 : value).ptr; // not -0
    return {text, end};
}

std::vector<char> used(const WarpMesh& mesh)
{
    std::vector<char> flags(mesh.vertices.size());
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t i : triangle)
            flags[i] = 1;
    return flags;
}

void want_grid(const WarpMesh& mesh, const std::string& name, const std::string& format)
{
    if (mesh.kind != WarpMesh::Kind::picture)
        throw InputError(name, "",
            "shows no flat picture, and " + format + " can hold nothing else; a mesh of places in a picture is right");
    if (mesh.grid.x < 2 || mesh.grid.y < 2)
        throw InputError(name, "",
            "is not a grid of vertices, and " + format + " can hold nothing else; sampled on a grid, with a size, is right");
}

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

} // namespace

std::string write_bourke(const WarpMesh& mesh, const std::string& name, double aspect)
{
    want_grid(mesh, name, "a Bourke mesh");
    const std::vector<char> flags = used(mesh);
    std::string text = "2\n" + std::to_string(mesh.grid.x) + " " + std::to_string(mesh.grid.y) + "\n";
    for (int row = mesh.grid.y - 1; row >= 0; --row) // from the bottom
        for (int column = 0; column < mesh.grid.x; ++column) {
            const std::size_t i = std::size_t(row) * std::size_t(mesh.grid.x) + std::size_t(column);
            const WarpVertex& v = mesh.vertices[i];
            // This format has only its sign for holes; samples beyond the picture become holes.
            const glm::dvec2 exactly(v.sees[0].x, 1 - v.sees[0].y), place = glm::clamp(exactly, 0.0, 1.0);
            const bool hole = !flags[i] || !near(exactly.x, place.x) || !near(exactly.y, place.y);
            text += exact((2 * v.at.x - 1) * aspect) + " " + exact(1 - 2 * v.at.y) + " "
                + (hole ? "0 0 -1" : exact(place.x) + " " + exact(place.y) + " " + exact(v.intensity)) + "\n";
        }
    // Readers that stop after the last vertex never see it; ours need not guess then.
    return text + "aspect " + exact(aspect) + "\n";
}

std::string write_domeprojection(const WarpMesh& mesh, const std::string& name)
{
    want_grid(mesh, name, "a domeprojection mesh");
    const std::vector<char> flags = used(mesh);
    std::string text = "x;y;u;v;column;row\n";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (flags[i]) {
            const WarpVertex& v = mesh.vertices[i];
            const std::size_t columns = std::size_t(mesh.grid.x);
            text += exact(v.at.x) + ";" + exact(v.at.y) + ";" + exact(v.sees[0].x) + ";" + exact(v.sees[0].y) + ";"
                + std::to_string(i % columns) + ";" + std::to_string(i / columns) + "\n";
        }
    return text;
}

std::string write_frustum(const WarpFrustum& frustum)
{
    const Sides s = frustum.planar.sides.value();
    const Turn& turn = frustum.planar.turn;
    const auto tangent = [](double angle_deg) { return std::tan(glm::radians(angle_deg)); };
    std::string text = "x;y;z;heading;pitch;bank;left;right;bottom;top;tanLeft;tanRight;tanBottom;tanTop;width;height\n";
    const double values[] = {frustum.eye_m.x, frustum.eye_m.y, frustum.eye_m.z, turn.yaw_deg, turn.pitch_deg, turn.roll_deg,
        -s.left_deg, s.right_deg, -s.down_deg, s.up_deg, tangent(-s.left_deg), tangent(s.right_deg), tangent(-s.down_deg),
        tangent(s.up_deg), tangent(s.right_deg) - tangent(s.left_deg), tangent(s.up_deg) - tangent(s.down_deg)};
    for (double value : values)
        text += exact(value) + ";";
    text.back() = '\n';
    return text;
}

bool is_centred(const WarpMesh& mesh)
{
    const glm::ivec2 cells = mesh.grid - 2;
    if (cells.x < 1 || cells.y < 1 || mesh.kind == WarpMesh::Kind::colours)
        return false;
    for (int y = 0; y < mesh.grid.y; ++y)
        for (int x = 0; x < mesh.grid.x; ++x) {
            const glm::dvec2 at = mesh.vertices[std::size_t(y) * std::size_t(mesh.grid.x) + std::size_t(x)].at;
            const glm::dvec2 right = glm::clamp((glm::dvec2(x, y) - 0.5) / glm::dvec2(cells), 0.0, 1.0);
            if (!near(at.x, right.x) || !near(at.y, right.y))
                return false;
        }
    return true;
}

std::string write_pfm(const WarpMesh& mesh, const std::string& name)
{
    if (mesh.kind == WarpMesh::Kind::colours)
        throw InputError(
            name, "", "looks three ways at each place, for which a PFM has no room; a mesh of another kind is right");
    if (!is_centred(mesh))
        throw InputError(name, "", "is not one value per pixel; sampled on a grid, with a size, is right");
    const std::vector<char> flags = used(mesh);
    const glm::ivec2 cells = mesh.grid - 2;
    std::string bytes = "PF\n" + std::to_string(cells.x) + " " + std::to_string(cells.y) + "\n-1.0\n";
    for (int y = cells.y; y >= 1; --y)
        for (int x = 1; x <= cells.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(mesh.grid.x) + std::size_t(x);
            for (int k = 0; k < 3; ++k) {
                const float value = flags[i] ? float(mesh.vertices[i].sees[0][k]) : std::numeric_limits<float>::quiet_NaN();
                const auto word = std::bit_cast<std::uint32_t>(value);
                for (int shift = 0; shift < 32; shift += 8)
                    bytes += char(word >> shift);
            }
        }
    return bytes;
}

WarpMesh resampled(const WarpMesh& mesh, glm::ivec2 cells)
{
    const WarpRaster raster(mesh, cells);
    std::vector<WarpSample> samples(std::size_t(cells.x));
    std::vector<WarpVertex> values;
    std::vector<char> holes;
    for (int y = 0; y < cells.y; ++y) {
        raster.row(y, samples);
        for (const WarpSample& sample : samples) {
            values.push_back({{}, sample.shown ? sample.intensity : 0, sample.sees});
            holes.push_back(!sample.shown);
        }
    }
    WarpMesh grid = centred_mesh(cells, values, holes);
    grid.kind = mesh.kind;
    grid.frustum = mesh.frustum;
    grid.eye_m = mesh.eye_m;
    grid.format = mesh.format + ", sampled";
    return grid;
}

} // namespace starbow
