#pragma once
#include "pictures.h"
#include "runtime/world/eye_event.h"
#include <memory>
#include <optional>

namespace starbow {

/// A ray back along the light that reaches an eye, in one rest frame.
struct SightLine {
    glm::dvec3 from{0}; ///< the eye's place from the eye event's, in the frame's axes
    glm::dvec3 way; ///< unit
    double time; ///< the eye's, in the frame
    double pixel_rad = 0; ///< the angle of a pixel in the frame there: the width of lines and points
};

/// A line's own axes: z is its unit direction, from which x and y are at right angles to rounding.
struct LineAxes {
    glm::dvec3 x, y, z;
    explicit LineAxes(const glm::dvec3& way)
        : z(way)
    {
        const glm::dvec3 size = glm::abs(way);
        const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
            : size.y <= size.z                                        ? glm::dvec3(0, 1, 0)
                                                                      : glm::dvec3(0, 0, 1);
        x = glm::normalize(glm::cross(other, way));
        y = glm::cross(way, x);
    }
};

/// The hit of a line of sight on a surface.
struct SightHit {
    std::uint32_t instance; ///< index into World::instances
    std::uint32_t corners[3]; ///< index into World::vertices; of a line both ends and one again, of a point it thrice
    glm::dvec3 weights; ///< of these corners
    glm::dvec3 place; ///< from the eye event's
    glm::dvec3 way; ///< unit, from the eye
    double distance; ///< from the eye
    double sent; ///< the retarded time, in the frame
    bool front;
};

/// The texture coordinate and the alpha at a hit.
glm::dvec2 uv_of(const World& world, const SightHit& met);
glm::dvec4 base_of(const World& world, const Pictures& pictures, const SightHit& met);

/// All triangles, lines and points of one rest frame around an eye event, for intersection with lines of sight. Embree finds
/// the candidate boxes in float, widened by float's rounding; the hit itself is computed in double. Straight behind at gamma
/// 1000, a pixel is a millionth of a radian of the world.
class Tracer {
public:
    /// All arguments must outlive the object. farthest_eye: the greatest distance of a line's beginning from the eye
    /// event's place, scene units. pixel_rad: the angle of a pixel in the ship.
    Tracer(const World& world, const Pictures& pictures, const EyeEvent& eye_event, double farthest_eye, double pixel_rad);
    ~Tracer();
    Tracer(Tracer&&) noexcept;

    /// The nearest visible surface farther than `beyond`: not cut out by its mask, not a back face unless it has two sides,
    /// and existing at its retarded time.
    std::optional<SightHit> nearest(const SightLine& line, double beyond = 0) const;

    const EyeEvent& eye_event() const;
    std::size_t triangles() const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace starbow
