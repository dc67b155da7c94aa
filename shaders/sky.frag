#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(location = 0) in vec3 way;
layout(location = 0) out vec4 radiance;

void main()
{
    float height = dot(way, cube.world_up.xyz) * inversesqrt(dot(way, way));
    vec3 pole = height > 0.0 ? cube.sky_zenith.rgb : cube.sky_nadir.rgb;
    radiance = vec4(mix(cube.sky_horizon.rgb, pole, smoothstep(0.0, 1.0, abs(height))), 1.0);
}
