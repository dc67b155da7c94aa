#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "part.glsl"
// One star of the sky in one viewport: its direction in the ship, its pixel, and its light. Stars are points: each goes
// through the forward transform and has no size that could be magnified. A star has one instance, or three where colours
// have directions of their own, one for each colour. It has as many again where a display shows a direction at more than
// one place.

layout(constant_id = 10) const bool METERING_SAMPLES = false; // luminance samples for the exposure: one pixel for each star

layout(set = 0, binding = 6) uniform usampler2DArray inverse_map;
layout(set = 1, binding = 0) uniform Constants { StarConstants turn; };
layout(set = 1, binding = 1) readonly buffer Stars { StarEntry stars[]; };
layout(set = 1, binding = 2) uniform BlackBodies { vec4 black_bodies[STAR_STEPS]; };

layout(location = 0) flat out vec2 centre; // pixels of the target; METERING_SAMPLES: x: the angle of a pixel, radians
layout(location = 1) flat out vec3 light;  // of the whole star, spread over the solid angle of a pixel

// Rec. 709 linear light of a black body, relative to a luminance of 1 at 5772 K.
vec3 black_body(float kelvin)
{
    float at = log2(kelvin / STAR_COLDEST) * STAR_STEPS_PER_OCTAVE;
    if (!(at >= 0.0))
        return vec3(0.0);
    float inside = min(at, float(STAR_STEPS - 1) - 0.001);
    int i = int(inside);
    vec4 entry = mix(black_bodies[i], black_bodies[i + 1], inside - float(i));
    return entry.rgb * exp(entry.w) * exp2((at - inside) / STAR_STEPS_PER_OCTAVE);
}

// The light of a star: a surface too small to have a visible extent. Its radiance changes as any surface's does: a black
// body becomes one at D T, which includes the headlight effect's D^3; and its solid angle shrinks with the sky around it,
// by the square of the growth of angles from the ship to the world.
vec3 starlight(StarEntry star, AberratedRay sight)
{
    float D = sight.D, growth_of_angles = ABERRATION ? growth(sight, sight.n, view.boost.xy) : 1.0;
    vec3 radiance = black_body(DOPPLER ? D * star.direction.w : star.direction.w);
    if (DOPPLER && !HEADLIGHT)
        radiance /= headlight(D);
    if (!DOPPLER && HEADLIGHT)
        radiance *= headlight(D);
    return radiance * (star.light.x / (growth_of_angles * growth_of_angles));
}

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
// method may diverge and restarts from the closest pixel. nearly: true accepts that pixel's own point. Returns false if
// there is no such point.
bool found_from(ivec2 pixel, vec3 n, int channel, bool nearly, out vec2 point, out float pixel_angle)
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
        // As in direction_map.h.
        float longest = max(dot(right, right), dot(down, down));
        pixel_angle = sqrt(max(sqrt(area_square), 0.25 * longest));
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

// The same for any viewport. n: motion axes. second: the second of two places. Where a panorama's ends meet, and beyond
// its poles, a spot that the picture's edge cuts continues elsewhere.
bool find(vec3 n, int channel, bool second, out vec2 point, out float pixel_angle)
{
    vec3 way = vec3(dot(view.row0.xyz, n), dot(view.row1.xyz, n), dot(view.row2.xyz, n));
    if (!MAP) {
        point = way.xy / way.z;
        pixel_angle = view.row0.w * way.z * sqrt(way.z); // n = way.z M (point, 1): the pixel lies 1 / way.z away
        return way.z > 0.0;
    }
    uvec4 begin = texelFetch(inverse_map, ivec3(cell_of(way, textureSize(inverse_map, 0).x), channel), 0);
    if (second && begin[1] == 0xffffffffu)
        return false;
    for (int nearly = 0; nearly < 2; ++nearly)
        for (int i = 0; i < 4 && begin[i] != 0xffffffffu; ++i) {
            if (!found_from(ivec2(begin[i] & 0xffffu, begin[i] >> 16), way, channel, nearly > 0, point, pixel_angle))
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
                if (found_from(from, way, channel, false, point, pixel_angle)
                    && max(abs(point.x - first.x), abs(point.y - first.y)) > 2.0 * STAR_RADIUS)
                    return true;
            }
            return false;
        }
    return false;
}

// True if something hides the sky. A star outside the viewport, whose spot reaches in, may lie beyond the image's edge.
bool hidden(Place place)
{
    vec4 image = texelFetch(tiles, place.entry + 1);
    vec2 texel = clamp(place.texel, image.xy, image.zw);
    return image.z > 0.0 && texelFetch(depth_atlas, ivec2(texel), 0).r > 0.0;
}

void main()
{
    StarEntry star = stars[METERING_SAMPLES ? gl_VertexIndex * int(view.corner.z) : gl_VertexIndex];
    int channel = CHANNELS ? gl_InstanceIndex % 3 : 0;
    bool second = gl_InstanceIndex >= (CHANNELS ? 3 : 1);
    vec3 n = vec3(dot(turn.row0.xyz, star.direction.xyz), dot(turn.row1.xyz, star.direction.xyz),
        dot(turn.row2.xyz, star.direction.xyz));
    AberratedRay sight = AberratedRay(n, 1.0); // as the ship sees it
    if (ABERRATION)
        sight = GALILEAN ? galilean_camera_from_world(n, view.boost.x, view.boost.y) : camera_from_world(n, view.boost.x, view.boost.y);
    else
        sight.D = from_camera(n, view.boost.xy).D;

    gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // outside
    gl_PointSize = 2.0 * STAR_RADIUS;
    centre = vec2(0.0);
    light = vec3(0.0);
    float pixel_angle;
    vec2 size = view.zenith.zw, point;
    if (!find(sight.n, channel, second, point, pixel_angle) || any(lessThan(point, vec2(-STAR_RADIUS)))
        || any(greaterThan(point, size + STAR_RADIUS)))
        return;
    vec3 from_place = in_cube_axes(n, world_rest_frame()); // of the cube map
    if (REPROJECT)
        from_place = reprojected(from_place, eye_offset(sight.n, world_rest_frame()), world_angle(sight, sight.n, pixel_angle), world_rest_frame());
    if (hidden(place_of(from_place, world_rest_frame())))
        return;
    // A moving body hides the star where the body is drawn.
    for (int i = 1; SEVERAL_REST_FRAMES && i < rest_frame_count(); ++i)
        if (dot(part_of(i, sight.n, pixel_angle, 1.0).covers, vec4(1.0)) > 0.5)
            return;
    light = starlight(star, sight) * (view.boost.z / (pixel_angle * pixel_angle));
    if (METERING_SAMPLES) {
        vec2 place = vec2(mod(float(gl_VertexIndex), view.corner.x), floor(float(gl_VertexIndex) / view.corner.x)) + 0.5;
        gl_Position = vec4(place / view.corner.xy * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
        centre = vec2(pixel_angle, 0.0);
        if (LAYERED) // fewer pixels of the picture show this star
            centre.x *= sqrt(part_of(ivec2(clamp(point, vec2(0.0), size - 1.0) + view.origin.xy)));
        return;
    }
    if (CHANNELS)
        light *= vec3(equal(ivec3(0, 1, 2), ivec3(channel)));
    centre = point + view.origin.xy;
    gl_Position = vec4((point + STAR_RADIUS) / (size + 2.0 * STAR_RADIUS) * 2.0 - 1.0, 0.0, 1.0);
}
