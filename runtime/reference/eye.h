#pragma once
#include "globes.h"
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
    glm::dvec3 sun{0}; ///< the part of `light` that is the disc of a globe that is the Sun
};

/// An observer's eye before all rest frames of a world, in double.
class TracingEye {
public:
    /// place: from the ship's event, in the observer's axes (the cockpit's), scene units; look() may use eyes up to
    /// `beside` from it. pixel_rad: the angle of a pixel, as wide as which points and lines are. globes: null in a world
    /// without globes; occluders: in a scene without shadows. All arguments must outlive the object.
    TracingEye(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
        const GlobeColours* globes, const Occluders* occluders, const Observer& observer, const glm::dvec3& place,
        double beside, double pixel_rad);

    /// Looks along a unit direction of the cockpit. beside: the eye's place from the constructor's. parts: for each globe
    /// the part of it that is drawn as a disc; empty: all. pixel_rad: the angle of this pixel, finer than which a globe has
    /// no detail; 0: the constructor's.
    LookedAt look(const glm::dvec3& way, const glm::dvec3& beside = glm::dvec3(0), std::span<const double> parts = {},
        double pixel_rad = 0) const;

    /// The part of the light from a distance (scene units, in the world) that arrives there: 0 where something stands
    /// before.
    double part_left(const glm::dvec3& way, double distance, const glm::dvec3& beside = glm::dvec3(0),
        std::span<const double> parts = {}) const;

    /// The globes before the eye, or null.
    const GlobeSight* globes() const { return globes_.get(); }
    /// The light of one of their bodies in a direction of the cockpit, dimmed by those before it.
    glm::dvec3 globe_light(std::size_t body, const glm::dvec3& way, const glm::dvec3& beside) const;
    /// The eye's place from the ship's event among the globes, metres, the world's axes.
    glm::dvec3 among_globes_m(const glm::dvec3& beside) const;
    /// The cockpit's direction towards a place of the world, from the eye; with Shot's comparison "now" it is contracted.
    glm::dvec3 towards(const glm::dvec3& from_eye) const;

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
        SightHit met;
        double D = 1, way = INFINITY; ///< way: in the ship
    };
    physics::AberratedRay sight(const glm::dvec3& n, double E) const;
    /// after: the hit lies farther away in the ship than this.
    Nearest nearest(
        const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world, double after = 0) const;

    /// A ray up to the first surface that is not blended.
    struct BlendedPath {
        Nearest solid;
        glm::dvec3 light{0}; ///< of the blended ones before it, with the headlight effect
        double left = 1; ///< the part that shows through them
    };
    BlendedPath along(
        const glm::dvec3& way, const glm::dvec3& beside, const physics::AberratedRay& world, bool lights) const;

    glm::dvec3 sky(const glm::dvec3& n) const;

    /// The ray of a direction among the globes. pixel_rad: on the ship. stretch: its length in the ship's contracted space
    /// over the world's.
    GlobeSight::Ray among_globes(const physics::AberratedRay& world, const glm::dvec3& beside, std::span<const double> parts,
        int only, double pixel_rad, double* stretch = nullptr) const;
    physics::AberratedRay world_ray(const glm::dvec3& way) const;

    const World& world_;
    const SceneFile& scene_;
    const Pictures& pictures_;
    const Colours& colours_;
    glm::dmat3 equatorial_from_world_{1};
    Observer observer_;
    glm::dvec3 place_;
    double pixel_rad_;
    const GlobeColours* globe_colours_;
    double farthest_among_globes_ = 0; ///< an eye's distance from the ship, scene units: docs/physics/solar-system.md
    std::unique_ptr<const GlobeSight> globes_;
    std::vector<EyeInRestFrame> views_;
};

} // namespace starbow
