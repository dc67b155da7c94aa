#include "cull.h"
#include <algorithm>

namespace starbow {
namespace {

struct Sphere {
    glm::dvec3 centre; // motion axes, from the eye
    double radius;
    double scale; // world units per local unit, at most
};

/// A face's axes as planes through the eye, whose normals point inwards: a sphere is out if it is wholly behind one.
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
    bool sees(const Sphere& s) const
    {
        for (const glm::dvec3& plane : planes)
            if (glm::dot(plane, s.centre) < -s.radius)
                return false;
        return true;
    }
};

/// Whether a sphere lies wholly where no pixel reads: inside the hole that the next finer image behind fills.
bool in_hole(const PlanImage& image, const Sphere& s)
{
    if (image.hole <= 0)
        return false;
    glm::dvec3 normal = face_direction(image.face, {0, 0});
    glm::dvec3 a = face_direction(image.face, {1, 0}) - normal, b = face_direction(image.face, {0, 1}) - normal;
    double slant = std::sqrt(1 + image.hole * image.hole);
    for (const glm::dvec3& side : {a, -a, b, -b})
        if (glm::dot(image.hole * normal - side, s.centre) < s.radius * slant)
            return false;
    return true;
}

/// The level of detail for an instance: -1 is the full surface.
int level_of(const Primitive& primitive, const Sphere& s, double texels_per_unit)
{
    double distance = glm::length(s.centre) - s.radius;
    int level = -1;
    constexpr double texels = 0.5;
    while (level + 1 < int(primitive.coarser.size())
        && primitive.coarser[level + 1].error * s.scale * texels_per_unit <= texels * distance)
        ++level;
    return level;
}

} // namespace

DrawList cull(const World& world, const glm::dvec3& eye, const glm::dmat3& motion_from_world, const std::vector<PlanImage>& images)
{
    DrawList list;
    list.instances.reserve(world.instances.size());
    std::vector<Sphere> spheres;
    spheres.reserve(world.instances.size());
    for (const Instance& instance : world.instances) {
        const glm::dmat4& m = instance.world_from_local;
        glm::dmat3 turn = motion_from_world * glm::dmat3(m);
        glm::dvec3 place = motion_from_world * (glm::dvec3(m[3]) - eye);
        glm::dmat3 rows = glm::transpose(turn);
        list.instances.push_back(
            {glm::vec4(rows[0], place.x), glm::vec4(rows[1], place.y), glm::vec4(rows[2], place.z)});
        const Primitive& primitive = world.primitives[instance.primitive];
        double scale = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
        // A sheared node can stretch more than any of its axes; the root of the sum of squares bounds it.
        bool orthogonal = std::abs(glm::dot(turn[0], turn[1])) + std::abs(glm::dot(turn[1], turn[2]))
                + std::abs(glm::dot(turn[2], turn[0])) < 1e-9 * scale * scale;
        if (!orthogonal)
            scale = std::sqrt(glm::dot(turn[0], turn[0]) + glm::dot(turn[1], turn[1]) + glm::dot(turn[2], turn[2]));
        spheres.push_back({turn * primitive.centre + place, primitive.radius * scale, scale});
    }
    std::vector<std::vector<std::uint32_t>> by_level;
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        Frustum frustum(images[i]);
        for (std::uint32_t at = 0; at < world.instances.size();) {
            std::uint32_t index = world.instances[at].primitive;
            const Primitive& primitive = world.primitives[index];
            by_level.resize(std::max(by_level.size(), primitive.coarser.size() + 1));
            for (; at < world.instances.size() && world.instances[at].primitive == index; ++at)
                if (frustum.sees(spheres[at]) && !in_hole(images[i], spheres[at]))
                    by_level[level_of(primitive, spheres[at], images[i].texels_per_unit) + 1].push_back(at);
            for (std::size_t level = 0; level < by_level.size(); ++level) {
                std::vector<std::uint32_t>& seen = by_level[level];
                if (seen.empty())
                    continue;
                DetailLevel detail = level == 0 ? DetailLevel{primitive.first_index, primitive.index_count, 0} : primitive.coarser[level - 1];
                list.draws.push_back({i, index, std::uint32_t(list.visible.size()), std::uint32_t(seen.size()), detail.first_index, detail.index_count});
                list.visible.insert(list.visible.end(), seen.begin(), seen.end());
                seen.clear();
            }
        }
    }
    return list;
}

void sort_instances(World& world)
{
    auto key = [&](const Instance& i) { return std::pair(world.primitives[i.primitive].material, i.primitive); };
    std::stable_sort(world.instances.begin(), world.instances.end(),
        [&](const Instance& a, const Instance& b) { return key(a) < key(b); });
}

} // namespace starbow
