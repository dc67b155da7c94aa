#pragma once
#include "lighting.h"
#include "runtime/world/observer.h"
#include "shaders/physics/physics.h"

namespace starbow {

/// The result of a line of sight.
struct LookedAt {
    glm::dvec3 light{0}; ///< Rec. 709 linear, before exposure; channels may be below 0
    glm::dvec3 world; ///< unit direction in the world
    double D; ///< Doppler factor of the source
    double distance; ///< in the world, the light's travel distance there; infinite for the sky
};

/// An observer's eye before all rest frames of a world, in double.
class TracingEye {
public:
    /// place: from the ship's event, in the observer's axes (the cockpit's), scene units; look() may use eyes up to
    /// `beside` from it. All arguments must outlive the object.
    TracingEye(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
        const Observer& observer, const glm::dvec3& place, double beside);

    /// Looks along a unit direction of the cockpit. beside: the eye's place from the constructor's.
    LookedAt look(const glm::dvec3& way, const glm::dvec3& beside = glm::dvec3(0)) const;

    /// True if something stands before the sky.
    bool covered(const glm::dvec3& way, const glm::dvec3& beside = glm::dvec3(0)) const;

    /// The cockpit's direction towards a unit direction of the world, and D.
    physics::AberratedRay from_world(const glm::dvec3& towards) const;
    /// The solid angle of a small patch of the sky there over that in the world. seen: from_world's.
    double solid_angle(const physics::AberratedRay& seen) const;

    const Observer& observer_of() const { return observer_; }
    std::size_t triangles() const;

private:
    struct EyeInRestFrame {
        const RestFrameView* rest_frame;
        Tracer tracer;
        Lighting lighting;
    };
    /// The nearest hit over all frames, by the light's travel distance in the ship.
    struct Nearest {
        const EyeInRestFrame* view = nullptr;
        Met met;
        double D = 1, way = INFINITY; ///< way: in the ship
    };
    physics::AberratedRay sight(const glm::dvec3& n, double E) const;
    Nearest nearest(const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world) const;

    glm::dvec3 sky(const glm::dvec3& n) const;

    const World& world_;
    const SceneFile& scene_;
    const Pictures& pictures_;
    const Colours& colours_;
    glm::dmat3 equatorial_from_world_{1};
    Observer observer_;
    glm::dvec3 place_;
    std::vector<EyeInRestFrame> views_;
};

} // namespace starbow
