#pragma once
#include "config/model/flying.h"
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace starbow {

/// A surface that hides the sky from a place sends this part of the ambient light there: the reflectance of stone and soil.
constexpr double hidden_sky_part = 0.4;

/// Said of a scene with shadows in which something moves.
constexpr const char* no_moving_shadows = "things that move cast no shadows and receive none";

/// Square maps of how far the light of a resting lamp reaches, Shadows::size texels along each side.
struct ShadowMap {
    std::size_t light = 0; ///< index into SceneFile::lights
    bool point = false; ///< six maps around the lamp; else two across the light's direction: a fine one of the middle of
                        ///< the world, and one of all of it
    int layer = 0; ///< its first map
    glm::dvec3 place{0}; ///< of a point light
    /// Unit axes of a directional light: two across it, and the third towards the lamp. Both maps' lowest corners along
    /// the first two, and a texel's size, scene units.
    std::array<glm::dvec3, 3> axes{};
    glm::dvec2 low[2]{}, texel[2]{};
    /// The place along the third axis, or minus the distance from a point light, of a texel's 0 and of its 1.
    double nothing = 0, nearest = 1;
};

/// The shadows and the daylight of still things under still lamps, in the world's rest frame. No light delay touches them.
struct Shadows {
    int size = 0;
    std::vector<ShadowMap> maps;
    /// Layers of size x size texels: the place of what the light meets first, from 0 (nothing) to 65535.
    std::vector<std::uint16_t> texels;

    /// A grid of cells. In each, the part of the sky that a surface sees is dot(b, n) + dot(s, n * n), n its normal: exact
    /// for surfaces along the axes, and for an open sky above a ground. Eight bytes: the components of b, -0.5 to 0.5, and
    /// the part of the lower half of the sky that a ground hides far outside the grid, at that height; those of s, 0 to 1,
    /// and the distance from the things to the grid's sides, cells. In planes along z: of each first b's, then s's.
    glm::ivec3 cells{0};
    glm::dvec3 low{0}; ///< the lowest cell's middle
    double cell = 1; ///< a cell's width, scene units
    std::vector<std::uint8_t> sky;
};

/// The face of a cube around the origin, 0 to 5 for +x, -x, +y, -y, +z, -z, in which a direction lies; the coordinates
/// there, -1 to 1: of the two other axes, in their order.
inline int cube_face(const glm::dvec3& way, glm::dvec2& at)
{
    const glm::dvec3 size = glm::abs(way);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    at = glm::dvec2(way[axis == 0 ? 1 : 0], way[axis == 2 ? 1 : 2]) / size[axis];
    return 2 * axis + (way[axis] < 0 ? 1 : 0);
}
inline glm::dvec3 cube_direction(int face, const glm::dvec2& at)
{
    glm::dvec3 way(0);
    const int axis = face / 2;
    way[axis] = face % 2 ? -1 : 1;
    way[axis == 0 ? 1 : 0] = at.x, way[axis == 2 ? 1 : 2] = at.y;
    return glm::normalize(way);
}

} // namespace starbow
