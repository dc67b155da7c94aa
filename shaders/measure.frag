#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "view.glsl"
#include "seen.glsl"
// The relativistic transform of one output pixel, as numbers: the same light as warp.frag's before exposure.

layout(set = 0, binding = 4) uniform sampler2D depth_atlas; // near / distance along the face's normal, 0 at infinity

layout(location = 0) out vec4 light_and_depth; // Rec. 709 linear; distance in the world from the eye's event
layout(location = 1) out vec4 camera;          // unit direction in the ship, motion axes; Doppler factor
layout(location = 2) out vec4 world;           // unit direction in the world, motion axes; 1 where something is shown

void main()
{
    float pixel_angle;
    vec3 n = look(pixel_angle);
    float nothing = intBitsToFloat(0x7fc00000);
    light_and_depth = camera = world = vec4(nothing);
    if (MAP && pixel_angle == 0.0)
        return;
    Sight sight = world_from_camera(n, view.boost.x, view.boost.y);
    vec3 n_world = ABERRATION ? sight.n : n;
    Place place = place_of(n_world);
    float depth = texelFetch(depth_atlas, ivec2(place.atlas * view.origin.zw), 0).r;
    float reach = view.boost.w * sqrt(1.0 + dot(place.face, place.face));
    light_and_depth = vec4(light_seen(place, sight.D, pixel_angle) * view.boost.z, depth > 0.0 ? reach / depth : intBitsToFloat(0x7f800000));
    camera = vec4(n, sight.D);
    world = vec4(n_world, 1.0);
}
