#pragma once
// The structs of shaders/shared.h as C++, with their layouts asserted.
#include <glm/glm.hpp>

namespace starbow::shared {
using glm::vec4;
#include "shared.h"
static_assert(sizeof(SlotEntry) == 32);

/// All that the warp pass reads of a plan: for each layer each slot, drawn or not.
struct SlotTable {
    vec4 cells_from_face[MAX_LAYERS * SLOT_COUNT]; ///< as slots.h's; all 0: one image is the whole slot's
    SlotEntry entries[MAX_LAYERS * SLOT_COUNT * SLOT_CELLS * SLOT_CELLS];
};
static_assert(sizeof(SlotTable) == 16 * SLOT_ENTRY(MAX_LAYERS * SLOT_COUNT, 0));
static_assert(sizeof(LightEntry) == 80);
static_assert(sizeof(CubeConstants) == 4 * 16 + 3 * MAX_GROUPS * 16 + MAX_LIGHTS * 80);
static_assert(sizeof(LayerEntry) == 96);
static_assert(sizeof(LayerConstants) == 2 * 16 + 3 * MAX_GROUPS * 16 + MAX_LAYERS * 96);
static_assert(sizeof(InstanceEntry) == 48);
static_assert(sizeof(TimeEntry) == 96);
static_assert(sizeof(CubePush) == 128);
static_assert(sizeof(ViewPush) == 128);
static_assert(sizeof(StarEntry) == 32);
static_assert(sizeof(StarConstants) == 48);
static_assert(sizeof(OverlayConstants) == 176);
static_assert(sizeof(FinishPush) == 112);
static_assert(sizeof(BloomPush) == 48);
static_assert(sizeof(PatternPush) == 96);

/// A row of a matrix, as shaders read it.
inline vec4 row(const glm::dmat3& m, int i, double w = 0) { return vec4(m[0][i], m[1][i], m[2][i], w); }
inline vec4 row(const glm::dmat4& m, int i) { return vec4(m[0][i], m[1][i], m[2][i], m[3][i]); }

} // namespace starbow::shared
