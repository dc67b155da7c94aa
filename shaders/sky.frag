#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(constant_id = 0) const int GROUPS = 1;
layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(location = 0) in vec3 way;
layout(location = 0) out vec4 coefficients0;
layout(location = 1) out vec4 coefficients1;
layout(location = 2) out vec4 coefficients2;
layout(location = 3) out vec4 coefficients3;

void main()
{
    float height = dot(way, cube.world_up.xyz) * inversesqrt(dot(way, way));
    float part = smoothstep(0.0, 1.0, abs(height));
    vec4 coefficients[MAX_GROUPS];
    for (int group = 0; group < GROUPS; ++group)
        coefficients[group] = mix(cube.sky_horizon[group], height > 0.0 ? cube.sky_zenith[group] : cube.sky_nadir[group], part);
    coefficients0 = coefficients[0];
    if (GROUPS > 1)
        coefficients1 = coefficients[1];
    if (GROUPS > 2)
        coefficients2 = coefficients[2];
    if (GROUPS > 3)
        coefficients3 = coefficients[3];
}
