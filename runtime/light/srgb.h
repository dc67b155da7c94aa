#pragma once
#include <cmath>

namespace starbow {

/// sRGB's curve, IEC 61966-2-1: from a stored value to light, both 0 to 1, and back.
inline double light_of_srgb(double value)
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
inline double srgb_of_light(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

} // namespace starbow
