#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "physics/glare.glsl"
// A star's spot: round, and the same at any speed. It is so wide that the sum over its pixels does not depend on its
// centre's place between pixels, within 0.5 %: no star twinkles as it drifts. What the glare around it holds, it lacks.

RANGE_CONSTANTS(DECLARED) // w: luminance before the curve
STAR_CONSTANTS(DECLARED)

layout(location = 0) flat in vec3 centre; // z: solid angle of a pixel
layout(location = 1) flat in vec3 light;
layout(location = 2) flat in vec4 glare;
layout(location = 0) out vec4 shown;

void main()
{
    vec2 off = gl_FragCoord.xy - centre.xy;
    float square = dot(off, off), inside = max(1.0 - square / (STAR_RADIUS * STAR_RADIUS), 0.0);
    inside *= inside;
    float part = inside * inside / STAR_SPOT * glare.w;
    if (!RANGE && glare.y > 0.0)
        part += max(glare_at(square * glare.x * glare.x + glare.y) - glare.z, 0.0) * centre.z;
    shown = vec4(light * part, RANGE ? glare.y * part : 1.0);
    if (HALVES) // must stay finite where bright stars meet; that light is white
        shown.rgb = clamp(shown.rgb, vec3(-16000.0), vec3(16000.0));
    if (HALVES && RANGE)
        shown.a = 16000.0 * part; // luminances before the curve have too many stops for 16 bits
}
