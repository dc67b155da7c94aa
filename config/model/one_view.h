#pragma once
#include "layout.h"

namespace starbow {

/// A layout of one output, named "view", with one viewport that fills it.
inline Layout one_view(const Projection& projection, glm::ivec2 size)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].name = "view";
    layout.outputs[0].size = size;
    layout.outputs[0].viewports = {{.projection = projection}};
    return layout;
}

} // namespace starbow
