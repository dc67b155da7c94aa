#include "cull.h"
#include <algorithm>

namespace starbow {
namespace {

struct Sphere {
    glm::dvec3 centre; // motion axes, from the eye
    double radius;
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
        // A sheared node can stretch more than any of its axes; the sum of squares bounds it.
        double bound = std::sqrt(glm::dot(turn[0], turn[0]) + glm::dot(turn[1], turn[1]) + glm::dot(turn[2], turn[2]));
        bool orthogonal = std::abs(glm::dot(turn[0], turn[1])) + std::abs(glm::dot(turn[1], turn[2]))
                + std::abs(glm::dot(turn[2], turn[0])) < 1e-9 * scale * scale;
        spheres.push_back({turn * primitive.centre + place, primitive.radius * (orthogonal ? scale : bound)});
    }
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        Frustum frustum(images[i]);
        for (std::uint32_t at = 0; at < world.instances.size();) {
            std::uint32_t primitive = world.instances[at].primitive, first = std::uint32_t(list.visible.size());
            for (; at < world.instances.size() && world.instances[at].primitive == primitive; ++at)
                if (frustum.sees(spheres[at]))
                    list.visible.push_back(at);
            if (list.visible.size() > first)
                list.draws.push_back({i, primitive, first, std::uint32_t(list.visible.size()) - first});
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
