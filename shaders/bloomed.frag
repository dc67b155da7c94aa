#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "tone.glsl"
#include "dither.glsl"
// Shows a viewport's exposed light with its glow; without a glow, warp.frag shows it by itself.

DITHER_CONSTANTS(DECLARED)
RANGE_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform sampler2D picture; // alpha 0: shows nothing
layout(set = 0, binding = 1) uniform sampler2D glow;    // half as large
layout(push_constant) uniform Push { BloomPush push; };
layout(location = 0) out vec4 shown;

void main()
{
    vec2 pixel = gl_FragCoord.xy - push.part.zw;
    vec4 light = texelFetch(picture, ivec2(pixel), 0);
    vec3 around = textureLod(glow, pixel * push.step.xy, 0.0).rgb;
    vec3 all = light.rgb + push.part.x * (around - brighter_than(light.rgb, push.part.y));
    vec3 screen = light.a > 0.0 ? (RANGE ? tone_map_in_order(all) : tone_map(all)) : vec3(0.0);
    shown = vec4(DITHERED ? dithered_srgb(screen, ivec2(gl_FragCoord.xy)) : screen, 1.0);
}
