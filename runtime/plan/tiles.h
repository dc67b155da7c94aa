#pragma once
#include "shaders/shared_structs.h"
#include <array>
#include <glm/glm.hpp>

namespace starbow {

/// The cut of a cube map, fixed: its slots, and the cells of each. A plan decides which of them it draws, and how.
///
/// One slot ahead; each side in three bands across the motion, so that D varies less than twofold in each; behind, nested
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

int slot_face(int slot);
/// The part of its face's plane that belongs to a slot.
const Rect& slot_rect(int slot);
/// Half the side of the square in a nested slot's middle that belongs to the next one; 0 where none does.
double slot_hole(int slot, int rear_last);

/// The slot that shows the unit direction n (motion axes) and n's face coordinates there: what the warp shader does.
struct SlotPlace {
    int slot, face;
    glm::dvec2 at;
};
SlotPlace slot_of(const glm::dvec3& n, int rear_last);

/// A slot's cells: SLOT_CELLS along each side, rows along b. cell = face coordinate * xy + zw; behind, its square with its
/// sign instead.
constexpr int CELL_COUNT = SLOT_CELLS * SLOT_CELLS;
struct Cells {
    glm::ivec2 first{0}, count{SLOT_CELLS};
    bool all() const { return count == glm::ivec2(SLOT_CELLS); }
    bool operator==(const Cells&) const = default;
};
const glm::dvec4& cells_from_face(int slot);
Rect cells_rect(int slot, const Cells& cells);
/// Those that a part of the face's plane touches.
Cells cells_in(int slot, const Rect& part);

/// What is told of each cell: its part of the face's plane; whether it lies in the hole; the least and the greatest square
/// of the cosine of half the angle from straight ahead, which D grows with.
struct CellTable {
    std::array<Rect, CELL_COUNT> rects;
    std::array<bool, CELL_COUNT> in_hole;
    std::array<double, CELL_COUNT> least_cos_half_square, most_cos_half_square;
};
const CellTable& cell_table(int slot);

/// Which nested slot a point behind belongs to, from the larger of its coordinates.
int rear_level(double larger, int rear_last);

} // namespace starbow
