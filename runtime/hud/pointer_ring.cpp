#include "pointer_ring.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// 1 within half a width of a line, and softly 0 beyond `soft`.
double line(double off, double half_width, double soft)
{
    const double t = std::clamp((half_width + soft - std::abs(off)) / soft, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace

Panel draw_pointer(double strength, double degree_px)
{
    constexpr double width_deg = 0.3, soft_deg = 0.25; // of the bright line, and of its edges
    constexpr double radius_deg = 0.5 * (pointer_deg - width_deg);
    const int side = int(std::ceil((pointer_deg + 4 * soft_deg) * degree_px));
    Panel panel{.size = {side, side}, .texels = {}};
    panel.texels.reserve(2 * std::size_t(side) * std::size_t(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double off = std::hypot(x + 0.5 - 0.5 * side, y + 0.5 - 0.5 * side) / degree_px - radius_deg;
            for (const double part :
                {0.9 * line(off, 0.5 * width_deg, soft_deg), 0.6 * line(off, 0.5 * width_deg, 2 * soft_deg)})
                panel.texels.push_back(std::uint8_t(std::lround(255 * strength * part)));
        }
    return panel;
}

} // namespace starbow
