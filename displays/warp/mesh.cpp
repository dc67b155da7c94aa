#include "config/json/whole_file.h"
#include "parts.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <memory>

namespace starbow {

void join_grid(WarpMesh& mesh, const std::vector<char>& holes)
{
    const auto columns = std::uint32_t(mesh.grid.x), rows = std::uint32_t(mesh.grid.y);
    mesh.triangles.reserve(2 * std::size_t(columns - 1) * (rows - 1));
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = row * columns + column, b = a + 1, c = b + columns, d = a + columns;
            for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}})
                if (!holes[t[0]] && !holes[t[1]] && !holes[t[2]])
                    mesh.triangles.push_back(t);
        }
}

void rows_from_top(WarpMesh& mesh)
{
    if (mesh.grid.x < 1)
        return;
    const auto columns = std::uint32_t(mesh.grid.x), rows = std::uint32_t(mesh.grid.y);
    double first = 0, last = 0;
    for (std::size_t i = 0; i < columns; ++i) {
        first += mesh.vertices[i].at.y;
        last += mesh.vertices[mesh.vertices.size() - 1 - i].at.y;
    }
    if (first <= last)
        return;
    for (std::uint32_t row = 0; row < rows / 2; ++row)
        std::swap_ranges(mesh.vertices.begin() + row * columns, mesh.vertices.begin() + (row + 1) * columns,
            mesh.vertices.begin() + (rows - 1 - row) * columns);
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& i : triangle)
            i = (rows - 1 - i / columns) * columns + i % columns;
}

WarpMesh centred_mesh(glm::ivec2 cells, const std::vector<WarpVertex>& values, const std::vector<char>& holes)
{
    WarpMesh mesh;
    mesh.grid = cells + 2;
    mesh.cells = cells;
    mesh.vertices.reserve(std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y));
    std::vector<char> wide_holes;
    wide_holes.reserve(std::size_t(mesh.grid.x) * std::size_t(mesh.grid.y));
    const auto index = [&](glm::ivec2 cell) { return std::size_t(cell.y) * std::size_t(cells.x) + std::size_t(cell.x); };
    for (int y = 0; y < mesh.grid.y; ++y)
        for (int x = 0; x < mesh.grid.x; ++x) {
            const glm::ivec2 cell = glm::clamp(glm::ivec2(x, y) - 1, glm::ivec2(0), cells - 1);
            const glm::ivec2 out = glm::ivec2(x, y) - 1 - cell; // which way the edge lies, if this is one
            WarpVertex vertex = values[index(cell)];
            for (int axis = 0; axis < 2; ++axis) {
                vertex.at[axis] = (cell[axis] + 0.5 + 0.5 * out[axis]) / cells[axis];
                glm::ivec2 inner = cell;
                inner[axis] -= out[axis];
                if (out[axis] != 0 && cells[axis] > 1 && !holes[index(cell)] && !holes[index(inner)])
                    for (std::size_t c = 0; c < 3; ++c)
                        vertex.sees[c] += (values[index(cell)].sees[c] - values[index(inner)].sees[c]) * 0.5;
            }
            mesh.vertices.push_back(vertex);
            wide_holes.push_back(holes[index(cell)]);
        }
    join_grid(mesh, wide_holes);
    return mesh;
}

Sides checked_sides(const WarpFile& file, const std::string& place, const Sides& s)
{
    for (double angle : {s.left_deg, s.right_deg, s.down_deg, s.up_deg})
        if (!(std::abs(angle) <= 89.9))
            refuse(file, place,
                shown(angle) + " degrees is too far from a flat picture's axis; up to 89.9 to each side is right");
    if (!(s.left_deg < s.right_deg && s.down_deg < s.up_deg))
        refuse(file, place,
            "a picture from " + shown(s.left_deg) + " to " + shown(s.right_deg) + " degrees to the right and from "
                + shown(s.down_deg) + " to " + shown(s.up_deg)
                + " up is turned about; left before right and down before up is right");
    return s;
}

namespace {

/// True if all of a mesh shows one direction, to a thousandth of a picture or of a radian: a pixel or two of any projector.
bool shows_one_direction(const WarpMesh& mesh)
{
    glm::dvec3 low(1e30), high(-1e30);
    for (const auto& t : mesh.triangles)
        for (std::uint32_t i : t) {
            const auto& sees = mesh.vertices[i].sees;
            glm::dvec3 look = sees[0];
            if (mesh.kind == WarpMesh::Kind::points) {
                look -= mesh.eye_m.value_or(glm::dvec3(0));
                look /= std::max(glm::length(look), 1e-12);
            } else if (mesh.kind == WarpMesh::Kind::colours) {
                look = sees[1];
            }
            low = glm::min(low, look);
            high = glm::max(high, look);
        }
    const glm::dvec3 extent = high - low;
    return std::max({extent.x, extent.y, extent.z}) < 1e-3;
}

} // namespace

void check_mesh(WarpMesh& mesh, const WarpFile& file)
{
    if (mesh.vertices.size() > most_vertices)
        refuse(file, "",
            std::to_string(mesh.vertices.size()) + " vertices are too many; at most " + std::to_string(most_vertices)
                + " are right");
    if (mesh.triangles.empty())
        refuse(file, "",
            mesh.vertices.empty()
                ? "holds no mesh; vertices and triangles are right"
                : "shows nothing: every triangle has a hole at a corner; a mesh with some that have none is right");
    std::vector<char> used(mesh.vertices.size());
    glm::dvec2 low(1e30), high(-1e30), seen_low(1e30), seen_high(-1e30);
    std::size_t flat = 0, right = 0, left = 0, visible = 0;
    for (const auto& t : mesh.triangles) {
        const glm::dvec2 a = mesh.vertices[t[0]].at, b = mesh.vertices[t[1]].at, c = mesh.vertices[t[2]].at;
        const double area2 = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        ++(area2 == 0 ? flat : area2 > 0 ? right : left);
        const glm::dvec2 from = glm::min(a, glm::min(b, c)), to = glm::max(a, glm::max(b, c));
        visible += area2 != 0 && from.x < 1 && from.y < 1 && to.x > 0 && to.y > 0;
        low = glm::min(low, from);
        high = glm::max(high, to);
        for (std::uint32_t i : t) {
            used[i] = 1;
            seen_low = glm::min(seen_low, glm::dvec2(mesh.vertices[i].sees[0]));
            seen_high = glm::max(seen_high, glm::dvec2(mesh.vertices[i].sees[0]));
        }
    }
    const auto span = [](const glm::dvec2& from, const glm::dvec2& to) {
        return "x " + shown(from.x) + " to " + shown(to.x) + ", y " + shown(from.y) + " to " + shown(to.y);
    };
    if (visible == 0)
        refuse(file, "",
            "shows nothing: its triangles lie at " + span(low, high)
                + " in fractions of the viewport, or have no area; a mesh that covers some of it is right");
    const std::size_t holes = std::size_t(std::count(used.begin(), used.end(), 0));
    if (holes > 0)
        mesh.notes.push_back(std::to_string(holes) + " of " + std::to_string(used.size()) + " vertices are holes or unused");
    if (flat > 0)
        mesh.notes.push_back(
            std::to_string(flat) + " of " + std::to_string(mesh.triangles.size()) + " triangles have no area");
    if (std::min(right, left) > 0)
        mesh.notes.push_back(std::to_string(std::min(right, left)) + " of " + std::to_string(mesh.triangles.size())
            + " triangles are folded over");
    if (low.x < -1e-9 || low.y < -1e-9 || high.x > 1 + 1e-9 || high.y > 1 + 1e-9)
        mesh.notes.push_back("reaches beyond the viewport: " + span(low, high));
    if (mesh.kind == WarpMesh::Kind::picture
        && (seen_low.x < -1e-9 || seen_low.y < -1e-9 || seen_high.x > 1 + 1e-9 || seen_high.y > 1 + 1e-9))
        mesh.notes.push_back("looks beyond the picture: " + span(seen_low, seen_high));
    if (shows_one_direction(mesh))
        mesh.warnings.push_back("every pixel shows one and the same direction");
}

std::string read_warp_bytes(const std::filesystem::path& file)
{
    return read_whole(file, std::size_t(512) << 20, "a warp file");
}

std::filesystem::path frustum_beside(const std::filesystem::path& mesh)
{
    std::string name = mesh.stem().string();
    if (name.ends_with("_mesh"))
        name.resize(name.size() - 5);
    return mesh.parent_path() / (name + "_frustum.csv");
}

WarpMesh load_warp(const Warp& warp)
{
    const std::string bytes = read_warp_bytes(warp.file);
    const WarpFile file{one_line(warp.file.string()), bytes};
    WarpMesh mesh = read_warp(file, {warp.region, warp.map, warp.aspect});
    std::filesystem::path frustum = warp.frustum;
    if (frustum.empty() && mesh.format == "domeprojection mesh") {
        std::error_code ignored;
        if (const std::filesystem::path beside = frustum_beside(warp.file); std::filesystem::exists(beside, ignored))
            frustum = beside;
    }
    if (!frustum.empty()) {
        if (mesh.kind != WarpMesh::Kind::picture || mesh.frustum)
            refuse(file, "",
                std::string(mesh.frustum ? "has a frustum of its own" : "shows no flat picture") + ", and "
                    + in_quotes(frustum.filename().string()) + " gives another; one is right");
        const std::string text = read_warp_bytes(frustum);
        const WarpFrustum read = read_frustum({one_line(frustum.string()), text});
        mesh.frustum = read.planar;
        mesh.eye_m = read.eye_m;
    }
    return mesh;
}

} // namespace starbow
