#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "tone.glsl"
#include "dither.glsl"
// The relativistic transform of one output pixel, as shown.

layout(constant_id = 9) const bool LINEAR = false;  // light for the glow, before the tone curve; alpha 0: shows nothing
layout(constant_id = 10) const bool DITHERED = true; // the target has 8 bits

layout(location = 0) out vec4 shown;

vec3 light_along(int channel)
{
    float pixel_angle;
    vec3 light = light_at(gl_FragCoord.xy - view.origin.xy, channel, pixel_angle);
    if (MAP && pixel_angle == 0.0)
        return vec3(0.0);
    return STARS ? light + texelFetch(stars_picture, ivec2(gl_FragCoord.xy - view.origin.xy + view.corner.xy), 0).rgb : light;
}

void main()
{
    vec3 light = CHANNELS ? vec3(light_along(0).r, light_along(1).g, light_along(2).b) : light_along(0);
    // Infinite D^3 is clamped to a number: the greatest light is already white.
    light = clamp(light * view.boost.z, vec3(0.0), vec3(1e30));
    if (LINEAR) {
        float pixel_angle;
        look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle);
        shown = vec4(min(light, vec3(60000.0)), MAP && pixel_angle == 0.0 ? 0.0 : 1.0); // fp16's greatest, nearly
        return;
    }
    vec3 screen = tone_map(light);
    shown = vec4(DITHERED ? dithered_srgb(screen, ivec2(gl_FragCoord.xy)) : screen, 1.0);
}
