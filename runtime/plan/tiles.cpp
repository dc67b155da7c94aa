#include "tiles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double band_edges[SIDE_BANDS + 1] = {-1, -0.5, 0, 1};

Rect rect_of(int slot)
{
    if (slot == SLOT_FRONT)
        return {{-1, -1}, {1, 1}};
    if (slot < SLOT_REAR) {
        const int band = (slot - SLOT_SIDES) % SIDE_BANDS;
        return {{-1, band_edges[band]}, {1, band_edges[band + 1]}};
    }
    const double half = std::exp2(-0.5 * (slot - SLOT_REAR));
    return {{-half, -half}, {half, half}};
}

/// Behind, cells are even in the squares of face coordinates, as D is there: none lies across the nested square's edge.
double spread_out(bool rear, double at) { return rear ? at * std::abs(at) : at; }
double drawn_in(bool rear, double at) { return rear ? std::copysign(std::sqrt(std::abs(at)), at) : at; }

/// What is the same in each frame.
struct Slots {
    std::array<Rect, SLOT_COUNT> rects;
    std::array<glm::dvec4, SLOT_COUNT> cells_from_face;
    Slots()
    {
        for (int slot = 0; slot < SLOT_COUNT; ++slot) {
            const Rect own = rects[std::size_t(slot)] = rect_of(slot);
            for (int i = 0; i < 2; ++i) {
                const double low = spread_out(slot >= SLOT_REAR, own.low[i]),
                             high = spread_out(slot >= SLOT_REAR, own.high[i]);
                cells_from_face[std::size_t(slot)][i] = SLOT_CELLS / (high - low);
                cells_from_face[std::size_t(slot)][2 + i] = -low * SLOT_CELLS / (high - low);
            }
        }
    }
};
const Slots fixed;

} // namespace

const Rect& slot_rect(int slot) { return fixed.rects[std::size_t(slot)]; }
const glm::dvec4& cells_from_face(int slot) { return fixed.cells_from_face[std::size_t(slot)]; }

glm::dvec3 face_direction(int face, const glm::dvec2& at)
{
    glm::dvec3 n;
    n[face_axis[face]] = face_sign[face];
    n[face_a[face]] = at.x;
    n[face_b[face]] = at.y;
    return n;
}

int slot_face(int slot) { return slot == SLOT_FRONT ? 0 : slot >= SLOT_REAR ? 1 : 2 + (slot - SLOT_SIDES) / SIDE_BANDS; }

double slot_hole(int slot, int rear_last)
{
    return slot >= SLOT_REAR && slot < SLOT_REAR + rear_last ? std::exp2(-0.5 * (slot + 1 - SLOT_REAR)) : 0;
}

int rear_level(double larger, int rear_last)
{
    // floor(-log2(larger^2)), an exact power of two going to the coarser image: the shader reads it from the exponent's
    // bits.
    int exponent;
    std::frexp(larger * larger, &exponent); // = [0.5, 1) 2^exponent
    return larger > 0 ? std::clamp(-exponent, 0, rear_last) : rear_last;
}

SlotPlace slot_of(const glm::dvec3& n, int rear_last)
{
    const glm::dvec3 m = glm::abs(n);
    int face;
    if (m.z >= std::max(m.x, m.y))
        face = n.z >= 0 ? 0 : 1;
    else if (m.x >= m.y)
        face = n.x >= 0 ? 2 : 3;
    else
        face = n.y >= 0 ? 4 : 5;
    const glm::dvec2 at = glm::dvec2(n[face_a[face]], n[face_b[face]]) / m[face_axis[face]];
    if (face == 0)
        return {SLOT_FRONT, face, at};
    if (face == 1)
        return {SLOT_REAR + rear_level(std::max(std::abs(at.x), std::abs(at.y)), rear_last), face, at};
    const int band = (at.y > band_edges[1]) + (at.y > band_edges[2]);
    return {SLOT_SIDES + (face - 2) * SIDE_BANDS + band, face, at};
}

Rect cells_rect(int slot, const Cells& cells)
{
    const bool rear = slot >= SLOT_REAR;
    const glm::dvec4& from_face = cells_from_face(slot);
    Rect rect;
    for (int i = 0; i < 2; ++i) {
        rect.low[i] = drawn_in(rear, (cells.first[i] - from_face[2 + i]) / from_face[i]);
        rect.high[i] = drawn_in(rear, (cells.first[i] + cells.count[i] - from_face[2 + i]) / from_face[i]);
    }
    return rect;
}

Cells cells_in(int slot, const Rect& part)
{
    const bool rear = slot >= SLOT_REAR;
    const glm::dvec4& from_face = cells_from_face(slot);
    Cells cells;
    for (int i = 0; i < 2; ++i) {
        auto cell = [&](double at) { return spread_out(rear, at) * from_face[i] + from_face[2 + i]; };
        cells.first[i] = std::clamp(int(std::floor(cell(part.low[i]))), 0, SLOT_CELLS - 1);
        cells.count[i] = std::clamp(int(std::ceil(cell(part.high[i]))), cells.first[i] + 1, SLOT_CELLS) - cells.first[i];
    }
    return cells;
}

const CellTable& cell_table(int slot)
{
    static const auto all = [] {
        std::array<CellTable, SLOT_COUNT> all;
        for (int slot = 0; slot < SLOT_COUNT; ++slot)
            for (int i = 0; i < CELL_COUNT; ++i) {
                CellTable& table = all[std::size_t(slot)];
                const std::size_t cell = std::size_t(i);
                const glm::ivec2 at(i % SLOT_CELLS, i / SLOT_CELLS);
                const Rect rect = table.rects[cell] = cells_rect(slot, {at, {1, 1}});
                const glm::ivec2 off = glm::abs(2 * at + 1 - SLOT_CELLS); // half cells from the middle
                table.in_hole[cell] = slot >= SLOT_REAR && std::max(off.x, off.y) < SLOT_CELLS / 2;
                // At corners: no cell lies across an axis of its face.
                double& least = table.least_cos_half_square[cell] = 1;
                double& most = table.most_cos_half_square[cell] = 0;
                for (const glm::dvec2& corner :
                    {rect.low, rect.high, glm::dvec2(rect.low.x, rect.high.y), glm::dvec2(rect.high.x, rect.low.y)}) {
                    const glm::dvec3 n = face_direction(slot_face(slot), corner);
                    // (1 + cos) / 2, which behind would be a difference of numbers almost alike
                    const double length = glm::length(n), across_square = n.x * n.x + n.y * n.y;
                    const double own = n.z > 0 ? 0.5 * (1 + n.z / length) : 0.5 * across_square / (length * (length - n.z));
                    least = std::min(least, own), most = std::max(most, own);
                }
            }
        return all;
    }();
    return all[std::size_t(slot)];
}

} // namespace starbow
