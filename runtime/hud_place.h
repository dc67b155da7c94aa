#pragma once
#include "displays/compiled.h"
#include <span>

namespace starbow {

/// Panel axes from the cockpit's: x right and y up on the panel, z = 1 on its plane, the origin at its middle. On a flat
/// screen the panel is parallel to it, so that its lines stay level; everywhere else it faces the visitor.
/// panes: of each output.
glm::dmat3 panel_from_cockpit(const HudPlacement& hud, std::span<const std::vector<CompiledPane>> panes);

} // namespace starbow
