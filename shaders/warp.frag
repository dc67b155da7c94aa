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

void main()
{
    vec2 pixel = gl_FragCoord.xy - view.origin.xy;
    vec3 light = vec3(0.0);
    bool shows = false;
    for (int channel = 0; channel < (CHANNELS ? 3 : 1); ++channel) { // one call of light_at, as there
        float pixel_angle;
        vec3 own = light_at(pixel, channel, pixel_angle);
        bool there = !MAP || pixel_angle > 0.0;
        if (STARS && there)
            own += texelFetch(stars_picture, ivec2(pixel + view.corner.xy), 0).rgb;
        light = CHANNELS ? mix(light, own, equal(ivec3(channel), ivec3(0, 1, 2))) : own;
        shows = channel == 0 ? there : shows;
    }
    // Infinite D^3 is clamped to a number: the greatest light is already white.
    light = clamp(light * view.boost.z, vec3(0.0), vec3(1e30));
    if (LINEAR) {
        shown = vec4(min(light, vec3(60000.0)), shows ? 1.0 : 0.0); // fp16's greatest, nearly
        return;
    }
    vec3 screen = tone_map(light);
    shown = vec4(DITHERED ? dithered_srgb(screen, ivec2(gl_FragCoord.xy)) : screen, 1.0);
}
