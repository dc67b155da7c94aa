#pragma once
#include "pictures.h"
#include "trace.h"
#include <functional>

namespace starbow {

/// A surface's own axes at a hit, in the frame's axes.
struct SurfaceAxes {
    glm::dvec3 normal{0}; ///< unit, on the outer side
    glm::dvec3 tangent{0}; ///< as VertexMaps::tangent, of any length
    double sense = 1; ///< -1 where the transform mirrors
};

/// The reflection of a glossy surface at a hit, by glTF's metallic-roughness model (glTF 2.0, appendix B). All light is over
/// that of a matt white surface that faces its source.
class GlossyHit {
public:
    /// The material has gloss. facet: unit normal of the side that is seen, without the map.
    GlossyHit(
        const World& world, const Pictures& pictures, const SightHit& met, const SurfaceAxes& axes, const glm::dvec3& facet);

    const glm::dvec3& normal() const { return normal_; } ///< unit, with the map

    /// The parts of light that reach the eye: by the base colour, and as white.
    struct Parts {
        double by_base = 0, white = 0;
    };
    /// A lamp's light; 0 from behind. towards: unit, to the lamp.
    Parts of_lamp(const glm::dvec3& towards) const;

    struct Colours {
        glm::dvec3 by_base{0}, white{0};
    };
    /// Light from all around, as a sum over 256 visible microfacets. ambient: on the matt part. around: the light that is
    /// mirrored from a unit direction.
    Colours of_surroundings(const glm::dvec3& ambient, const std::function<glm::dvec3(const glm::dvec3&)>& around) const;

private:
    glm::dvec3 normal_, eye_; ///< towards it; unit
    double metallic_, width_, dielectric_, occlusion_ = 1; ///< width: of GGX's slopes, the square of the roughness
};

} // namespace starbow
