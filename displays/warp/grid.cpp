#include "parts.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace starbow {
namespace {

/// One side of a mesh's outline, from vertex to vertex.
using Side = std::array<std::uint32_t, 2>;

/// The sides that all have their triangles to the same hand. Vertices that a file repeats count as one: it is their places
/// that meet.
std::vector<Side> outline(const WarpMesh& mesh)
{
    struct Beside {
        Side side;
        bool left = false, right = false; ///< whether triangles lie there
    };
    std::map<std::tuple<double, double, double, double>, Beside> sides;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Side side{t[k], t[(k + 1) % 3]};
            glm::dvec2 a = mesh.vertices[side[0]].at, b = mesh.vertices[side[1]].at;
            if (std::tie(b.x, b.y) < std::tie(a.x, a.y))
                std::swap(a, b);
            const glm::dvec2 along = b - a, across = mesh.vertices[t[(k + 2) % 3]].at - a;
            const double area = along.x * across.y - along.y * across.x;
            Beside& beside = sides.try_emplace({a.x, a.y, b.x, b.y}, Beside{side}).first->second;
            beside.left |= area < 0;
            beside.right |= area > 0;
        }
    std::vector<Side> out;
    for (const auto& [places, beside] : sides)
        if (beside.left != beside.right)
            out.push_back(beside.side);
    return out;
}

/// The point of a side that is nearest to the origin, as a part of the way along it.
double nearest(const glm::dvec2& from, const glm::dvec2& to)
{
    const glm::dvec2 way = to - from;
    const double length2 = glm::dot(way, way);
    return length2 > 0 ? std::clamp(-glm::dot(from, way) / length2, 0.0, 1.0) : 0;
}

/// The part of the viewport that a mesh reaches into.
std::pair<glm::dvec2, glm::dvec2> reach(const WarpMesh& mesh)
{
    glm::dvec2 low(1), high(0);
    for (const auto& t : mesh.triangles)
        for (std::uint32_t i : t) {
            low = glm::min(low, mesh.vertices[i].at);
            high = glm::max(high, mesh.vertices[i].at);
        }
    return {glm::max(low, 0.0), glm::min(high, 1.0)};
}

} // namespace

WarpMesh gridded(const WarpMesh& mesh, glm::ivec2 vertices)
{
    const auto [low, high] = reach(mesh);
    const glm::dvec2 steps(vertices - 1), per_step = (high - low) / steps;
    const auto in_steps = [low = low, per_step](const glm::dvec2& at) { return (at - low) / per_step; };
    WarpMesh moved = mesh; // so that the grid's vertices are the centres of a raster
    for (WarpVertex& v : moved.vertices)
        v.at = (in_steps(v.at) + 0.5) / glm::dvec2(vertices);
    const WarpRaster raster(moved, vertices);

    WarpMesh grid;
    grid.kind = mesh.kind;
    grid.frustum = mesh.frustum;
    grid.eye_m = mesh.eye_m;
    grid.format = mesh.format + ", sampled";
    grid.grid = vertices;
    const std::size_t columns = std::size_t(vertices.x);
    std::vector<char> inside;
    std::vector<WarpSample> samples(columns);
    for (int y = 0; y < vertices.y; ++y) {
        raster.row(y, samples);
        for (int x = 0; x < vertices.x; ++x) {
            const WarpSample& s = samples[std::size_t(x)];
            grid.vertices.push_back({low + glm::dvec2(x, y) * per_step, s.shown ? s.intensity : 0, s.sees});
            inside.push_back(s.shown);
        }
    }

    // Vertices next to the mesh move to the nearest point of its outline, else the outline would become a staircase.
    const std::vector<Side> sides = outline(mesh);
    std::vector<std::vector<std::uint32_t>> near(std::size_t(vertices.y)); // to each row
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const double a = in_steps(mesh.vertices[sides[i][0]].at).y, b = in_steps(mesh.vertices[sides[i][1]].at).y;
        const int last = int(std::clamp(std::ceil(std::max(a, b)) + 1, -1.0, steps.y));
        for (int row = int(std::clamp(std::floor(std::min(a, b)) - 1, 0.0, steps.y + 1)); row <= last; ++row)
            near[std::size_t(row)].push_back(std::uint32_t(i));
    }
    std::vector<char> holes(inside.size());
    for (int y = 0; y < vertices.y; ++y)
        for (int x = 0; x < vertices.x; ++x) {
            const std::size_t at = std::size_t(y) * columns + std::size_t(x);
            if (inside[at])
                continue;
            bool beside = false;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, vertices.y - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, vertices.x - 1); ++i)
                    beside |= inside[std::size_t(j) * columns + std::size_t(i)] != 0;
            double best = 2; // steps; no neighbour is farther than the square root of 2
            for (std::uint32_t side : beside ? near[std::size_t(y)] : std::vector<std::uint32_t>()) {
                const WarpVertex &a = mesh.vertices[sides[side][0]], &b = mesh.vertices[sides[side][1]];
                const glm::dvec2 from = in_steps(a.at) - glm::dvec2(x, y), to = in_steps(b.at) - glm::dvec2(x, y);
                const double part = nearest(from, to), distance = glm::length(glm::mix(from, to, part));
                if (distance >= best)
                    continue;
                best = distance;
                WarpVertex& v = grid.vertices[at];
                v.at = glm::mix(a.at, b.at, part);
                v.intensity = glm::mix(a.intensity, b.intensity, part);
                for (std::size_t c = 0; c < 3; ++c)
                    v.sees[c] = glm::mix(a.sees[c], b.sees[c], part);
            }
            holes[at] = best == 2;
        }
    join_grid(grid, holes);
    return grid;
}

double differs(const WarpMesh& a, const WarpMesh& b)
{
    const glm::ivec2 size(960, 540);
    const WarpRaster first(a, size), second(b, size);
    std::vector<WarpSample> in_first(std::size_t(size.x)), in_second(std::size_t(size.x));
    std::size_t shown = 0, other = 0;
    for (int y = 0; y < size.y; ++y) {
        first.row(y, in_first);
        second.row(y, in_second);
        for (std::size_t x = 0; x < in_first.size(); ++x) {
            shown += in_first[x].shown;
            other += in_first[x].shown != in_second[x].shown;
        }
    }
    return double(other) / double(std::max<std::size_t>(shown, 1));
}

} // namespace starbow
