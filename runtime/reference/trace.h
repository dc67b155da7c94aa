#pragma once
#include "pictures.h"
#include "runtime/world/eye_event.h"
#include <memory>
#include <optional>

namespace starbow {

/// Back along the light that an eye gets from one side, in one rest frame.
struct SightLine {
    glm::dvec3 from{0}; ///< the eye's place, from its eye event's, the frame's axes
    glm::dvec3 way; ///< unit
    double time; ///< the eye's, the frame's time
};

/// Where a line of sight meets a surface.
struct Met {
    std::uint32_t instance; ///< of World::instances
    std::uint32_t corners[3]; ///< of World::vertices
    glm::dvec3 weights; ///< of these corners
    glm::dvec3 place; ///< from the eye event's
    double distance; ///< from the eye
    double sent; ///< the frame's time at which the light left
    bool front;
};

/// Textured coordinate and alpha of what was met.
glm::dvec2 uv_of(const World& world, const Met& met);
glm::dvec4 base_of(const World& world, const Pictures& pictures, const Met& met);

/// All triangles of what rests in one frame, around an eye there, to be met by lines of sight. Embree finds which boxes a
/// line may meet, in float, the boxes widened by what floats lose; where it meets the triangle, and whether, is worked out
/// in double: straight behind, at gamma 1000, a pixel is a millionth of a radian of the world.
class Tracer {
public:
    /// What follows must outlive it. farthest_eye: how far from the eye event's place lines may begin, scene units.
    Tracer(const World& world, const Pictures& pictures, const EyeEvent& eye_event, double farthest_eye);
    ~Tracer();
    Tracer(Tracer&&) noexcept;

    /// The nearest surface that is there: not cut out by its mask, not turned away unless it has two sides, and at its
    /// light's time neither before nor after its life.
    std::optional<Met> nearest(const SightLine& line) const;

    const EyeEvent& eye_event() const;
    std::size_t triangles() const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace starbow
