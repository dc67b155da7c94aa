#pragma once
#include "config/model/quality.h"
#include "demand.h"
#include <span>
#include <vector>

namespace starbow {

/// An image to draw: a rectangle of one face of the cube around the eye, at one resolution, and its place in the atlas.
struct PlannedImage {
    int tile; ///< tile of the rest frame's cube map
    int face;
    glm::dvec2 low, high; ///< face coordinates of the image's edges, gutter included
    glm::ivec2 size; ///< texels
    glm::ivec2 atlas; ///< top left texel
    double texels_per_unit; ///< texels per unit of face coordinate
    int levels; ///< mip levels the warp pass reads
    double clip_hole = 0; ///< half the side of the clip-map hole; 0: none. No pixel reads the image there
    int rest_frame = 0;
    SubTiles sub_tiles{}; ///< the sub-tiles of its tile that it covers
    bool needed = true; ///< false: no output of this machine reads it, and it is not drawn
};

/// The demand of each rectangle that repeated halving of a tile yields. The intervals of a side form a binary heap: 0 is
/// the whole, 2 n + 1 and 2 n + 2 are the halves of n.
struct TileDemands {
    static constexpr int intervals = 2 * TILE_SUB_TILES - 1;
    int rest_frame, tile;
    Demand demands[intervals][intervals]; ///< [along b][along a]
    double wanted[intervals][intervals]; ///< texels at a density of 1, if each sub-tile had exactly its own density
};

/// The images of one eye's cube map for one frame.
struct CubeMapPlan {
    std::vector<PlannedImage> images; ///< by rest frame, then by tile
    glm::ivec2 atlas_size{0};
    std::vector<int> finest_clip_level; ///< by rest frame: the finest nested image behind that differs from the one
    ///< before
    int levels = 1; ///< mip levels of the atlas: the most that any image needs
    double texels = 0; ///< drawn, all images
    double pixels = 0; ///< pixels of the views that read it
    bool cut = false; ///< some tile has more than one image
};

/// Memory of plan_cube_map, kept from frame to frame and for all eyes.
struct PlanScratch {
    std::vector<Demands> demands; ///< by rest frame
    std::vector<TileDemands> by_tile;
    std::vector<Demand> held; ///< by image
    std::vector<std::size_t> by_height;
};

/// Chooses the faces to draw, each with its rectangle and its resolution. Pure. Every texel that a pixel of the views
/// reads, including the neighbours of its filter, lies inside an image.
///
/// Tiles without any direction of a view and tiles without content are left out. Any other tile is divided into the
/// images, each with its own resolution, that cost least: Quality::image_cost_texels for each image, plus its texels.
/// before: a plan whose memory is reused.
CubeMapPlan plan_cube_map(
    const std::vector<RestFrameRequest>& requests, const Quality& quality, PlanScratch& room, CubeMapPlan before = {});
CubeMapPlan plan_cube_map(const std::vector<RestFrameRequest>& requests, const Quality& quality);
/// The same for a world in which nothing moves. E: e^rapidity of the ship in the world.
CubeMapPlan plan_cube_map(const std::vector<ViewRequest>& views, double E, const Quality& quality);

/// Marks the images of a plan as needed that a part of its views reads. part: the plan of those views alone.
void mark_needed(CubeMapPlan& whole, const CubeMapPlan& part);

/// True if the drawn plan has nearly the wanted plan's density wherever the wanted plan has images: it may be shown
/// again.
bool can_reuse(const CubeMapPlan& drawn, const CubeMapPlan& wanted);

/// clip_from_cube of an image: reversed z, infinite far plane; the near plane is `near_distance` (scene units) along
/// the face's normal.
glm::dmat4 clip_from_cube(const PlannedImage& image, double near_distance);

/// The first images of `images` that share the first one's rest frame and tile. images: not empty, the rest of a plan's
/// list.
std::span<const PlannedImage> of_first_tile(std::span<const PlannedImage> images);

/// The warp shader's entries: of one image, and of the whole plan; the second returns the bytes that it writes.
shared::TileEntry tile_entry(const PlannedImage& image);
std::size_t write_tiles(const CubeMapPlan& plan, shared::TileTable& table);

} // namespace starbow
