#include "cube_faces.h"
#include "config/model/turn.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

struct Face {
    glm::dvec3 ahead, right, down;
    glm::ivec2 in_cross; ///< its column and row
};

/// Cockpit's axes, in the order of cube maps.
constexpr std::array<Face, 6> faces{{
    {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {2, 1}},
    {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {0, 1}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}, {1, 0}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 2}},
    {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 1}},
    {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {3, 1}},
}};

bool is_row(const CubeFaces& cube) { return cube.arrangement == CubeFaces::Arrangement::row; }
glm::ivec2 cell_of(const CubeFaces& cube, int face) { return is_row(cube) ? glm::ivec2(face, 0) : faces[face].in_cross; }

} // namespace

CubeFaceRays::CubeFaceRays(const CubeFaces& cube, glm::ivec2 size)
    : cells_(is_row(cube) ? glm::ivec2(6, 1) : glm::ivec2(4, 3))
    , cell_(glm::dvec2(size) / glm::dvec2(cells_))
    , planes_([&] {
        const glm::dmat3 turned = cockpit_from_picture(cube.turn);
        const auto plane = [&](int i) {
            const glm::dvec2 middle = (glm::dvec2(cell_of(cube, i)) + 0.5) * cell_;
            return Plane(turned * faces[i].ahead, turned * faces[i].right * (2 / cell_.x),
                turned * faces[i].down * (2 / cell_.y), middle);
        };
        return std::array{plane(0), plane(1), plane(2), plane(3), plane(4), plane(5)};
    }())
{
    face_at_.fill(-1);
    for (int i = 0; i < 6; ++i)
        face_at_[cell_of(cube, i).y * cells_.x + cell_of(cube, i).x] = i;
}

const Plane* CubeFaceRays::face(glm::dvec2 pixel) const
{
    const glm::dvec2 end = cell_ * glm::dvec2(cells_);
    if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x <= end.x && pixel.y <= end.y))
        return nullptr;
    const auto face_in = [&](glm::ivec2 cell) {
        cell = glm::clamp(cell, glm::ivec2(0), cells_ - 1);
        return face_at_[cell.y * cells_.x + cell.x];
    };
    const glm::dvec2 at = pixel / cell_;
    const glm::ivec2 after(glm::floor(at)), before = glm::ivec2(glm::ceil(at)) - 1;
    int found = face_in(after);
    // The right and lower edges of a face beside an empty cell belong to the face.
    if (found < 0)
        found = face_in({before.x, after.y});
    if (found < 0)
        found = face_in({after.x, before.y});
    return found < 0 ? nullptr : &planes_[found];
}

std::optional<glm::dvec3> CubeFaceRays::direction(glm::dvec2 pixel) const
{
    const Plane* plane = face(pixel);
    return plane ? plane->direction(pixel) : std::nullopt;
}

std::optional<glm::dvec2> CubeFaceRays::pixel(const glm::dvec3& direction) const
{
    return std::max_element(planes_.begin(), planes_.end(), [&](const Plane& a, const Plane& b) {
        return glm::dot(a.ahead(), direction) < glm::dot(b.ahead(), direction);
    })->pixel(direction);
}

double CubeFaceRays::pixel_angle(glm::dvec2 pixel) const
{
    const Plane* plane = face(pixel);
    return plane ? plane->pixel_angle(pixel) : 0;
}

} // namespace starbow
