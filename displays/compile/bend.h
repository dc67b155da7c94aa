#pragma once
#include "displays/warp/mesh.h"

namespace starbow {

/// The map by which a builder pulls a viewport's picture into shape: first the grid, then the quad. Places are fractions of
/// the viewport from its top left.
class Bend {
public:
    /// Without a quad or a grid that part changes nothing.
    Bend(const std::optional<Quad>& quad, const std::optional<HandleGrid>& grid);

    /// The position of a picture point after bending. The grid moves points by a surface through its handles that is smooth
    /// to its first derivative (Catmull and Rom, 1974, in both directions); beyond its edges, by as much as on them. The
    /// quad is the projective map that takes the viewport's corners to its own (Heckbert, Fundamentals of Texture Mapping,
    /// 1989).
    glm::dvec2 at(glm::dvec2 place) const;

private:
    glm::dvec2 offset(glm::dvec2 place) const;

    std::optional<HandleGrid> grid_;
    glm::dmat3 quad_{1}; ///< of homogeneous places
};

/// The warp mesh of a bent viewport: of its calibration's mesh, whose triangles are divided until the bend is straight in
/// each of them, or (null) of the whole picture. Throws InputError where the picture is folded, naming the place in it.
WarpMesh bent(const Bend& bend, const WarpMesh* mesh);

/// True for a viewport that is bent.
inline bool is_bent(const Viewport& viewport) { return viewport.quad || viewport.grid; }

} // namespace starbow
