#pragma once
#include "coverage.h"

namespace starbow {

/// The floor plan of a layout as an SVG file's text: a map of the sky with each viewport's outline (one for each eye where
/// there are two); the outputs with their viewports; the room from above where walls, mirrors or eyes have places in it;
/// and the table of floor_plan_table.h. coverages: of this layout.
std::string draw_floor_plan(const Layout& layout, const std::vector<Coverage>& coverages);

} // namespace starbow
