#pragma once
#include "colours.h"
#include "trace.h"

namespace starbow {

/// What shines on the things that rest in one frame, and what light they send back.
class Lighting {
public:
    /// All must outlive it; colours is made ready for the lamps.
    Lighting(const World& world, const SceneFile& scene, const Pictures& pictures, Colours& colours, const EyeEvent& eye_event);

    /// What is seen at D of a surface where it was met, without the headlight effect.
    glm::dvec3 seen(const Met& met, double D) const;

    /// What reaches a surface from a lamp: by how much its light comes shifted, from where, and how much.
    struct Shine {
        double D = 1;
        glm::dvec3 towards{0}; ///< unit
        double strength = 0; ///< of the lamp's radiance on a surface that faces it; 0: no light
    };
    /// place: in the frame; time: its.
    Shine shine(std::size_t lamp, const glm::dvec3& place, double time) const;

private:
    struct Source {
        const Light* light;
        glm::dvec3 radiance;
        Colours::Kind kind; ///< its own light, D where that is always the same
        bool same_D = true;
        std::size_t ready = 0; ///< then: of Colours
    };
    const World& world_;
    const SceneFile& scene_;
    const Pictures& pictures_;
    const Colours& colours_;
    EyeEvent eye_event_;
    std::vector<Source> sources_; ///< of World::lamps
};

} // namespace starbow
