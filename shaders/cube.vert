#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// What stands still around the eye, in motion axes: into one image of the plan, or straight to a plain picture.

layout(constant_id = 9) const bool CLOCK = false;
layout(constant_id = 10) const bool MORTAL = false;

layout(set = 0, binding = 1) readonly buffer Instances { InstanceEntry instances[]; };
layout(set = 0, binding = 2) readonly buffer Visible { uint visible[]; };
layout(push_constant) uniform Push { CubePush push; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;

layout(location = 0) out vec3 out_place;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec4 out_colour;
layout(location = 4) flat out uint out_instance;

void main()
{
    InstanceEntry instance = instances[visible[gl_InstanceIndex]];
    vec3 x = vec3(instance.row0.x, instance.row1.x, instance.row2.x);
    vec3 y = vec3(instance.row0.y, instance.row1.y, instance.row2.y);
    vec3 z = vec3(instance.row0.z, instance.row1.z, instance.row2.z);
    vec4 local = vec4(position, 1.0);
    vec4 place = vec4(dot(instance.row0, local), dot(instance.row1, local), dot(instance.row2, local), 1.0);
    // Cofactors carry normals under any scale; their sign is the determinant's.
    vec3 yz = cross(y, z);
    out_normal = (yz * normal.x + cross(z, x) * normal.y + cross(x, y) * normal.z) * sign(dot(x, yz));
    out_place = place.xyz;
    out_uv = uv;
    out_colour = colour * push.base_colour;
    if (CLOCK || MORTAL)
        out_instance = visible[gl_InstanceIndex];
    gl_Position = vec4(dot(push.clip_row0, place), dot(push.clip_row1, place), dot(push.clip_row2, place), dot(push.clip_row3, place));
}
