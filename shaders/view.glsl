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

// The change of a map's direction to the next pixel along `way`; where the map ends, the change in the opposite direction.
vec3 map_step(vec3 here, ivec2 pixel, ivec2 way, int channel)
{
    ivec2 size = textureSize(direction_map, 0).xy;
    for (int side = 1; side >= -1; side -= 2) {
        ivec2 at = pixel + side * way;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
            continue;
        vec4 there = unpacked(texelFetch(direction_map, ivec3(at, channel), 0).rg);
        if (there.w > 0.0)
            return (there.xyz - here) * float(side);
    }
    return vec3(0.0);
}

// The same as look_along, at an offset from the pixel's centre of at most half a pixel. A map's directions are linear to its
// neighbours.
vec3 look_within(vec4 row0, vec4 row1, vec4 row2, vec2 pixel, vec2 offset, int channel, out float square, out float pixel_angle)
{
    if (!MAP)
        return look_along(row0, row1, row2, pixel + offset, channel, square, pixel_angle);
    vec4 here = unpacked(texelFetch(direction_map, ivec3(pixel, channel), 0).rg);
    pixel_angle = here.w;
    vec3 from = here.xyz + abs(offset.x) * map_step(here.xyz, ivec2(pixel), ivec2(sign(offset.x), 0), channel)
        + abs(offset.y) * map_step(here.xyz, ivec2(pixel), ivec2(0, sign(offset.y)), channel);
    vec3 v = vec3(dot(row0.xyz, from), dot(row1.xyz, from), dot(row2.xyz, from));
    square = dot(v, v);
    return v;
}
