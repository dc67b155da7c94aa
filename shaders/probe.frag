#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "view.glsl"
#include "seen.glsl"
#include "distance.glsl"
// What the picture shows in one direction, as numbers: measure.frag's, for a pixel of its own and without stars.

layout(location = 0) out vec4 light_and_depth; // Rec. 709 linear; distance in the world from the cube map's event
layout(location = 1) out vec4 camera;          // unit direction in the ship, motion axes; Doppler factor
layout(location = 2) out vec4 world;           // unit direction in the world, motion axes

void main()
{
    float pixel_angle;
    vec3 n = look(view.row0, view.row1, view.row2, gl_FragCoord.xy - view.origin.xy, 0, pixel_angle);
    Sight sight = sight_of(n, pixel_angle);
    Place place = place_of(sight.n);
    vec3 light = light_seen(place, sight.D, pixel_angle) * view.boost.z;
    light_and_depth = vec4(clamp(light, vec3(-3e38), vec3(3e38)), smooth_distance_at(place));
    camera = vec4(n, sight.D);
    world = vec4(sight.n, 1.0);
}
