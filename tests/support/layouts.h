#pragma once
#include "config/model/layout.h"
#include "tests/support/files.h"
#include <algorithm>

namespace starbow::testing {

/// A layout whose outputs are drawn small: the longer side of each has `side` pixels.
inline Layout small_layout(const std::filesystem::path& file, int side)
{
    Layout layout = load_layout(file);
    for (Output& output : layout.outputs) {
        const double scale = double(side) / std::max(output.size.x, output.size.y);
        output.size = glm::max(glm::ivec2(glm::round(glm::dvec2(output.size) * scale)), 16);
    }
    return layout;
}

inline Layout small_shipped_layout(const std::string& name, int side)
{
    return small_layout(source_dir() / "config/layouts" / (name + ".json"), side);
}

} // namespace starbow::testing
