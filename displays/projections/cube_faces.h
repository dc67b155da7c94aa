#pragma once
#include "config/model/layout.h"
#include "plane.h"
#include <array>

namespace starbow {

/// Six windows of 90 degrees, none a mirror image. Cube maps are left-handed (Vulkan specification, "Cube Map Face
/// Selection"; OpenGL and Direct3D agree): +x right, +y up, +z ahead, the cockpit's -z. Their table, with the first row on
/// top, gives
///     face  in the middle    at the right edge   at the top
///      +x   right            behind              up
///      -x   left             ahead               up
///      +y   up               right               behind
///      -y   down             right               ahead
///      +z   ahead            right               up
///      -z   behind           left                up
/// The row has these faces from left to right; in the cross the same pictures fold together into the cube. A face's pixels
/// are square where the picture is six times as wide as high, or four by three. picture.h has the contract of each function.
/// They return nullopt outside the picture and in the cross's empty cells. A point between two faces belongs to the right or
/// lower one.
class CubeFaceRays {
public:
    CubeFaceRays(const CubeFaces& cube, glm::ivec2 size);
    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const;
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const;
    double pixel_angle(glm::dvec2 pixel) const; ///< exact for the whole pixel

private:
    const Plane* face(glm::dvec2 pixel) const; ///< null where there is none
    glm::ivec2 cells_; ///< across and down the picture
    glm::dvec2 cell_; ///< its size in pixels
    std::array<int, 12> face_at_; ///< by cell, rows from the top; -1: none
    std::array<Plane, 6> planes_;
};

} // namespace starbow
