#include "cull.h"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace starbow {
namespace {

/// An instance's bounding box around the eye, motion axes.
struct Box {
    glm::dvec3 centre, half[3]; // half: from the centre to the middle of each side
    double scale; // world units per local unit, at most
    double distance; // from the eye, at least

    /// How far it reaches along a unit vector from its centre.
    double reach(const glm::dvec3& n) const
    {
        return std::abs(glm::dot(n, half[0])) + std::abs(glm::dot(n, half[1])) + std::abs(glm::dot(n, half[2]));
    }
};

/// A face's axes as planes through the eye, whose normals point inwards: a box is out if it is wholly behind one.
struct Frustum {
    glm::dvec3 planes[5];

    explicit Frustum(const PlanImage& image)
    {
        glm::dvec3 normal = face_direction(image.face, {0, 0});
        glm::dvec3 a = face_direction(image.face, {1, 0}) - normal, b = face_direction(image.face, {0, 1}) - normal;
        planes[0] = normal;
        planes[1] = glm::normalize(a - image.low.x * normal);
        planes[2] = glm::normalize(image.high.x * normal - a);
        planes[3] = glm::normalize(b - image.low.y * normal);
        planes[4] = glm::normalize(image.high.y * normal - b);
    }
    bool sees(const Box& box) const
    {
        for (const glm::dvec3& plane : planes)
            if (glm::dot(plane, box.centre) < -box.reach(plane))
                return false;
        return true;
    }
};

/// Whether a box lies wholly where no pixel reads: inside the hole that the next finer image behind fills.
bool in_hole(const PlanImage& image, const Box& box)
{
    if (image.hole <= 0)
        return false;
    glm::dvec3 normal = face_direction(image.face, {0, 0});
    glm::dvec3 a = face_direction(image.face, {1, 0}) - normal, b = face_direction(image.face, {0, 1}) - normal;
    for (const glm::dvec3& side : {a, -a, b, -b}) {
        glm::dvec3 plane = image.hole * normal - side;
        if (glm::dot(plane, box.centre) < box.reach(plane))
            return false;
    }
    return true;
}

/// The level of detail for an instance: -1 is the full surface.
int level_of(const Primitive& primitive, const Box& box, double texels_per_unit)
{
    int level = -1;
    constexpr double texels = 1;
    while (level + 1 < int(primitive.coarser.size())
        && primitive.coarser[level + 1].error * box.scale * texels_per_unit <= texels * box.distance)
        ++level;
    return level;
}

} // namespace

DrawList cull(
    const World& world, const glm::dvec3& eye, const glm::dmat3& motion_from_world, const std::vector<PlanImage>& images)
{
    DrawList list;
    list.instances.reserve(world.instances.size());
    std::vector<Box> boxes;
    boxes.reserve(world.instances.size());
    for (const Instance& instance : world.instances) {
        const glm::dmat4& m = instance.world_from_local;
        glm::dmat3 turn = motion_from_world * glm::dmat3(m);
        glm::dvec3 place = motion_from_world * (glm::dvec3(m[3]) - eye);
        glm::dmat3 rows = glm::transpose(turn);
        list.instances.push_back({glm::vec4(rows[0], place.x), glm::vec4(rows[1], place.y), glm::vec4(rows[2], place.z)});
        const Primitive& primitive = world.primitives[instance.primitive];
        glm::dvec3 half = 0.5 * (primitive.high - primitive.low), middle = 0.5 * (primitive.high + primitive.low);
        Box box{turn * middle + place, {turn[0] * half.x, turn[1] * half.y, turn[2] * half.z}, 0, 0};
        glm::dvec3 lengths(glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2]));
        double longest = std::max({lengths.x, lengths.y, lengths.z});
        double skew = std::abs(glm::dot(turn[0], turn[1])) + std::abs(glm::dot(turn[1], turn[2]))
            + std::abs(glm::dot(turn[2], turn[0]));
        if (skew < 1e-9 * longest * longest) {
            // The eye in the instance's own frame, to its box.
            glm::dvec3 eye_local = -(place * turn) / (lengths * lengths);
            box.scale = longest;
            box.distance = std::min({lengths.x, lengths.y, lengths.z})
                * glm::distance(eye_local, glm::clamp(eye_local, primitive.low, primitive.high));
        } else {
            // A sheared node can stretch more than any of its axes; the root of the sum of squares bounds it.
            box.scale = glm::length(lengths);
            box.distance = std::max(0.0, glm::length(turn * primitive.centre + place) - box.scale * primitive.radius);
        }
        boxes.push_back(box);
    }
    std::vector<std::vector<std::uint32_t>> by_level;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        Frustum frustum(images[i]);
        for (std::uint32_t at = 0; at < world.instances.size();) {
            std::uint32_t index = world.instances[at].primitive;
            const Primitive& primitive = world.primitives[index];
            by_level.resize(std::max(by_level.size(), primitive.coarser.size() + 1));
            for (; at < world.instances.size() && world.instances[at].primitive == index; ++at)
                if (frustum.sees(boxes[at]) && !in_hole(images[i], boxes[at]))
                    by_level[level_of(primitive, boxes[at], images[i].texels_per_unit) + 1].push_back(at);
            for (std::size_t level = 0; level < by_level.size(); ++level) {
                std::vector<std::uint32_t>& seen = by_level[level];
                if (seen.empty())
                    continue;
                // Nearest first: what stands behind fails the depth test before it is shaded.
                std::sort(seen.begin(), seen.end(), [&](auto a, auto b) { return boxes[a].distance < boxes[b].distance; });
                DetailLevel detail = level == 0 ? DetailLevel{primitive.first_index, primitive.index_count, 0}
                                                : primitive.coarser[level - 1];
                list.draws.push_back({i, index, std::uint32_t(list.visible.size()), std::uint32_t(seen.size()),
                    detail.first_index, detail.index_count});
                list.visible.insert(list.visible.end(), seen.begin(), seen.end());
                seen.clear();
            }
        }
    }
    return list;
}

double nearest_box(const World& world, const glm::dvec3& place)
{
    double nearest = 1e300;
    for (const Instance& instance : world.instances) {
        const Primitive& primitive = world.primitives[instance.primitive];
        // The corners' own box: larger than the turned one, never nearer than allowed.
        glm::dvec3 low(1e300), high(-1e300);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? primitive.high.x : primitive.low.x, i & 2 ? primitive.high.y : primitive.low.y,
                i & 4 ? primitive.high.z : primitive.low.z);
            const glm::dvec3 at = glm::dvec3(instance.world_from_local * glm::dvec4(corner, 1));
            low = glm::min(low, at), high = glm::max(high, at);
        }
        nearest = std::min(nearest, glm::distance(place, glm::clamp(place, low, high)));
    }
    return nearest;
}

void sort_instances(World& world)
{
    auto key = [&](const Instance& i) {
        const int material = world.primitives[i.primitive].material;
        return std::tuple(!world.materials[std::size_t(material)].clock, material, i.primitive);
    };
    std::stable_sort(world.instances.begin(), world.instances.end(),
        [&](const Instance& a, const Instance& b) { return key(a) < key(b); });
}

} // namespace starbow
