#pragma once
#include "shaders/shared_structs.h"
#include <array>
#include <glm/glm.hpp>

namespace starbow {

/// The cut of a cube map, fixed: its tiles, and the cells of each. A plan decides which of them it draws, and how.
///
/// One tile ahead; each side in three bands across the motion, so that D varies less than twofold in each; behind, nested
/// squares shrinking by sqrt 2 (D varies as the square of the angle there).
///
/// Faces are numbered +z (ahead), -z (behind), +x, -x, +y, -y of the motion axes; a face's coordinates (a, b) are the two
/// other components (x before y before z) over the distance along its normal.

struct Rect {
    glm::dvec2 low{1e300}, high{-1e300};
    void add(const Rect& r) { low = glm::min(low, r.low), high = glm::max(high, r.high); }
    bool empty() const { return low.x > high.x || low.y > high.y; }
};
inline Rect intersection(const Rect& a, const Rect& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

/// Components of a direction along a face's a axis, b axis and normal.
constexpr int face_axis[6] = {2, 2, 0, 0, 1, 1};
constexpr int face_a[6] = {0, 0, 1, 1, 0, 0};
constexpr int face_b[6] = {1, 1, 2, 2, 2, 2};
constexpr double face_sign[6] = {1, -1, 1, -1, 1, -1};

/// Unit direction (not normalised: length of the face's plane) of a face coordinate.
glm::dvec3 face_direction(int face, const glm::dvec2& at);

int tile_face(int tile);
/// The part of its face's plane that belongs to a tile.
const Rect& tile_rect(int tile);
/// Half the side of the square in a nested tile's middle that belongs to the next one; 0 where none does.
double clip_hole(int tile, int finest_clip_level);

/// The tile that shows the unit direction n (motion axes) and n's face coordinates there: what the warp shader does.
struct TilePlace {
    int tile, face;
    glm::dvec2 at;
};
TilePlace tile_of(const glm::dvec3& n, int finest_clip_level);

/// A tile's cells: TILE_SUB_TILES along each side, rows along b. cell = face coordinate * xy + zw; behind, its square with its
/// sign instead.
constexpr int SUB_TILE_COUNT = TILE_SUB_TILES * TILE_SUB_TILES;
struct SubTiles {
    glm::ivec2 first{0}, count{TILE_SUB_TILES};
    bool all() const { return count == glm::ivec2(TILE_SUB_TILES); }
    bool operator==(const SubTiles&) const = default;
};
const glm::dvec4& sub_tiles_from_face(int tile);
Rect sub_tiles_rect(int tile, const SubTiles& sub_tiles);
/// Those that a part of the face's plane touches.
SubTiles sub_tiles_in(int tile, const Rect& part);

/// What is told of each cell: its part of the face's plane; whether it lies in the hole; the least and the greatest square
/// of the cosine of half the angle from straight ahead, which D grows with.
struct SubTileTable {
    std::array<Rect, SUB_TILE_COUNT> rects;
    std::array<bool, SUB_TILE_COUNT> in_clip_hole;
    std::array<double, SUB_TILE_COUNT> least_cos_half_square, most_cos_half_square;
};
const SubTileTable& sub_tile_table(int tile);

/// Which nested tile a point behind belongs to, from the larger of its coordinates.
int clip_level(double larger, int finest_clip_level);

} // namespace starbow
