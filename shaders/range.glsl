// The curve of luminance that shows everything at once: the same for all outputs and eyes. range_curve.h says what it is.

#include "constants.h"

RANGE_CONSTANTS(DECLARED)
layout(set = 0, binding = 20) uniform Range { RangeConstants range; };

// The factor that brings light of this luminance (scene-linear, at EV 0) to its shown luminance. All three channels have it,
// so that hue and saturation stay.
float range_factor(float luminance)
{
    float stops = log2(clamp(luminance, 2e-38, 1e30)); // neither a subnormal number, which devices may take for 0
    float at = clamp(stops - RANGE_FIRST, 0.0, float(RANGE_KNOTS) - 1.001);
    int i = int(at);
    vec2 knot = range.knots[i].xy;
    return luminance > 2e-38 ? exp2(knot.x + (at - float(i)) * knot.y - stops) : 0.0;
}
