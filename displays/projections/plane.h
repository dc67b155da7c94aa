#pragma once
#include <glm/glm.hpp>
#include <optional>

namespace starbow {

/// The solid angle of a flat pixel by its corners as seen from the eye, in order around it. triple: the triple product of
/// three neighbouring corners.
double pixel_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, double triple);

/// A flat picture as an eye sees it, scaled to one unit before the eye. The point (x, y) shows the direction along ahead +
/// right (x - axis.x) + down (y - axis.y). picture.h has the contract of each function.
class Plane {
public:
    /// `ahead` is a unit vector perpendicular to the plane. `right` and `down` are one pixel's steps in it, not parallel.
    /// `axis` is the point that shows `ahead`.
    Plane(const glm::dvec3& ahead, const glm::dvec3& right, const glm::dvec3& down, glm::dvec2 axis);

    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const { return glm::normalize(point(pixel)); }
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const; ///< nullopt behind the eye or beside it
    double pixel_angle(glm::dvec2 pixel) const; ///< exact for the whole pixel
    glm::dmat3 matrix() const;

    /// The point of the plane that a pixel shows.
    glm::dvec3 point(glm::dvec2 pixel) const { return ahead_ + right_ * (pixel.x - axis_.x) + down_ * (pixel.y - axis_.y); }
    const glm::dvec3& right() const { return right_; }
    const glm::dvec3& down() const { return down_; }
    const glm::dvec3& ahead() const { return ahead_; }

private:
    glm::dvec3 ahead_, right_, down_;
    glm::dvec2 axis_;
    glm::dvec3 along_right_,
        along_down_; ///< dual basis in the plane: a point's product with each is its place in pixels from the axis
};

} // namespace starbow
