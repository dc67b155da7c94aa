#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "view.glsl"
#include "seen.glsl"
#include "tone.glsl"
// The relativistic transform of one output pixel, shown.

layout(location = 0) out vec4 shown;

void main()
{
    float pixel_angle;
    vec3 n = look(pixel_angle);
    vec3 light = vec3(0.0);
    if (!MAP || pixel_angle > 0.0) {
        Sight sight = world_from_camera(n, view.boost.x, view.boost.y);
        light = light_seen(place_of(ABERRATION ? sight.n : n), sight.D, pixel_angle);
    }
    // Both infinities of D^3 stay numbers: the greatest light is already white.
    shown = vec4(tone_map(min(light * view.boost.z, vec3(1e30))), 1.0);
}
