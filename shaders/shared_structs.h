#pragma once
// The structs of shaders/shared.h as C++, with their layouts asserted.
#include <glm/glm.hpp>

namespace starbow::shared {
using glm::vec4;
#include "shared.h"
static_assert(sizeof(TileEntry) == 32);

/// The warp pass's data of a plan: for each rest frame each tile, drawn or not.
struct TileTable {
    vec4 sub_tiles_from_face[MAX_REST_FRAMES * TILE_COUNT]; ///< as in tiles.h; all 0: one image is the whole tile's
    TileEntry entries[MAX_REST_FRAMES * TILE_COUNT * TILE_SUB_TILES * TILE_SUB_TILES];
};
static_assert(sizeof(TileTable) == 16 * TILE_ENTRY(MAX_REST_FRAMES * TILE_COUNT, 0));
static_assert(sizeof(LightEntry) == 112);
static_assert(sizeof(SkyConstants) == 4 * 16 + 6 * MAX_GROUPS * 16);
static_assert(sizeof(ShadowEntry) == 80);
static_assert(sizeof(CubeConstants) == 10 * 16 + sizeof(SkyConstants) + MAX_LIGHTS * (112 + 80));
static_assert(sizeof(MaterialEntry) == 10 * 16);
static_assert(sizeof(RestFrameEntry) == 160);
static_assert(sizeof(RestFrameConstants) == 2 * 16 + sizeof(SkyConstants) + MAX_REST_FRAMES * 160);
static_assert(sizeof(InstanceEntry) == 48);
static_assert(sizeof(DeformingVertex) == 16 * DEFORMING_VERTEX_ROWS);
static_assert(sizeof(Displacement) == 16 * DISPLACEMENT_ROWS);
static_assert(sizeof(TimeEntry) == 112);
static_assert(sizeof(CubePush) == 64);
static_assert(sizeof(SkyImage) == 64);
static_assert(sizeof(DrawEntry) == 8);
static_assert(sizeof(SurfaceEntry) == 64);
static_assert(sizeof(ViewPush) == 128);
static_assert(sizeof(GlobeEntry) == 192);
static_assert(sizeof(GlobeConstants) == 4 * 16 + 16 * MAX_GLOWS + MAX_GLOBES * 192);
static_assert(sizeof(StarEntry) == 32);
static_assert(sizeof(StarConstants) == 48);
static_assert(sizeof(RangeConstants) == 16 * RANGE_KNOTS);
static_assert(sizeof(OverlayConstants) == 176);
static_assert(sizeof(FinishPush) == 112);
static_assert(sizeof(BloomPush) == 48);
static_assert(sizeof(PatternPush) == 96);

/// A row of a matrix, as shaders read it.
inline vec4 row(const glm::dmat3& m, int i, double w = 0) { return vec4(m[0][i], m[1][i], m[2][i], w); }
inline vec4 row(const glm::dmat4& m, int i) { return vec4(m[0][i], m[1][i], m[2][i], m[3][i]); }

} // namespace starbow::shared
