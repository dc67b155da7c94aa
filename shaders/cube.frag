#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// Scene-linear, pre-exposed radiance of a surface. What a world does not have is compiled out.

layout(constant_id = 0) const bool BASE_TEXTURE = true;
layout(constant_id = 1) const bool EMISSIVE_TEXTURE = true;
layout(constant_id = 2) const bool MASKED = true;
layout(constant_id = 3) const bool UNLIT = false;
layout(constant_id = 4) const int LIGHTS = MAX_LIGHTS;

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 1, binding = 0) uniform sampler2D base_texture;
layout(set = 1, binding = 1) uniform sampler2D emissive_texture;
layout(push_constant) uniform Push { CubePush push; };

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 0) out vec4 radiance;

void main()
{
    vec4 base = colour;
    if (BASE_TEXTURE)
        base *= texture(base_texture, uv);
    if (MASKED && base.a < push.emissive.w)
        discard;
    vec3 emitted = push.emissive.rgb;
    if (EMISSIVE_TEXTURE)
        emitted *= texture(emissive_texture, uv).rgb;
    vec3 light = vec3(cube.ambient.w);
    if (!UNLIT) {
        light = cube.ambient.rgb;
        vec3 n = normalize(gl_FrontFacing ? normal : -normal);
        for (int i = 0; i < LIGHTS; ++i) {
            vec4 where = cube.lights[i].place;
            vec3 towards = where.xyz - where.w * place;
            float square = where.w == 0.0 ? 1.0 : dot(towards, towards);
            float fall = where.w == 0.0 ? 1.0 : cube.lights[i].radiance.w / (square * sqrt(square));
            light += cube.lights[i].radiance.rgb * (max(dot(n, towards), 0.0) * fall);
        }
    }
    // 60000 is below fp16's greatest number: a light at arm's length must not become infinite.
    radiance = vec4(min(base.rgb * light + emitted, vec3(60000.0)), 1.0);
}
