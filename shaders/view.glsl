// Which way the output pixel looks. Planar views are linear in the pixel; every other display is a map of directions.

layout(constant_id = 0) const bool MAP = false;
layout(set = 0, binding = 0) uniform sampler2DArray direction_map; // xyz: unit direction, w: pixel angle; all 0: shows nothing

// Unit direction in the axes that the rows lead to, and the angle of a pixel in radians: 0 where nothing is shown. channel:
// 0 but for maps whose colours look different ways.
vec3 look(vec4 row0, vec4 row1, vec4 row2, vec2 pixel, int channel, out float pixel_angle)
{
    vec3 from;
    if (MAP) {
        vec4 texel = texelFetch(direction_map, ivec3(pixel, channel), 0);
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
