// Which way the output pixel looks. Planar views are linear in the pixel; every other display is a map of directions.

layout(constant_id = 0) const bool MAP = false;
layout(set = 0, binding = 0) uniform usampler2DArray direction_map; // all 0: shows nothing

// A direction on the octahedron, 24 bits a coordinate, and the upper half of the pixel angle's float: direction_map.cpp's
// packed, undone.
vec4 unpacked(uvec2 texel)
{
    vec2 at = vec2(ivec2(texel >> 8) - 0x800000) * (1.0 / float(0x7fffff)); // the integers are floats without rounding
    float z = 1.0 - abs(at.x) - abs(at.y);
    vec2 folded = at - vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0) * max(-z, 0.0);
    vec3 n = vec3(folded, z);
    return vec4(n * inversesqrt(dot(n, n)), uintBitsToFloat((texel.x & 255u) << 16 | (texel.y & 255u) << 24));
}

// Unit direction in the axes that the rows lead to, and the angle of a pixel in radians: 0 where nothing is shown. channel:
// 0 but for maps whose colours look different ways.
vec3 look(vec4 row0, vec4 row1, vec4 row2, vec2 pixel, int channel, out float pixel_angle)
{
    vec3 from;
    if (MAP) {
        vec4 texel = unpacked(texelFetch(direction_map, ivec3(pixel, channel), 0).rg);
        from = texel.xyz;
        pixel_angle = texel.w;
    } else {
        from = vec3(pixel, 1.0);
    }
    vec3 n = vec3(dot(row0.xyz, from), dot(row1.xyz, from), dot(row2.xyz, from));
    if (!MAP) {
        // The plane stands at distance 1: a pixel's solid angle falls as the cube of the distance to it.
        float inverse = 1.0 / sqrt(dot(n, n));
        n *= inverse;
        pixel_angle = row0.w * inverse * sqrt(inverse);
    }
    return n;
}
