#pragma once
#include "lighting.h"
#include "runtime/world/observer.h"
#include "shaders/physics/physics.h"

namespace starbow {

/// What a line of sight shows.
struct LookedAt {
    glm::dvec3 light{0}; ///< Rec. 709 linear, before exposure; channels may be below 0
    glm::dvec3 world; ///< unit direction in the world
    double D; ///< Doppler factor of what is shown
    double distance; ///< in the world, as long as its light was under way there; infinite for the sky
};

/// Somebody's eye before all rest frames of a world, in double.
class TracingEye {
public:
    /// place: from the ship's event, its own axes (the cockpit's), scene units; others up to `beside` from it may be asked
    /// for. All must outlive it.
    TracingEye(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
        const Observer& observer, const glm::dvec3& place, double beside);

    /// Along a unit direction of the cockpit. beside: the eye's place from the one above.
    LookedAt look(const glm::dvec3& way, const glm::dvec3& beside = glm::dvec3(0)) const;

    /// Whether something stands before the sky.
    bool covered(const glm::dvec3& way, const glm::dvec3& beside = glm::dvec3(0)) const;

    /// Where the cockpit sees what lies at a unit direction of the world, and D.
    physics::AberratedRay from_world(const glm::dvec3& towards) const;

    const Observer& observer_of() const { return observer_; }
    std::size_t triangles() const;

private:
    struct EyeInRestFrame {
        const RestFrameView* layer;
        Tracer tracer;
        Lighting lighting;
    };
    /// The nearest of what all frames show, as light's way in the ship tells.
    struct Nearest {
        const EyeInRestFrame* view = nullptr;
        Met met;
        double D = 1, way = INFINITY; ///< way: in the ship
    };
    physics::AberratedRay sight(const glm::dvec3& n, double E) const;
    Nearest nearest(const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world) const;

    const SceneFile& scene_;
    const Colours& colours_;
    Observer observer_;
    glm::dvec3 place_;
    std::vector<EyeInRestFrame> views_;
};

} // namespace starbow
