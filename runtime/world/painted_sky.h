#pragma once
#include "stars.h"
#include "world.h"

namespace starbow {

/// Paints stars onto a panorama of the whole sky (sRGB, equirectangular, as MilkyWay says), as they are seen from the Sun.
/// peak_arcmin2: the panorama's white, stars of magnitude 0 in each square minute of arc. The panorama becomes at least 4096
/// texels wide. A star is a Gaussian whose standard deviation is one texel: it is in its place between texels, and its
/// light is whole within 0.1 %, but for what exceeds white.
Texture painted(const Texture& panorama, const std::vector<Star>& stars, double peak_arcmin2);

} // namespace starbow
