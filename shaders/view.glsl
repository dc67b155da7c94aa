// The direction of an output pixel. Planar views are linear in the pixel; every other display has a direction map.

#include "constants.h"

#ifdef FLAT
const bool MAP = false;
#else
MAP_CONSTANTS(DECLARED)
#endif
layout(set = 0, binding = 0) uniform usampler2DArray direction_map; // all 0: shows nothing

// A direction on the octahedron, 24 bits a coordinate, and the upper half of the pixel angle's float: the inverse of
// direction_map.cpp's packed.
vec4 unpacked(uvec2 texel)
{
    vec2 at = vec2(ivec2(texel >> 8) - 0x800000) * (1.0 / float(0x7fffff)); // the integers are floats without rounding
    float z = 1.0 - abs(at.x) - abs(at.y);
    vec2 folded = at - vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0) * max(-z, 0.0);
    vec3 n = vec3(folded, z);
    return vec4(n * inversesqrt(dot(n, n)), uintBitsToFloat((texel.x & 255u) << 16 | (texel.y & 255u) << 24));
}

// The direction in the axes that the rows lead to, as a vector of any length; that length's square; and the angle of a pixel in
// radians: 0 where nothing is shown. channel: 0 except for maps with a direction for each colour.
vec3 look_along(vec4 row0, vec4 row1, vec4 row2, vec2 pixel, int channel, out float square, out float pixel_angle)
{
    vec3 from;
    if (MAP) {
        vec4 texel = unpacked(texelFetch(direction_map, ivec3(pixel, channel), 0).rg);
        from = texel.xyz;
        pixel_angle = texel.w;
    } else {
        from = vec3(pixel, 1.0);
    }
    vec3 v = vec3(dot(row0.xyz, from), dot(row1.xyz, from), dot(row2.xyz, from));
    square = 1.0;
    if (!MAP) {
        // The plane is at distance 1: a pixel's solid angle falls as the cube of the distance to it.
        square = (v.x * v.x + v.y * v.y) + v.z * v.z; // in the order of half_angle_squares, which shares the sum
        float inverse = 1.0 / sqrt(square);
        pixel_angle = row0.w * inverse * sqrt(inverse);
    }
    return v;
}

// The same, as a unit direction.
vec3 look(vec4 row0, vec4 row1, vec4 row2, vec2 pixel, int channel, out float pixel_angle)
{
    float square;
    vec3 v = look_along(row0, row1, row2, pixel, channel, square, pixel_angle);
    return MAP ? v : v * (1.0 / sqrt(square));
}

// A map's direction and pixel angle; all 0 beside it.
vec4 map_at(ivec2 pixel, int channel)
{
    ivec2 last = textureSize(direction_map, 0).xy - 1, inside = clamp(pixel, ivec2(0), last);
    vec4 texel = unpacked(texelFetch(direction_map, ivec3(inside, channel), 0).rg);
    return inside == pixel ? texel : vec4(0.0);
}

// The change of a map's direction from a pixel to the next one; where the map ends, from the one on the other side.
vec3 map_step(vec3 here, vec4 next, vec4 opposite)
{
    return next.w > 0.0 ? next.xyz - here : opposite.w > 0.0 ? here - opposite.xyz : vec3(0.0);
}

// A map around a pixel: its direction and pixel angle, and the changes of the direction to the four pixels next to it.
struct MapAround {
    vec4 here;
    vec3 right, left, down, up;
};

MapAround map_around(vec2 pixel, int channel)
{
    ivec2 at = ivec2(pixel);
    vec4 here = map_at(at, channel), right = map_at(at + ivec2(1, 0), channel), left = map_at(at - ivec2(1, 0), channel),
         down = map_at(at + ivec2(0, 1), channel), up = map_at(at - ivec2(0, 1), channel);
    return MapAround(here, map_step(here.xyz, right, left), map_step(here.xyz, left, right), map_step(here.xyz, down, up),
        map_step(here.xyz, up, down));
}

// The same as look_along, at an offset from the centre of the map's pixel, of at most half a pixel. The map's directions are
// linear to its neighbours.
vec3 look_within(vec4 row0, vec4 row1, vec4 row2, MapAround map, vec2 offset, out float square)
{
    vec3 from = map.here.xyz + abs(offset.x) * (offset.x < 0.0 ? map.left : map.right)
        + abs(offset.y) * (offset.y < 0.0 ? map.up : map.down);
    vec3 v = vec3(dot(row0.xyz, from), dot(row1.xyz, from), dot(row2.xyz, from));
    square = dot(v, v);
    return v;
}
