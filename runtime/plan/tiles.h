#pragma once
#include "shaders/shared_structs.h"
#include <array>
#include <glm/glm.hpp>

namespace starbow {

/// The fixed division of a cube map into tiles, and of each tile into sub-tiles. A plan decides which of them are drawn,
/// and with which images.
///
/// One tile lies ahead. Each side has three bands across the motion. In each of them D varies little: up to 2.28-fold, in
/// the rear band. Behind lie nested squares that shrink by sqrt 2, because D varies as the square of the angle there: a
/// clip map.
///
/// Faces are numbered +z (ahead), -z (behind), +x, -x, +y, -y of the cube map's axes (see RestFrameView), which are the
/// motion axes wherever D varies much. A face's coordinates (a, b) are the two other components (x before y before z) over
/// the distance along its normal.

struct Rect {
    glm::dvec2 low{1e300}, high{-1e300};
    void add(const Rect& r) { low = glm::min(low, r.low), high = glm::max(high, r.high); }
    bool empty() const { return low.x > high.x || low.y > high.y; }
};
inline Rect intersection(const Rect& a, const Rect& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

/// The components of a direction along a face's a axis, b axis and normal.
constexpr int face_axis[6] = {2, 2, 0, 0, 1, 1};
constexpr int face_a[6] = {0, 0, 1, 1, 0, 0};
constexpr int face_b[6] = {1, 1, 2, 2, 2, 2};
constexpr double face_sign[6] = {1, -1, 1, -1, 1, -1};

/// The direction of a face coordinate, not normalised: it ends on the face's plane at distance 1.
glm::dvec3 face_direction(int face, const glm::dvec2& at);

int tile_face(int tile);
/// A tile's rectangle of its face's plane.
const Rect& tile_rect(int tile);
/// Half the side of the clip-map hole, the square in a nested tile's middle that belongs to the next tile; 0 without one.
double clip_hole(int tile, int finest_clip_level);

/// The tile of the unit direction n (the cube map's axes), and n's face coordinates there; the warp shader computes the
/// same.
struct TilePlace {
    int tile, face;
    glm::dvec2 at;
};
TilePlace tile_of(const glm::dvec3& n, int finest_clip_level);

/// A tile's sub-tiles: TILE_SUB_TILES along each side, rows along b. sub-tile = face coordinate * xy + zw; behind, the
/// coordinate's signed square replaces it.
constexpr int SUB_TILE_COUNT = TILE_SUB_TILES * TILE_SUB_TILES;
struct SubTiles {
    glm::ivec2 first{0}, count{TILE_SUB_TILES};
    bool all() const { return count == glm::ivec2(TILE_SUB_TILES); }
    bool operator==(const SubTiles&) const = default;
};
const glm::dvec4& sub_tiles_from_face(int tile);
Rect sub_tiles_rect(int tile, const SubTiles& sub_tiles);
/// The sub-tiles that a part of the face's plane touches.
SubTiles sub_tiles_in(int tile, const Rect& part);

/// The constants of each sub-tile: its part of the face's plane, and a mark if it lies in the clip-map hole. Further the
/// least and the greatest cos^2 of half the angle from straight ahead, with which D grows.
struct SubTileTable {
    std::array<Rect, SUB_TILE_COUNT> rects;
    std::array<bool, SUB_TILE_COUNT> in_clip_hole;
    std::array<double, SUB_TILE_COUNT> least_cos_half_square, most_cos_half_square;
};
const SubTileTable& sub_tile_table(int tile);

/// The nested tile of a point behind, from the larger of its coordinates' magnitudes.
int clip_level(double larger, int finest_clip_level);

} // namespace starbow
