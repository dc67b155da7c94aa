// The place in a direction map that shows a star. Needs star.vert's inverse_map. A build with FLAT is for planar views.

#ifdef FLAT
bool find_in_map(vec3 way, int channel, bool second, out vec2 point, out vec2 angles)
{
    point = vec2(0.0);
    angles = vec2(0.0);
    return false;
}
#else

// inverse_map.cpp's cell_of.
ivec2 cell_of(vec3 n, int side)
{
    vec2 at = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        at = vec2(at.x >= 0.0 ? 1.0 : -1.0, at.y >= 0.0 ? 1.0 : -1.0) * (1.0 - abs(at.yx));
    return clamp(ivec2((at * 0.5 + 0.5) * float(side)), ivec2(0), ivec2(side - 1));
}

vec4 texel_at(ivec2 pixel, int channel) { return unpacked(texelFetch(direction_map, ivec3(pixel, channel), 0).rg); }

// The change of direction from a pixel to its neighbour; 0 where the neighbour shows nothing.
vec3 change_to(vec4 here, ivec2 pixel, ivec2 way, ivec2 size, int channel)
{
    ivec2 beside = pixel + way;
    if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, size)))
        return vec3(0.0);
    vec4 there = texel_at(beside, channel);
    return there.w > 0.0 ? there.xyz - here.xyz : vec3(0.0);
}

// The change of direction at a pixel: the mean of both sides, or one side where the picture ends or has a seam.
vec3 change_about(vec4 here, ivec2 pixel, ivec2 way, ivec2 size, int channel)
{
    vec3 on = change_to(here, pixel, way, size, channel), back = -change_to(here, pixel, -way, size, channel);
    float on_square = dot(on, on), back_square = dot(back, back);
    if (min(on_square, back_square) * 4.0 > max(on_square, back_square))
        return 0.5 * (on + back);
    return back_square == 0.0 || (on_square > 0.0 && on_square < back_square) ? on : back;
}

// Searches from one pixel in strides that are halved repeatedly, and returns the visited pixel whose direction is closest
// to n.
ivec2 closest_to(vec3 n, ivec2 pixel, ivec2 size, int channel)
{
    vec3 off = n - texel_at(pixel, channel).xyz;
    float least = dot(off, off);
    const ivec2 ways[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    for (int stride = max(size.x, size.y) / 2; stride > 0; stride /= 2)
        for (int i = 0; i < 8; ++i) {
            ivec2 at = pixel + stride * ways[i & 3];
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec4 there = texel_at(at, channel);
            off = n - there.xyz;
            if (there.w > 0.0 && dot(off, off) < least)
                least = dot(off, off), pixel = at;
        }
    return pixel;
}

// The point of the map (pixels from its corner) that shows n (the map's axes), by Newton's method from a pixel near it; a
// spot beyond the picture's edge is extrapolated. Around a panorama's poles, a few pixels cover all azimuths: there the
// method may diverge and restarts from the closest pixel. nearly: true accepts that pixel's own point. angles: the pixel angle
// there, and the root of the solid angle. Returns false if there is no such point.
bool found_from(ivec2 pixel, vec3 n, int channel, bool nearly, out vec2 point, out vec2 angles)
{
    ivec2 size = textureSize(direction_map, 0).xy;
    bool astray = false;
    for (int round = 0; round < 10; ++round) {
        vec4 here = texel_at(pixel, channel);
        vec3 right = change_about(here, pixel, ivec2(1, 0), size, channel);
        vec3 down = change_about(here, pixel, ivec2(0, 1), size, channel);
        vec3 across = cross(right, down), off = n - here.xyz;
        float area_square = dot(across, across);
        if (area_square == 0.0 || dot(n, here.xyz) <= 0.0)
            return false;
        vec2 move = vec2(dot(cross(off, down), across), dot(cross(right, off), across)) / area_square;
        point = vec2(pixel) + 0.5 + move;
        // The pixel angle is defined in direction_map.h. The solid angle is the mean over the star's spot, which reaches over
        // a panorama's pole, where a pixel's own is 0.
        float longest = max(dot(right, right), dot(down, down)), across_pole = STAR_BEYOND_POLE * longest * sqrt(longest);
        angles.x = sqrt(max(sqrt(area_square), 0.25 * longest));
        angles.y = sqrt(sqrt(area_square + across_pole * across_pole));
        float far = max(abs(move.x), abs(move.y));
        if (far <= 0.75)
            return true;
        ivec2 next = clamp(ivec2(floor(point)), ivec2(0), size - 1);
        if (next == pixel || texel_at(next, channel).w == 0.0) {
            if (far < STAR_RADIUS + 1.0)
                return true;
        } else if (round < 7) {
            pixel = next;
            continue;
        }
        if (astray || dot(off, off) > 16.0 * longest) {
            point = vec2(pixel) + 0.5 + clamp(move, -0.75, 0.75);
            return nearly && dot(off, off) < longest;
        }
        astray = true;
        pixel = closest_to(n, pixel, size, channel);
    }
    return false;
}

// star.vert's find. way: the map's axes.
bool find_in_map(vec3 way, int channel, bool second, out vec2 point, out vec2 angles)
{
    uvec4 begin = texelFetch(inverse_map, ivec3(cell_of(way, textureSize(inverse_map, 0).x), channel), 0);
    if (second && begin[1] == 0xffffffffu)
        return false;
    for (int nearly = 0; nearly < 2; ++nearly)
        for (int i = 0; i < 4 && begin[i] != 0xffffffffu; ++i) {
            if (!found_from(ivec2(begin[i] & 0xffffu, begin[i] >> 16), way, channel, nearly > 0, point, angles))
                continue;
            if (!second)
                return true;
            ivec2 size = textureSize(direction_map, 0).xy, pixel = clamp(ivec2(point), ivec2(0), size - 1);
            vec2 first = point;
            // Beyond a pole the other half of the picture continues; beyond the rim of a whole sphere in a circle, the
            // opposite point.
            for (int k = -2; k < 4; ++k) {
                if (k >= 0 && (k <= i || begin[k] == 0xffffffffu))
                    continue;
                ivec2 from = k == -2 ? ivec2((pixel.x + size.x / 2) % size.x, pixel.y)
                    : k == -1        ? size - 1 - pixel
                                     : ivec2(begin[k] & 0xffffu, begin[k] >> 16);
                if (found_from(from, way, channel, false, point, angles)
                    && max(abs(point.x - first.x), abs(point.y - first.y)) > 2.0 * STAR_RADIUS)
                    return true;
            }
            return false;
        }
    return false;
}
#endif
