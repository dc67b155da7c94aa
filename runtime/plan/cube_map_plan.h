#pragma once
#include "config/model/quality.h"
#include "demand.h"
#include <span>
#include <vector>

namespace starbow {

/// One picture to draw: a rectangle of one face of the cube around the eye, at one resolution, and its place in the atlas.
struct PlannedImage {
    int tile; ///< of its layer
    int face;
    glm::dvec2 low, high; ///< face coordinates of the picture's edges, gutter included
    glm::ivec2 size; ///< texels
    glm::ivec2 atlas; ///< top left texel
    double texels_per_unit; ///< of face coordinate
    int levels; ///< mip levels the warp pass reads
    double clip_hole = 0; ///< half the side of the square in the middle that no pixel reads: a finer image holds it
    int layer = 0;
    SubTiles sub_tiles{}; ///< of its tile, for which it stands
};

/// What is wanted of each rectangle that halving a tile leads to, along either side and again and again. Intervals of a side
/// are a binary heap: 0 is the whole, 2 n + 1 and 2 n + 2 are the halves of n.
struct TileDemands {
    static constexpr int intervals = 2 * TILE_SUB_TILES - 1;
    int layer, tile;
    Demand demands[intervals][intervals]; ///< [along b][along a]
    double wanted[intervals][intervals]; ///< texels, at a density of 1 and if each cell had just what it wants
};

/// What the cube map of one eye must hold for one frame.
struct CubeMapPlan {
    std::vector<PlannedImage> images; ///< by layer, then by tile
    glm::ivec2 atlas_size{0};
    std::vector<int> finest_clip_level; ///< of each layer: the finest nested image behind that differs from the one before
    int levels = 1; ///< of the atlas: the most that any image needs
    double texels = 0; ///< drawn, all images
    double pixels = 0; ///< served
    bool cut = false; ///< some tile has more than one image
};

/// What plan_cube_map works with; kept for its room, from frame to frame and for all eyes.
struct PlanScratch {
    std::vector<Demands> demands; ///< of each layer
    std::vector<TileDemands> by_tile;
    std::vector<std::size_t> by_height;
};

/// Decides which faces are looked at, in which rectangle and how finely. Pure. Every texel that a pixel of the views reads,
/// the neighbours of its filter included, lies inside an image.
///
/// A tile that nobody looks at is left out, and so is one in which nothing stands. Any other is cut into as many images,
/// each with its own resolution, as cost least: Quality::image_cost_texels for each, and its texels. before: a plan whose
/// memory is taken over.
CubeMapPlan plan_cube_map(const std::vector<RestFrameRequest>& layers, const Quality& quality, PlanScratch& room, CubeMapPlan before = {});
CubeMapPlan plan_cube_map(const std::vector<RestFrameRequest>& layers, const Quality& quality);
/// Of a world in which nothing moves.
CubeMapPlan plan_cube_map(const std::vector<ViewRequest>& views, double E, const Quality& quality);

/// Whether what is drawn for one plan serves another, at hardly less density: it may then be shown once more.
bool can_reuse(const CubeMapPlan& drawn, const CubeMapPlan& wanted);

/// clip_from_motion of an image: reversed z, infinite far plane, near plane at `near_distance` along the face's normal.
glm::dmat4 clip_from_motion(const PlannedImage& image, double near_distance);

/// Of a plan's images, or those left of it, the ones of the same layer and tile as the first. images: not none.
std::span<const PlannedImage> of_first_tile(std::span<const PlannedImage> images);

/// What the warp shader reads of one image, and of all.
shared::TileEntry tile_entry(const PlannedImage& image);
void write_tiles(const CubeMapPlan& plan, shared::TileTable& table);

} // namespace starbow
