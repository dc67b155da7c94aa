#include "bend.h"
#include "config/json/error.h"
#include "displays/projections/keystone.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace starbow {
namespace {

/// Cells across and down a whole picture. In each cell the bend is taken as straight. With handles a tenth of the picture
/// out of line in a grid of 17 it is so within 1.5e-4 of the picture; of an ordinary keystone within 2e-6.
constexpr int cells_across = 192;
/// The longest edge of a calibration's triangles, in fractions of the viewport, and the most triangles made by dividing
/// them.
constexpr double longest_edge = 1.0 / 64;
constexpr std::size_t most_divided = std::size_t(1) << 20;

/// The projective map of the unit square to a quad, on homogeneous places.
glm::dmat3 projective(const Quad& quad)
{
    const auto map = keystone(glm::dvec3(quad.upper_left, 1), glm::dvec3(quad.upper_right, 1),
        glm::dvec3(quad.lower_right, 1), glm::dvec3(quad.lower_left, 1), {1, 1});
    if (!map)
        throw InputError("has corners that make no quadrilateral that bulges outwards everywhere; upper left, upper right, "
                         "lower right, lower left in this order are right");
    return map->matrix();
}

/// The weights of four neighbouring handles at a place from 0 to 1 between the middle two.
std::array<double, 4> weights(double t)
{
    const double t2 = t * t, t3 = t2 * t;
    return {0.5 * (-t3 + 2 * t2 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (-3 * t3 + 4 * t2 + t), 0.5 * (t3 - t2)};
}

/// Four neighbours along one axis with their weights. A neighbour beyond the edge continues its two nearest ones straight
/// on, so that a grid whose handles lie on a plane is that plane.
struct Neighbours {
    std::array<int, 4> index;
    std::array<double, 4> weight;
    Neighbours(double place, int count)
    {
        const double along = std::clamp(place, 0.0, 1.0) * (count - 1);
        const int first = std::min(int(along), count - 2);
        weight = weights(along - first);
        for (int k = 0; k < 4; ++k)
            index[std::size_t(k)] = std::clamp(first - 1 + k, 0, count - 1);
        if (first == 0) {
            weight[1] += 2 * weight[0], weight[2] -= weight[0];
            weight[0] = 0;
        }
        if (first == count - 2) {
            weight[2] += 2 * weight[3], weight[1] -= weight[3];
            weight[3] = 0;
        }
    }
};

double doubled_area(const WarpMesh& mesh, const std::array<std::uint32_t, 3>& t)
{
    const glm::dvec2 &a = mesh.vertices[t[0]].at, b = mesh.vertices[t[1]].at, c = mesh.vertices[t[2]].at;
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

WarpMesh whole_picture()
{
    WarpMesh mesh;
    mesh.of_viewport = true;
    mesh.format = "handles";
    constexpr std::uint32_t across = cells_across + 1;
    for (std::uint32_t y = 0; y < across; ++y)
        for (std::uint32_t x = 0; x < across; ++x) {
            WarpVertex vertex;
            vertex.at = glm::dvec2(x, y) / double(cells_across);
            vertex.sees[0] = glm::dvec3(vertex.at, 0);
            mesh.vertices.push_back(vertex);
        }
    for (std::uint32_t y = 0; y + 1 < across; ++y)
        for (std::uint32_t x = 0; x + 1 < across; ++x) {
            const std::uint32_t corner = y * across + x;
            mesh.triangles.push_back({corner, corner + 1, corner + across});
            mesh.triangles.push_back({corner + 1, corner + across + 1, corner + across});
        }
    return mesh;
}

/// Divides each triangle into four. Neighbours share the new vertices.
WarpMesh divided(WarpMesh mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        if (b < a)
            std::swap(a, b);
        const auto [found, is_new] = middles.try_emplace({a, b}, std::uint32_t(mesh.vertices.size()));
        if (is_new) {
            WarpVertex vertex = mesh.vertices[a];
            const WarpVertex& other = mesh.vertices[b];
            vertex.at = 0.5 * (vertex.at + other.at);
            vertex.intensity = 0.5 * (vertex.intensity + other.intensity);
            for (std::size_t i = 0; i < 3; ++i)
                vertex.sees[i] = 0.5 * (vertex.sees[i] + other.sees[i]);
            mesh.vertices.push_back(vertex);
        }
        return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(triangles);
    mesh.grid = mesh.cells = glm::ivec2(0);
    return mesh;
}

bool is_coarse(const WarpMesh& mesh)
{
    return 4 * mesh.triangles.size() <= most_divided
        && std::ranges::any_of(mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
               for (std::size_t k = 0; k < 3; ++k)
                   if (glm::distance(mesh.vertices[t[k]].at, mesh.vertices[t[(k + 1) % 3]].at) > longest_edge)
                       return true;
               return false;
           });
}

} // namespace

Bend::Bend(const std::optional<Quad>& quad, const std::optional<HandleGrid>& grid)
    : grid_(grid)
{
    if (quad)
        quad_ = projective(*quad);
}

glm::dvec2 Bend::offset(glm::dvec2 place) const
{
    const Neighbours across(place.x, grid_->columns), down(place.y, grid_->rows);
    glm::dvec2 sum(0);
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t at = std::size_t(down.index[j]) * std::size_t(grid_->columns) + std::size_t(across.index[i]);
            sum += across.weight[i] * down.weight[j] * glm::dvec2(grid_->right[at], grid_->down[at]);
        }
    return sum;
}

glm::dvec2 Bend::at(glm::dvec2 place) const
{
    if (grid_)
        place += offset(place);
    const glm::dvec3 mapped = quad_ * glm::dvec3(place, 1);
    return glm::dvec2(mapped) / mapped.z;
}

WarpMesh bent(const Bend& bend, const WarpMesh* mesh)
{
    WarpMesh result = mesh ? *mesh : whole_picture();
    while (mesh && is_coarse(result))
        result = divided(std::move(result));
    std::vector<double> before;
    before.reserve(result.triangles.size());
    for (const auto& triangle : result.triangles)
        before.push_back(doubled_area(result, triangle));
    const std::vector<WarpVertex> flat = result.vertices;
    for (WarpVertex& vertex : result.vertices)
        vertex.at = bend.at(vertex.at);
    for (std::size_t i = 0; i < before.size(); ++i)
        if (const auto& triangle = result.triangles[i]; before[i] * doubled_area(result, triangle) < 0) {
            const glm::dvec2 place = flat[triangle[0]].at;
            char text[120];
            std::snprintf(
                text, sizeof text, "folds the picture at %.3f of its width and %.3f of its height", place.x, place.y);
            throw InputError(std::string(text)
                + "; handles that keep their order from left to right and from top to bottom "
                  "are right");
        }
    return result;
}

} // namespace starbow
