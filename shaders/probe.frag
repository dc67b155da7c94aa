#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "distance.glsl"
// The picture's channels in one direction, as in measure.frag, for a pixel of its own and without stars.

layout(location = 0) out vec4 light_and_depth; // Rec. 709 linear; distance in the world from the cube map's event
layout(location = 1) out vec4 camera;          // unit direction in the ship, motion axes; Doppler factor
layout(location = 2) out vec4 world;           // unit direction in the world, the cube map's axes; the source's rest frame, of the
                                               // world's frames

void main()
{
    float pixel_angle;
    vec3 n = look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle);
    Shown shown = shown_along(n, pixel_angle);
    vec3 light = shown.light * view.boost.z;
    light_and_depth = vec4(clamp(light, vec3(-3e38), vec3(3e38)), exact_distance(shown, pixel_angle));
    camera = vec4(n, shown.sight.D);
    world = vec4(shown.sight.n, max(shown.frame, 0.0));
}
