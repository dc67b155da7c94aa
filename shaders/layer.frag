#version 460
#extension GL_GOOGLE_include_directive : require
#include "constants.h"
// Adds one layer of overlapping viewports to an output's canvas: each pixel's light times its share.

LAYER_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform sampler2D picture; // the layer's views
layout(set = 0, binding = 1) uniform sampler2D shares;  // Shade::shares: rgb: factor, a: part
layout(location = 0) out vec4 shown;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 share = texelFetch(shares, p, 0);
    shown = vec4(texelFetch(picture, p, 0).rgb * (PLAIN ? share.aaa : share.rgb), 0.0);
}
