#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// Scene-linear, pre-exposed light of a surface, as the numbers of the world's spectral basis: those of what it reflects, then
// those of the world's own spectra. What a world does not have is compiled out.

layout(constant_id = 0) const bool BASE_TEXTURE = true;
layout(constant_id = 1) const bool EMISSIVE_TEXTURE = true;
layout(constant_id = 2) const bool MASKED = true;
layout(constant_id = 3) const bool UNLIT = false;
layout(constant_id = 4) const int LIGHTS = MAX_LIGHTS;
layout(constant_id = 5) const int REFLECTED = 3;
layout(constant_id = 6) const int OWN = 0;
layout(constant_id = 7) const int KINDS = 1; // of spectra that shine on surfaces, at most one more than MAX_OWN
layout(constant_id = 8) const bool MATRICES = false; // otherwise the numbers are the colour itself, and what is beyond it
layout(constant_id = 9) const bool CLOCK = false;

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 0, binding = 3) uniform Matrices { vec4 columns[MAX_MATRICES]; }; // [set][kind][group][r, g, b, uv, ir]
layout(set = 0, binding = 4) readonly buffer Clocks { ClockEntry clocks[]; };
layout(set = 1, binding = 0) uniform sampler2D base_texture;
layout(set = 1, binding = 1) uniform sampler2D emissive_texture;
layout(push_constant) uniform Push { CubePush push; };

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uint instance; // CLOCK
layout(location = 0) out vec4 numbers0;
layout(location = 1) out vec4 numbers1;
layout(location = 2) out vec4 numbers2;
layout(location = 3) out vec4 numbers3;

const int GROUPS = (REFLECTED + OWN + 3) / 4;
const vec3 luminance = vec3(0.2126, 0.7152, 0.0722); // Rec. 709

#include "clock.glsl"

float mean(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// What is reflected in the ultraviolet and the infrared.
vec2 beyond_visible(vec3 lit, vec3 light)
{
    return vec2(push.beyond.x < 0.0 ? mean(lit) : push.beyond.x * mean(light),
        push.beyond.y < 0.0 ? mean(lit) : push.beyond.y * mean(light));
}

void main()
{
    vec4 base = colour;
    if (BASE_TEXTURE)
        base *= texture(base_texture, uv);
    float ink = 0.0;
    if (CLOCK) {
        ClockEntry clock = clocks[instance];
        vec2 at = vec2(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y);
        float distance_ = length(place);
        vec2 farther_on = vec2(dFdx(distance_), dFdy(distance_));
        // |place| - |middle| without their difference.
        float farther = dot(place - clock.middle.xyz, place + clock.middle.xyz) / (distance_ + clock.middle.w);
        ink = marks(at, mat2(dFdx(at), dFdy(at)), -farther * clock.turns.w, -farther_on * clock.turns.w, clock);
        base.rgb *= 1.0 - ink;
    }
    if (MASKED && base.a < push.emissive.w)
        discard;
    vec3 emitted = push.emissive.rgb;
    if (EMISSIVE_TEXTURE)
        emitted *= texture(emissive_texture, uv).rgb;
    if (CLOCK)
        emitted *= ink;
    vec3 light[MAX_OWN + 1];
    for (int kind = 0; kind < KINDS; ++kind)
        light[kind] = vec3(0.0);
    light[0] = vec3(cube.ambient.w);
    if (!UNLIT) {
        light[0] = cube.ambient.rgb;
        vec3 n = normalize(gl_FrontFacing ? normal : -normal);
        for (int i = 0; i < LIGHTS; ++i) {
            vec4 where = cube.lights[i].place;
            vec3 towards = where.xyz - where.w * place;
            float square = where.w == 0.0 ? 1.0 : dot(towards, towards);
            float fall = where.w == 0.0 ? 1.0 : cube.lights[i].radiance.w / (square * sqrt(square));
            vec3 add = cube.lights[i].radiance.rgb * (max(dot(n, towards), 0.0) * fall);
            for (int kind = 0; kind < KINDS; ++kind)
                light[kind] += KINDS == 1 || int(cube.lights[i].kind.x) == kind ? add : vec3(0.0);
        }
    }

    vec4 numbers[MAX_GROUPS];
    for (int group = 0; group < GROUPS; ++group)
        numbers[group] = vec4(0.0);
    bool own_emission = OWN > 0 && push.beyond.w >= 0.0;
    vec3 coloured = own_emission ? vec3(0.0) : emitted;
    if (MATRICES) {
        int at = int(push.beyond.z) * (KINDS * GROUPS * 5);
        for (int kind = 0; kind < KINDS; ++kind) {
            vec3 lit = base.rgb * light[kind];
            vec2 beyond = beyond_visible(lit, light[kind]);
            if (kind == 0) {
                lit += coloured;
                beyond += mean(coloured);
            }
            for (int group = 0; group < GROUPS; ++group) {
                int column = at + (kind * GROUPS + group) * 5;
                numbers[group] += columns[column] * lit.r + columns[column + 1] * lit.g + columns[column + 2] * lit.b
                    + columns[column + 3] * beyond.x + columns[column + 4] * beyond.y;
            }
        }
    } else {
        vec3 lit = base.rgb * light[0];
        numbers[0].rgb = lit + coloured;
        if (REFLECTED == 5) {
            vec2 beyond = beyond_visible(lit, light[0]) + mean(coloured);
            numbers[0].a = beyond.x;
            numbers[1].r = beyond.y;
        }
    }
    for (int i = 0; i < OWN; ++i)
        numbers[(REFLECTED + i) / 4][(REFLECTED + i) % 4]
            += push.own[i] + (int(push.beyond.w) == i ? dot(luminance, emitted) : 0.0);
    // 60000 is below fp16's greatest number: a light at arm's length must not become infinite.
    for (int group = 0; group < GROUPS; ++group)
        numbers[group] = clamp(numbers[group], vec4(-60000.0), vec4(60000.0));
    numbers0 = numbers[0];
    if (GROUPS > 1)
        numbers1 = numbers[1];
    if (GROUPS > 2)
        numbers2 = numbers[2];
    if (GROUPS > 3)
        numbers3 = numbers[3];
}
