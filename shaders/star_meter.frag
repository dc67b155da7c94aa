#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A star's luminance sample for the exposure: it has its spot's middle luminance, and a solid angle with which its light
// is the star's.

layout(location = 0) flat in vec3 pixel; // x: the root of its solid angle
layout(location = 1) flat in vec3 light; // of the whole star, spread over the solid angle of a pixel
layout(location = 2) flat in vec4 glare; // w: the part of the light in the spot
layout(location = 0) out vec2 metered;   // as meter.frag's

void main()
{
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722); // Rec. 709
    float pixels = STAR_SPOT;
    metered = vec2(min(max(dot(light, luminance) * glare.w, 0.0) / pixels, 1e38), pixels * pixel.x * pixel.x);
}
