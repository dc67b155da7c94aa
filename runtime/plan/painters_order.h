#pragma once
#include "cull.h"

namespace starbow {

/// Sorts draws of one instance each, so that each comes after those behind it, as the eye at the origin sees their boxes:
/// where a side of one box parts it from the other box, by the eye's side of it; else by their middles. boxes: DrawList's.
void sort_from_behind(std::span<Draw> draws, const DrawList& list);

} // namespace starbow
