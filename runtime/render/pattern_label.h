#pragma once
#include "displays/compile/compiled_view.h"
#include "resources.h"

namespace starbow {

/// The label of a view in the test patterns: output, viewport, eye and pixels, as a picture of text (r of R8G8). sent:
/// the pixels that the projector gets, where the view is a preview of them.
Image make_label(Device& device, const Layout& layout, const View& view, glm::ivec2 sent);

/// The scale at which the view's rectangle, around its middle, shows something all along its edge: 1 for a whole
/// rectangle, 0.7 for a circle. It is 1 too where the middle is dark.
float shown_part(const CompiledView& view);

/// Colours that distinguish outputs and eyes, linear. The tints of overlapping outputs add up to a third.
glm::vec3 output_tint(std::size_t output);
glm::vec3 eye_tint(Eye eye);

} // namespace starbow
