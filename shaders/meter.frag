#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "part.glsl"
#include "sun_glare.glsl"
// Samples the view's luminance for the exposure: one pixel represents zenith.z x zenith.w pixels of the viewport. Where
// colours have directions of their own, green's is used.

RANGE_CONSTANTS(DECLARED)
layout(location = 0) out vec2 metered; // luminance of the scene-linear light at EV 0; solid angle, 0: nothing is shown

void main()
{
    metered = vec2(0.0);
    float pixel_angle, coarser = sqrt(view.zenith.z * view.zenith.w);
    vec2 pixel = (gl_FragCoord.xy - view.origin.xy) * view.zenith.zw;
    Shown shown = shown_at(pixel, CHANNELS ? 1 : 0, coarser, pixel_angle);
    vec3 light = shown.light;
    if (MAP && pixel_angle == 0.0)
        return;
    if (WITH_SUN_GLARE && !RANGE)
        light += sun_glare(shown.n);
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722); // Rec. 709
    metered = vec2(clamp(dot(light, luminance) * view.boost.z, 0.0, 1e38), pixel_angle * pixel_angle * coarser * coarser);
    if (LAYERED)
        metered.y *= part_of(ivec2(pixel + view.corner.xy));
}
