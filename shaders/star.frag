#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A star's spot: round, and the same at any speed. It is so wide that the sum over its pixels does not depend on its
// centre's place between pixels, within 0.5 %: no star twinkles as it drifts.

layout(location = 0) flat in vec2 centre;
layout(location = 1) flat in vec3 light;
layout(location = 0) out vec4 shown;

void main()
{
    vec2 off = (gl_FragCoord.xy - centre) / STAR_RADIUS;
    float inside = max(1.0 - dot(off, off), 0.0);
    inside *= inside;
    shown = vec4(light * (inside * inside / STAR_SPOT), 1.0);
}
