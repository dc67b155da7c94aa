#pragma once
#include "bounding_cap.h"
#include "displays/compile/cone_hierarchy.h"
#include "tiles.h"
#include <optional>
#include <vector>

namespace starbow {

/// A view's request to its eye's cube map.
struct ViewRequest {
    const ConeHierarchy* cones;
    glm::dmat3 motion_from_cockpit; ///< turn into the axes whose z is the direction of motion
    double parallax_rad = 0; ///< greatest angle, in the world, between a pixel's direction and the texel it reads
    double dark_D = 0; ///< light of a smaller D shows nothing on the view's screen
    int rays = 1; ///< along each side of a pixel, if more than all views' have: so many times coarser ones need no mips
    bool beside = false; ///< of the inset, whose pixels do not raise the limit of texels
};

/// One rest frame's part of a cube map: the directions and densities that the views request, boosted by the frame's own
/// motion.
struct RestFrameRequest {
    std::vector<ViewRequest> views;
    double E = 1; ///< e^rapidity between the frame and the ship; 1 where directions are not aberrated
    bool galilean = false; ///< Galilean aberration: circles do not stay circles
    std::optional<std::vector<BoundingSphere>>
        bounds{}; ///< all drawn things lie inside these; nullopt: things may be anywhere
    glm::dmat3 cube_from_motion{1}; ///< turn into the axes of the cube map; the identity where they are the motion axes

    /// The cube map has the motion axes, so that D is known in each sub-tile. False at rest, where D is 1 everywhere: the
    /// plan is that of slow motion, whose cube map has other axes.
    bool aligned() const { return E > 1 && cube_from_motion == glm::dmat3(1); }
};

/// The pixels' demand on a part of a face.
struct Demand {
    Rect rect; ///< encloses all texels that the pixels read
    double finest = 1e300; ///< the finest face units per texel that a pixel needs
    double coarsest = 0;
    void add(const Demand& other)
    {
        rect.add(other.rect);
        finest = std::min(finest, other.finest);
        coarsest = std::max(coarsest, other.coarsest);
    }
};

/// The pixels' demand on the sub-tiles of each tile.
struct Demands {
    struct Tile {
        bool any = false;
        std::array<Demand, SUB_TILE_COUNT> sub_tiles; ///< only for tiles that have any
    };
    std::array<Tile, TILE_COUNT> tiles;
    void clear()
    {
        for (Tile& tile : tiles)
            tile.any = false;
    }
};

/// The greatest distance of a pixel's rays from its centre, pixels: towards the corners of its square, and the errors of
/// float arithmetic.
inline double ray_spread(int pixel_rays) { return 0.71 * (1 - 1.0 / pixel_rays) + 0.02; }

/// The linear density of dark pixels' texels, as a part of the others'. They show nothing, but the exposure is metered
/// there, one sample for about 80 pixels, and surfaces hide stars.
constexpr double dark_density = 1.0 / 8;

/// Adds the demand of a rest frame's views. finest_clip_level: of the nested tiles behind. pixel_rays: along each side of
/// a pixel. Returns the number of pixels that are dark; it changes smoothly as they become lit.
double add_demands(Demands& demands, const RestFrameRequest& request, int finest_clip_level, int pixel_rays);

} // namespace starbow
