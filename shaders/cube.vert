#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
// Draws a rest frame around its eye event, in the cube map's axes, into one image of the plan, or directly into a plain picture.

CORNER_CONSTANTS(DECLARED)
POSE_CONSTANTS(DECLARED)
TOPOLOGY_CONSTANTS(DECLARED)

layout(set = 0, binding = 0) uniform Constants { CubeConstants cube; };
layout(set = 0, binding = 1) readonly buffer Instances { InstanceEntry instances[]; };
layout(set = 0, binding = 2) readonly buffer Visible { uint visible[]; };
layout(set = 0, binding = 4) readonly buffer Times { TimeEntry times[]; };
layout(set = 0, binding = 7) readonly buffer Deforming { vec4 deforming[]; }; // World::deforming
layout(set = 0, binding = 8) readonly buffer Draws { DrawEntry draws[]; };
layout(set = 0, binding = 9) readonly buffer Surfaces { SurfaceEntry surfaces[]; };
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
layout(location = 4) flat out uvec3 out_draw; // instance, and the members of DrawEntry
layout(location = 7) flat out vec4 out_emissive; // SurfaceEntry's members
layout(location = 8) flat out vec4 out_beyond;
layout(location = 9) flat out vec4 out_plain_colour;

#include "light_travel_offset.glsl"

// A vertex in its own coordinates, and its transform to the cube map's axes.
struct Surface {
    InstanceEntry at;
    vec3 position, normal, tangent;
};

vec4 placed(Surface surface)
{
    vec4 local = vec4(surface.position, 1.0);
    return vec4(dot(surface.at.row0, local), dot(surface.at.row1, local), dot(surface.at.row2, local), 1.0);
}

// Adds a part of an entry of two neighbouring poses.
void add_pose(inout InstanceEntry sum, float weight, int before, int step, float part)
{
    sum.row0 += weight * mix(instances[before].row0, instances[before + step].row0, part);
    sum.row1 += weight * mix(instances[before].row1, instances[before + step].row1, part);
    sum.row2 += weight * mix(instances[before].row2, instances[before + step].row2, part);
}

const InstanceEntry nothing = InstanceEntry(vec4(0.0), vec4(0.0), vec4(0.0));

// A deforming surface between two neighbouring poses (glTF 2.0, sections 3.7.2.2 and 3.7.3).
Surface deformed(TimeEntry time, int before, float part)
{
    int entries = int(time.deforming.x), targets = int(time.deforming.y);
    int row = floatBitsToInt(time.deforming.z) + DEFORMING_VERTEX_ROWS * gl_VertexIndex;
    int displacement = floatBitsToInt(time.deforming.w) + DISPLACEMENT_ROWS * targets * gl_VertexIndex;
    Surface surface = Surface(nothing, deforming[row].xyz, deforming[row + 1].xyz, deforming[row + 2].xyz);
    for (int k = 0; k < BONES_PER_VERTEX; ++k) {
        float weight = deforming[row + WEIGHTS_ROW + k / 4][k % 4];
        if (weight > 0.0)
            add_pose(surface.at, weight, before + int(deforming[row + BONES_ROW + k / 4][k % 4]), entries, part);
    }
    int first_weights = before + entries - (targets + WEIGHTS_PER_ENTRY - 1) / WEIGHTS_PER_ENTRY;
    InstanceEntry own = nothing;
    for (int target = 0; target < targets; ++target) {
        int within = target % WEIGHTS_PER_ENTRY;
        if (within == 0) {
            own = nothing;
            add_pose(own, 1.0, first_weights + target / WEIGHTS_PER_ENTRY, entries, part);
        }
        vec4 four = within < 4 ? own.row0 : within < 8 ? own.row1 : own.row2;
        surface.position += four[within % 4] * deforming[displacement + DISPLACEMENT_ROWS * target].xyz;
        surface.normal += four[within % 4] * deforming[displacement + DISPLACEMENT_ROWS * target + 1].xyz;
    }
    return surface;
}

// Finds the surface at this point's retarded time: a fixed point whose error shrinks fivefold in each round.
Surface as_seen(Surface surface, TimeEntry time)
{
    int first = int(cube.first.z) + int(time.poses.x), entries = DEFORMS ? int(time.deforming.x) : 1;
    if (DEFORMS)
        surface = deformed(time, first + POSES / 2 * entries, 0.0);
    for (int round_ = 0; round_ < 6; ++round_) {
        float after = travel_offset_from(placed(surface).xyz, time.middle) - time.poses.w;
        float steps = float(POSES / 2) + after * (after < 0.0 ? time.poses.y : time.poses.z);
        steps = clamp(steps, 0.0, float(POSES) - 1.001);
        int before = first + int(steps) * entries;
        if (DEFORMS) {
            surface = deformed(time, before, fract(steps));
        } else {
            surface.at = nothing;
            add_pose(surface.at, 1.0, before, 1, fract(steps));
        }
    }
    return surface;
}

void main()
{
#ifdef MAPPED
    Surface surface = Surface(instances[visible[gl_InstanceIndex]], position, normal, tangent.xyz);
#else
    Surface surface = Surface(instances[visible[gl_InstanceIndex]], position, normal, vec3(0.0));
#endif
    if (MOVES)
        surface = as_seen(surface, times[visible[gl_InstanceIndex] - uint(cube.first.x) + uint(cube.first.y)]);
    InstanceEntry at = surface.at;
    vec3 x = vec3(at.row0.x, at.row1.x, at.row2.x);
    vec3 y = vec3(at.row0.y, at.row1.y, at.row2.y);
    vec3 z = vec3(at.row0.z, at.row1.z, at.row2.z);
    vec4 place = placed(surface);
    // Cofactors transform normals under any scale; their sign is the determinant's.
    vec3 yz = cross(y, z);
    vec3 n = surface.normal;
    out_normal = (yz * n.x + cross(z, x) * n.y + cross(x, y) * n.z) * sign(dot(x, yz));
#ifdef MAPPED
    vec3 t = surface.tangent;
    out_tangent = vec4(x * t.x + y * t.y + z * t.z, tangent.w * sign(dot(x, yz)));
    out_uvs = uvs;
#endif
    out_place = place.xyz;
    out_uv = uv;
    DrawEntry entry = draws[int(push.surface.y) + gl_DrawID];
    out_draw = uvec3(visible[gl_InstanceIndex], entry.material, floatBitsToUint(entry.apart));
    out_plain_colour = surfaces[entry.material].base_colour;
    out_colour = colour * out_plain_colour;
    out_emissive = surfaces[entry.material].emissive;
    out_beyond = surfaces[entry.material].beyond;
    gl_Position = vec4(dot(push.clip_x, place), dot(push.clip_y, place), push.surface.x, dot(push.clip_w, place));
    gl_PointSize = 1.0; // always: Mesa 22.3's driver for AMD's cards crashes where a size that no point has is left out
    if (TOPOLOGY == 2) { // points
        // A pixel's angle grows by D from the ship to this frame; on the face it grows with the distance from its middle.
        vec3 n = normalize(place.xyz);
        float middle = gl_Position.w * inversesqrt(dot(place.xyz, place.xyz));
        float size = push.surface.z * (cube.growth[0].w + dot(cube.growth[0].xyz, n)) * pow(max(middle, 0.1), -1.5);
        gl_PointSize = clamp(size, 1.0, 64.0);
    }
}
