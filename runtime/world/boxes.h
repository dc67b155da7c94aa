#pragma once
#include "config/model/flying.h"
#include <algorithm>

namespace starbow {

/// The box around two boxes.
inline AlignedBox around(const AlignedBox& a, const AlignedBox& b)
{
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

/// The box around a box that a transform has turned.
inline AlignedBox transformed(const AlignedBox& box, const glm::dmat4& transform)
{
    const auto corner = [&](int which) {
        const glm::dvec3 at(
            which & 1 ? box.high.x : box.low.x, which & 2 ? box.high.y : box.low.y, which & 4 ? box.high.z : box.low.z);
        return glm::dvec3(transform * glm::dvec4(at, 1));
    };
    AlignedBox out{corner(0), corner(0)};
    for (int which = 1; which < 8; ++which)
        out = around(out, {corner(which), corner(which)});
    return out;
}

/// True for a thing as flat as a ground: less than a tenth as high as wide.
inline bool is_flat(const AlignedBox& box)
{
    const glm::dvec3 size = box.high - box.low;
    return size.y < 0.1 * std::max(size.x, size.z);
}

} // namespace starbow
