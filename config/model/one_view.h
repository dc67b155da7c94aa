#pragma once
#include "layout.h"

namespace starbow {

/// A layout of one output, called "view", that one viewport fills.
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
