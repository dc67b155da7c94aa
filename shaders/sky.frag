#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"

SKY_PASS_CONSTANTS(DECLARED)
PANORAMA_CONSTANTS(DECLARED)
layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 1, binding = 0) uniform sampler2D milky_way;
layout(location = 0) in vec3 way;
layout(location = 0) out vec4 coefficients0;
layout(location = 1) out vec4 coefficients1;
layout(location = 2) out vec4 coefficients2;
layout(location = 3) out vec4 coefficients3;

#define SKY cube.sky
#include "sky.glsl"

void main()
{
    vec3 n = normalize(way);
    float angle = MILKY_WAY ? max(length(dFdx(n)), length(dFdy(n))) : 0.0;
    vec4 coefficients[MAX_GROUPS];
    sky_light(n, angle, coefficients);
    coefficients0 = coefficients[0];
    if (GROUPS > 1)
        coefficients1 = coefficients[1];
    if (GROUPS > 2)
        coefficients2 = coefficients[2];
    if (GROUPS > 3)
        coefficients3 = coefficients[3];
}
