#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// A star's spot: round, and the same at any speed. It is so wide that the sum over its pixels does not depend on its
// centre's place between pixels, within 0.5 %: no star twinkles as it drifts.

layout(constant_id = 9) const bool HALVES = false; // the picture has 16 bits a number

layout(location = 0) flat in vec2 centre;
layout(location = 1) flat in vec3 light;
layout(location = 0) out vec4 shown;

void main()
{
    vec2 off = (gl_FragCoord.xy - centre) / STAR_RADIUS;
    float inside = max(1.0 - dot(off, off), 0.0);
    inside *= inside;
    shown = vec4(light * (inside * inside / STAR_SPOT), 1.0);
    if (HALVES) // must stay finite where bright stars meet; that light is white
        shown.rgb = clamp(shown.rgb, vec3(-16000.0), vec3(16000.0));
}
