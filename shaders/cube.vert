#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
// Draws a rest frame around its eye event, in the cube map's axes, into one image of the plan, or directly into a plain picture.

layout(constant_id = 9) const bool CLOCK = false;
layout(constant_id = 10) const bool FINITE_EXISTENCE = false;
layout(constant_id = 13) const bool BLINK = false;
layout(constant_id = 14) const bool MOVES = false; // animated

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 0, binding = 1) readonly buffer Instances { InstanceEntry instances[]; };
layout(set = 0, binding = 2) readonly buffer Visible { uint visible[]; };
layout(set = 0, binding = 4) readonly buffer Times { TimeEntry times[]; };
layout(push_constant) uniform Push { CubePush push; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;

#ifdef MAPPED
layout(location = 4) in vec4 tangent; // w: the bitangent's sense
layout(location = 5) in vec4 uvs; // two of the file's sets
layout(location = 5) out vec4 out_uvs;
layout(location = 6) out vec4 out_tangent;
#endif

layout(location = 0) out vec3 out_place;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec4 out_colour;
layout(location = 4) flat out uint out_instance;

#include "light_travel_offset.glsl"

vec4 placed(InstanceEntry at)
{
    vec4 local = vec4(position, 1.0);
    return vec4(dot(at.row0, local), dot(at.row1, local), dot(at.row2, local), 1.0);
}

// Finds the instance's pose at this point's retarded time: a fixed point whose error shrinks fivefold in each round.
InstanceEntry as_seen(InstanceEntry at, TimeEntry time)
{
    int first = int(cube.first.z) + int(time.poses.x);
    for (int round_ = 0; round_ < 6; ++round_) {
        float after = travel_offset_from(placed(at).xyz, time.middle) - time.poses.w;
        float steps = float(POSES / 2) + after * (after < 0.0 ? time.poses.y : time.poses.z);
        steps = clamp(steps, 0.0, float(POSES) - 1.001);
        int k = first + int(steps);
        float part = fract(steps);
        at.row0 = mix(instances[k].row0, instances[k + 1].row0, part);
        at.row1 = mix(instances[k].row1, instances[k + 1].row1, part);
        at.row2 = mix(instances[k].row2, instances[k + 1].row2, part);
    }
    return at;
}

void main()
{
    InstanceEntry instance = instances[visible[gl_InstanceIndex]];
    if (MOVES)
        instance = as_seen(instance, times[visible[gl_InstanceIndex] - uint(cube.first.x) + uint(cube.first.y)]);
    vec3 x = vec3(instance.row0.x, instance.row1.x, instance.row2.x);
    vec3 y = vec3(instance.row0.y, instance.row1.y, instance.row2.y);
    vec3 z = vec3(instance.row0.z, instance.row1.z, instance.row2.z);
    vec4 place = placed(instance);
    // Cofactors transform normals under any scale; their sign is the determinant's.
    vec3 yz = cross(y, z);
    out_normal = (yz * normal.x + cross(z, x) * normal.y + cross(x, y) * normal.z) * sign(dot(x, yz));
#ifdef MAPPED
    out_tangent = vec4(x * tangent.x + y * tangent.y + z * tangent.z, tangent.w * sign(dot(x, yz)));
    out_uvs = uvs;
#endif
    out_place = place.xyz;
    out_uv = uv;
    out_colour = colour * push.base_colour;
    if (CLOCK || FINITE_EXISTENCE || BLINK)
        out_instance = visible[gl_InstanceIndex];
    gl_Position = vec4(dot(push.clip_row0, place), dot(push.clip_row1, place), dot(push.clip_row2, place), dot(push.clip_row3, place));
}
