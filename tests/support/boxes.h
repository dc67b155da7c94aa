#pragma once
#include "runtime/world/world.h"
#include <glm/gtc/quaternion.hpp>
#include <random>

namespace starbow::testing {

/// Returns a world with `count` instances of one primitive, which has a bounding box; places, sizes and rotations are
/// random.
inline World boxes(int count, unsigned seed)
{
    World world;
    world.materials.push_back({});
    world.primitives.push_back({.first_index = 0,
        .index_count = 3,
        .vertex_offset = 0,
        .material = 0,
        .low = {-0.5, -1, -0.2},
        .high = {0.5, 2, 0.3},
        .centre = {0, 0.5, 0.05},
        .radius = 1.6,
        .coarser = {}});
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int i = 0; i < count; ++i) {
        glm::dmat4 m
            = glm::mat4_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
        m = m
            * glm::dmat4(glm::dmat3(std::exp(normal(random)), 0, 0, i % 3 ? 0 : 0.7, std::exp(normal(random)), 0, 0, 0, 1));
        m[3] = glm::dvec4(4 * normal(random), 4 * normal(random), 4 * normal(random), 1);
        world.instances.push_back({m, 0});
    }
    return world;
}

} // namespace starbow::testing
