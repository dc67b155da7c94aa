#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "dither.glsl"
// Turns an output's canvases, in linear light, into its screen's or projector's input: it combines both eyes, matches the
// projectors' colours, applies blend ramps and black level, and applies the input's curve.

DITHER_CONSTANTS(DECLARED)
FINISH_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform sampler2D left_picture;
layout(set = 0, binding = 1) uniform sampler2D right_picture;
layout(set = 0, binding = 2) uniform sampler2D weights;     // factors of the light
layout(set = 0, binding = 3) uniform sampler2D black_level; // addends of the light
layout(set = 0, binding = 4) uniform sampler2D table;       // input for evenly spaced light

layout(push_constant) uniform Push { FinishPush push; };
layout(location = 0) out vec4 shown;

vec3 through(vec4 row0, vec4 row1, vec4 row2, vec3 light)
{
    return vec3(dot(row0.xyz, light), dot(row1.xyz, light), dot(row2.xyz, light));
}

vec3 tabled(vec3 light)
{
    vec3 at = light * push.curve.x;
    ivec3 i = ivec3(min(at, vec3(push.curve.x - 1.0)));
    vec3 f = at - vec3(i);
    return mix(vec3(texelFetch(table, ivec2(i.r, 0), 0).r, texelFetch(table, ivec2(i.g, 0), 0).g, texelFetch(table, ivec2(i.b, 0), 0).b),
        vec3(texelFetch(table, ivec2(i.r + 1, 0), 0).r, texelFetch(table, ivec2(i.g + 1, 0), 0).g, texelFetch(table, ivec2(i.b + 1, 0), 0).b), f);
}

// An image of one texel applies to all pixels.
vec3 spread(sampler2D picture, ivec2 p) { return texelFetch(picture, min(p, textureSize(picture, 0) - 1), 0).rgb; }

// The target encodes by sRGB's curve; this is the light that encodes to the wanted value.
vec3 undo_srgb(vec3 value)
{
    return mix(value / 12.92, pow((value + 0.055) / 1.055, vec3(2.4)), greaterThan(value, vec3(0.04045)));
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 light;
    if (COMBINE == 4) {
        light = through(push.left0, push.left1, push.left2, texelFetch(left_picture, p, 0).rgb)
            + through(push.right0, push.right1, push.right2, texelFetch(right_picture, p, 0).rgb);
    } else {
        int second = COMBINE == 1 ? p.y & 1 : COMBINE == 2 ? p.x & 1 : COMBINE == 3 ? (p.x + p.y) & 1 : 0;
        vec3 own = second == 0 ? texelFetch(left_picture, p, 0).rgb : texelFetch(right_picture, p, 0).rgb;
        light = through(push.left0, push.left1, push.left2, own);
    }
    light = max(light, vec3(0.0));
    if (SCREENED)
        light = light * push.curve.y * spread(weights, p) + spread(black_level, p);
    light = min(light, vec3(1.0));
    if (CURVE == 0) {
        if (DITHERED)
            light = dithered_srgb(light, p);
    } else {
        vec3 value = CURVE == 1 ? pow(light, vec3(push.curve.x)) : tabled(light);
        if (DITHERED)
            value = clamp(value + dither(p) * min(value * 2550.0, vec3(1.0)), 0.0, 1.0); // black stays black: see dithered_srgb
        light = undo_srgb(value);
    }
    shown = vec4(light, 1.0);
}
