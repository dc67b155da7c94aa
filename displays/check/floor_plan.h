#pragma once
#include "coverage.h"

namespace starbow {

/// The floor plan of a layout as an SVG file's text. It has a map of the sky with each viewport's outline, one for each eye
/// where there are two. Below are the outputs with their viewports, and the room from above where walls, mirrors or eyes
/// have places in it. Last comes the table of floor_plan_table.h. coverages: of this layout. hud: the
/// head-up display's place; without one it is not drawn.
std::string draw_floor_plan(
    const Layout& layout, const std::vector<Coverage>& coverages, const std::optional<HudPlacement>& hud = {});

} // namespace starbow
