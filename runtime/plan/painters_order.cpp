#include "painters_order.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Box = DrawList::OrientedBox;

/// 1: the eye and `other` are both beyond a side of the box, so `other` is nearer; -1: a side parts the two, and the box is
/// on the eye's side; 0: no side tells.
int beyond_a_side(const Box& box, const Box& other)
{
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 out = glm::cross(box.half[(k + 1) % 3], box.half[(k + 2) % 3]); // also of a box without thickness
        const double length = glm::length(out);
        if (!(length > 0))
            continue;
        out /= length;
        for (int side = 0; side < 2; ++side, out = -out) {
            const double face = glm::dot(out, box.centre) + std::abs(glm::dot(out, box.half[k]));
            double nearest = glm::dot(out, other.centre);
            for (const glm::dvec3& half : other.half)
                nearest -= std::abs(glm::dot(out, half));
            if (nearest >= face - 1e-9 * (std::abs(face) + 1e-30))
                return face <= 0 ? 1 : -1;
        }
    }
    return 0;
}

/// True if `a` is to be drawn before `b`.
bool behind(const Box& a, const Box& b)
{
    if (const int side = beyond_a_side(a, b); side != 0)
        return side > 0;
    if (const int side = beyond_a_side(b, a); side != 0)
        return side < 0;
    return glm::dot(a.centre, a.centre) > glm::dot(b.centre, b.centre);
}

} // namespace

void sort_from_behind(std::span<Draw> draws, const DrawList& list)
{
    const auto box_of = [&](const Draw& draw) -> const Box& { return list.boxes[list.visible[draw.first]]; };
    const auto distance = [&](const Draw& draw) { return glm::dot(box_of(draw).centre, box_of(draw).centre); };
    std::sort(draws.begin(), draws.end(),
        [&](const Draw& a, const Draw& b) { return std::pair(distance(a), b.first) > std::pair(distance(b), a.first); });
    // Pairs are tested where they are not too many; the relation has no order that a library's sort could use.
    constexpr std::size_t most = 256;
    for (std::size_t i = 1; i < draws.size() && draws.size() <= most; ++i)
        for (std::size_t k = i; k > 0 && behind(box_of(draws[k]), box_of(draws[k - 1])); --k)
            std::swap(draws[k], draws[k - 1]);
}

std::uint32_t sorted_from_behind(DrawList& list, std::uint32_t instance, std::size_t level,
    std::span<const BlendedTriangle> triangles, std::uint32_t corners)
{
    // Several images of one eye show the same surface, mostly at one level.
    DrawList::SortedSurface& sorted = list.sorted_surfaces[instance];
    if (sorted.level == int(level))
        return sorted.first_index;
    sorted = {int(level), std::uint32_t(list.sorted_indices.size())};
    const shared::InstanceEntry& at = list.instances[instance];
    list.distances.clear();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const glm::vec4 middle(triangles[i].middle, 1);
        const glm::vec3 place(glm::dot(at.row0, middle), glm::dot(at.row1, middle), glm::dot(at.row2, middle));
        list.distances.emplace_back(glm::dot(place, place), i);
    }
    std::sort(list.distances.begin(), list.distances.end(), std::greater());
    for (const auto& [distance, triangle] : list.distances)
        list.sorted_indices.insert(
            list.sorted_indices.end(), triangles[triangle].corners.begin(), triangles[triangle].corners.begin() + corners);
    return sorted.first_index;
}

} // namespace starbow
