#pragma once
#include "config/json/error.h"
#include "config/model/layout.h"
#include "config/model/shipped.h"
#include <charconv>
#include <glm/glm.hpp>
#include <string>

namespace starbow {

/// "800x600". Throws InputError.
inline glm::ivec2 parse_size(const std::string& text)
{
    glm::ivec2 size(0);
    const char* end = text.data() + text.size();
    auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        auto height = std::from_chars(width.ptr + 1, end, size.y);
        if (height.ec == std::errc() && height.ptr == end && size.x >= 1 && size.y >= 1 && size.x <= 16384
            && size.y <= 16384)
            return size;
    }
    throw InputError(
        "--size " + text + " is not a size; give width x height in pixels, each from 1 to 16384, such as 1280x720");
}

/// Gives every output of a layout the size of --size, unless that is empty. Throws InputError.
inline void set_size(Layout& layout, const std::string& size)
{
    if (!size.empty())
        for (Output& output : layout.outputs)
            output.size = parse_size(size);
}

/// The layout by --layout, or the desk's, in the size of --size. Throws InputError.
inline Layout layout_in_size(const std::string& name, const std::string& size)
{
    Layout layout = load_layout(shipped_file("layouts", name.empty() ? "desk" : name));
    set_size(layout, size);
    return layout;
}

} // namespace starbow
