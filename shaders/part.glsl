// The part that a view has of an output's pixel where viewports overlap (Shade::shares), for the exposure's samples.

#include "constants.h"

PART_CONSTANTS(DECLARED)

layout(set = 0, binding = 13) uniform sampler2D shares;

float part_of(ivec2 pixel) { return texelFetch(shares, pixel, 0).a; }
