// Which way the output pixel looks. Planar views are linear in the pixel; every other display is a map of directions.

layout(constant_id = 0) const bool MAP = false;
layout(set = 0, binding = 0) uniform sampler2D direction_map; // xyz: unit direction, w: pixel angle; all 0: shows nothing
layout(push_constant) uniform Push { ViewPush view; };

// Unit direction in the axes that the push constants lead to, and the angle of a pixel in radians: 0 where nothing is shown.
vec3 look(out float pixel_angle)
{
    vec2 pixel = gl_FragCoord.xy - view.origin.xy;
    vec3 from;
    if (MAP) {
        vec4 texel = texelFetch(direction_map, ivec2(pixel), 0);
        from = texel.xyz;
        pixel_angle = texel.w;
    } else {
        from = vec3(pixel, 1.0);
    }
    vec3 n = vec3(dot(view.row0.xyz, from), dot(view.row1.xyz, from), dot(view.row2.xyz, from));
    if (!MAP) {
        // The plane stands at distance 1: a pixel's solid angle falls as the cube of the distance to it.
        float inverse = 1.0 / sqrt(dot(n, n));
        n *= inverse;
        pixel_angle = view.row0.w * inverse * sqrt(inverse);
    }
    return n;
}
