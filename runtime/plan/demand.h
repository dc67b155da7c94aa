#pragma once
#include "displays/compile/cone_hierarchy.h"
#include "tiles.h"
#include <optional>
#include <vector>

namespace starbow {

/// What one view asks of its eye's cube map.
struct ViewRequest {
    const ConeHierarchy* cones;
    glm::dmat3 motion_from_cockpit; ///< turn into the axes whose z is the direction of motion
    double parallax_rad = 0; ///< by how much the place that a pixel reads may lie off its direction, in the world
};

/// A ball around something that is drawn, from the eye in motion axes, scene units.
struct BoundingSphere {
    glm::dvec3 centre;
    double radius;
};

/// One rest frame's part of a cube map: how the views look at it, boosted by its own motion.
struct RestFrameRequest {
    std::vector<ViewRequest> views;
    double E = 1; ///< e^rapidity between it and the ship; 1 where directions are not aberrated
    bool galilean = false; ///< velocities are added: circles do not stay circles
    std::optional<std::vector<BoundingSphere>> bounds{}; ///< outside which there is nothing to draw; none: everywhere is something
};

/// What pixels want of a part of a face.
struct Demand {
    Rect rect; ///< around what they read
    double finest = 1e300; ///< face units per texel that some pixel wants
    double coarsest = 0;
    void add(const Demand& other)
    {
        rect.add(other.rect);
        finest = std::min(finest, other.finest);
        coarsest = std::max(coarsest, other.coarsest);
    }
};

/// What they want of the cells of each tile.
struct Demands {
    struct Tile {
        bool any = false;
        std::array<Demand, SUB_TILE_COUNT> sub_tiles; ///< only where there are any
    };
    std::array<Tile, TILE_COUNT> tiles;
    void clear()
    {
        for (Tile& tile : tiles)
            tile.any = false;
    }
};

/// Adds what a layer's views look at. finest_clip_level: the finest nested tile behind that there is. pixel_rays: along each side of
/// a pixel.
void add_demands(Demands& demands, const RestFrameRequest& layer, int finest_clip_level, int pixel_rays);

} // namespace starbow
