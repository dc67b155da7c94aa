#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace starbow {

/// A texel of the table of reflected surroundings, GLOSS_TABLE x GLOSS_TABLE texels. The row is the roughness, 0 to 1. By
/// the column, the cosine of the eye's angle to the normal, from 0 to 1:
struct GlossTexel {
    float metal = 0; ///< the part that a surface reflects by its colour at right angles, of light from all around
    float white = 0; ///< and the part that it reflects as white, because light grazes it
    /// By the column, the height from -1 to 1 of the mirrored direction: the upper sky's part of the light from around it.
    /// The lower sky's part is that of the opposite height.
    float above = 0;
    float grazing = 0; ///< by the cosine again, for all roughnesses: mean of (1 - cos)^5 over a matt surface's light, with
                       ///< the angle between the light and the microfacet that mirrors it to the eye
};

/// The table, rows from roughness 0. Integrals over GGX's microfacets with Smith's height-correlated shadowing and
/// Schlick's reflection (glTF 2.0, appendix B), to 0.002. `above` takes the eye and the normal in the mirrored direction
/// (Karis, Real Shading in Unreal Engine 4, 2013). Computed at its first use, in 0.1 s.
const std::vector<GlossTexel>& gloss_table();

} // namespace starbow
