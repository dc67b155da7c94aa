#pragma once
#include "displays/panes.h"
#include "resources.h"

namespace starbow {

/// What the test patterns write on a pane: its output, viewport, eye and pixels, as a picture of letters (r of R8G8).
Image make_label(Device& device, const Layout& layout, const Pane& pane);

/// Colours that tell outputs, and eyes, apart; linear. Where outputs overlap theirs add up to a third.
glm::vec3 output_tint(std::size_t output);
glm::vec3 eye_tint(Eye eye);

} // namespace starbow
