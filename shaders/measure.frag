#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "distance.glsl"
// The relativistic transform of one output pixel as channels: warp.frag's light before exposure. Where colours have
// directions of their own, green's are written.

layout(location = 0) out vec4 light_and_depth; // Rec. 709 linear; distance in the world from the cube map's event
layout(location = 1) out vec4 camera;          // unit direction in the ship, motion axes; Doppler factor, of the nearest
                                               // source where things move
layout(location = 2) out vec4 world;           // unit direction in the world, the cube map's axes; 1 where something is
                                               // shown

void main()
{
    float nothing = intBitsToFloat(0x7fc00000);
    light_and_depth = camera = world = vec4(nothing);
    vec2 pixel = gl_FragCoord.xy - view.origin.xy;
    vec3 light = vec3(0.0);
    bool any = false;
    for (int channel = 0; channel < (CHANNELS ? 3 : 1); ++channel) {
        float pixel_angle;
        Shown shown = shown_at(pixel, channel, 1.0, pixel_angle);
        if (MAP && pixel_angle == 0.0)
            continue;
        float same_angle;
        vec3 seen = RAYS == 1 ? shown.light : light_at(pixel, channel, 0.0, same_angle);
        seen *= view.boost.z;
        if (STARS)
            seen += texelFetch(stars_picture, ivec2(gl_FragCoord.xy), 0).rgb;
        if (CHANNELS)
            light[channel] = seen[channel];
        else
            light = seen;
        if (channel != (CHANNELS ? 1 : 0))
            continue;
        light_and_depth.w = exact_distance(shown, pixel_angle);
        camera = vec4(shown.n, shown.sight.D);
        world = vec4(shown.sight.n, 1.0);
        any = true;
    }
    if (any)
        light_and_depth.rgb = clamp(light, vec3(-3e38), vec3(3e38)); // a number, whatever D^3 does
}
