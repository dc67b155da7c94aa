#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "tone.glsl"
// One step of the glow: to half the size, or back to twice the size and mixed with the present picture. The first step takes
// the light that is brighter than a level. Each step's weights add up to 1, so that no light is created (filters of Bjorge,
// "Bandwidth-efficient rendering", 2015).

BLOOM_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Push { BloomPush push; };
layout(location = 0) out vec4 spread;

vec3 at(vec2 place)
{
    vec3 light = textureLod(picture, place, 0.0).rgb;
    return FIRST ? brighter_than(light, push.part.y) : light;
}

void main()
{
    vec2 place = gl_FragCoord.xy * push.step.xy;
    vec2 h = 0.5 * push.texel.xy;
    if (!UP) {
        vec3 sum = 4.0 * at(place) + at(place - h) + at(place + h) + at(place + vec2(h.x, -h.y)) + at(place - vec2(h.x, -h.y));
        spread = vec4(sum / 8.0, 1.0);
        return;
    }
    vec3 sum = at(place + vec2(2.0 * h.x, 0.0)) + at(place - vec2(2.0 * h.x, 0.0)) + at(place + vec2(0.0, 2.0 * h.y))
        + at(place - vec2(0.0, 2.0 * h.y))
        + 2.0 * (at(place - h) + at(place + h) + at(place + vec2(h.x, -h.y)) + at(place - vec2(h.x, -h.y)));
    spread = vec4(sum / 12.0 * push.part.x, push.part.x); // premultiplied: the rest stays
}
