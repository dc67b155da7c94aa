#pragma once
#include <glm/glm.hpp>
#include <optional>

namespace starbow {

/// A flat picture of any four corners as an eye sees it: the point (x, y) shows the direction along M (x, y, 1). picture.h
/// has the contract of each function.
class Keystone {
public:
    explicit Keystone(const glm::dmat3& m);

    std::optional<glm::dvec3> direction(glm::dvec2 pixel) const { return glm::normalize(m_ * glm::dvec3(pixel, 1)); }
    std::optional<glm::dvec2> pixel(const glm::dvec3& direction) const; ///< nullopt behind the eye or beside it
    double pixel_angle(glm::dvec2 pixel) const; ///< exact for the whole pixel
    const glm::dmat3& matrix() const { return m_; }

private:
    glm::dmat3 m_, inverse_;
};

/// The picture of `size` pixels whose corners lie in these directions, of any length. nullopt where they are no convex
/// quadrilateral that is seen from its front, or the eye is nearer to its plane than a billionth of its size.
std::optional<Keystone> keystone(const glm::dvec3& upper_left, const glm::dvec3& upper_right, const glm::dvec3& lower_right,
    const glm::dvec3& lower_left, glm::ivec2 size);

} // namespace starbow
