#pragma once
#include "colours.h"
#include "runtime/shadow/occluders.h"
#include "trace.h"

namespace starbow {

/// The sky's colours around the world, without its glow and its Milky Way. height: the sine of the elevation.
glm::dvec3 sky_gradient(const Sky& sky, double height);

/// The light on the surfaces that rest in one frame, and the light that they reflect.
class Lighting {
public:
    /// All arguments must outlive the object; it prepares `colours` for the lamps. occluders: of a scene with shadows, else
    /// null.
    Lighting(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours,
        const EyeEvent& eye_event, const Occluders* occluders);

    /// The colour, seen at D, of a surface where a ray met it, without the headlight effect.
    glm::dvec3 seen(const SightHit& met, double D) const;

    /// A lamp's light on a surface: its shift, its direction and its strength.
    struct LightSample {
        double D = 1;
        glm::dvec3 towards{0}; ///< unit
        double strength = 0; ///< of the lamp's radiance on a surface that faces it; 0: no light
    };
    /// place: in the frame; time: the frame's.
    LightSample shine(std::size_t lamp, const glm::dvec3& place, double time) const;

private:
    /// The light that glossy surfaces reflect from a direction, as a sunlit colour.
    glm::dvec3 around(const glm::dvec3& way) const;

    /// The facet's normal at a hit on the seen side, unit.
    glm::dvec3 facet(const SightHit& met, const glm::dmat4& frame_from_local) const;
    /// The part of the ambient light that reaches a place: of the sky, and from the surfaces that hide it; by 64 rays.
    double ambient_part(const glm::dvec3& place, const glm::dvec3& facet, const glm::dvec3& normal) const;
    /// True if something still hides a lamp from a place.
    bool hidden(std::size_t lamp, const glm::dvec3& place, const glm::dvec3& facet, const glm::dvec3& towards) const;

    struct Source {
        const Light* light;
        glm::dvec3 radiance;
        Colours::Kind kind; ///< its own spectrum, with D where that is always the same
        bool same_D = true;
        std::size_t ready = 0; ///< then: of Colours
    };
    const World& world_;
    const SceneFile& scene_;
    const Pictures& pictures_;
    const Colours& colours_;
    EyeEvent eye_event_;
    const Occluders* occluders_;
    std::vector<bool> shadowed_; ///< by the scene's lights: it has shadows
    std::vector<Source> sources_; ///< by World::lamps
};

} // namespace starbow
