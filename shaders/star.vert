#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "constants.h"
#include "physics/real.glsl"
#include "physics/aberration.glsl"
#include "physics/galilean.glsl"
#include "view.glsl"
#include "received_light.glsl"
#include "part.glsl"
#include "tone.glsl"
#include "range.glsl"
// One star of the sky in one viewport: its direction in the ship, its pixel, and its light. Stars are points: each goes
// through the forward transform and has no size that could be magnified. A star has one instance, or three where colours
// have directions of their own, one for each colour. It has as many again where a display shows a direction at more than
// one place.

STAR_METER_CONSTANTS(DECLARED)

layout(set = 0, binding = 6) uniform usampler2DArray inverse_map;
layout(set = 1, binding = 0) uniform Constants { StarConstants turn; };
layout(set = 1, binding = 1) readonly buffer Stars { StarEntry stars[]; };
layout(set = 1, binding = 2) uniform BlackBodies { vec4 black_bodies[STAR_STEPS]; };

layout(location = 0) flat out vec3 centre; // pixels of the target; z: the solid angle of a pixel. METERING_SAMPLES: x: its root
layout(location = 1) flat out vec3 light;  // of the whole star, spread over the solid angle of a pixel
layout(location = 2) flat out vec4 glare;  // x: degrees of a pixel; y: square of the least angle, 0: none; z: level of its end;
                                           // w: the part of the light in the spot: neither glare nor shown as a disc
                                           // RANGE, without glare: y: luminance before the curve

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
#ifdef WITH_GLOBES
    if (star.direction.w < 0.0) {
        vec3 mean = globe_colour(shift_column(D), globe(int(-1.0 - star.direction.w)).map.w, 0.0);
        return mean * ((HEADLIGHT ? headlight(D) : 1.0) * star.light.x / (growth_of_angles * growth_of_angles));
    }
#endif
    vec3 radiance = black_body(DOPPLER ? D * star.direction.w : star.direction.w);
    if (DOPPLER && !HEADLIGHT)
        radiance /= headlight(D);
    if (!DOPPLER && HEADLIGHT)
        radiance *= headlight(D);
    return radiance * (star.light.x / (growth_of_angles * growth_of_angles));
}

#include "find_in_map.glsl"
#include "physics/glare.glsl"

// True if the picture shows what lies `radius` around a point (degrees) at that distance, or ends there.
bool holds_together(vec2 point, int channel, float radius, float pixel)
{
#ifndef FLAT
    if (!MAP)
        return true;
    ivec2 size = textureSize(direction_map, 0).xy, middle = ivec2(point);
    if (any(lessThan(middle, ivec2(0))) || any(greaterThanEqual(middle, size)))
        return true;
    vec3 here = texel_at(middle, channel).xyz;
    float off = radius / pixel;
    for (int i = 0; i < 4; ++i) {
        ivec2 at = ivec2(point + off * vec2(float(i == 0) - float(i == 1), float(i == 2) - float(i == 3)));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
            continue;
        vec4 there = texel_at(at, channel);
        if (there.w > 0.0 && length(there.xyz - here) > 3.0 * radians(radius))
            return false;
    }
#endif
    return true;
}

// A bright star's glare; returns its radius, pixels. The same angle on every display, and as wide as it shows.
// disc: its radius where it is the Sun or a globe, as seen; most: the angle at which its glare ends, degrees.
float find_glare(vec2 point, int channel, float pixel_angle, float disc, float most)
{
    float shown = view.row2.w, pixel = degrees(pixel_angle);
    float whole = max(light.r, max(light.g, light.b)) * pixel_angle * pixel_angle; // over all directions
    if (shown == 0.0 || !(whole > 0.0))
        return STAR_RADIUS;
    float least = max(max(GLARE_LEAST, pixel), degrees(disc));
    float radius = min(min(glare_end(shown / whole), most), STAR_REACH * pixel);
    while (radius > max(STAR_RADIUS * pixel, least) && !holds_together(point, channel, radius, pixel))
        radius *= 0.7; // the picture has a seam there
    if (radius <= max(STAR_RADIUS * pixel, least))
        return STAR_RADIUS;
    float level = glare_at(radius * radius + least * least);
    glare = vec4(pixel, least * least, level, glare.w * (1.0 - glare_within(radius, least, level)));
    return radius / pixel;
}

// Finds the point of the viewport (pixels from its corner) that shows n (motion axes). second: the second of two places. Where
// a panorama's ends meet, and beyond its poles, a spot that the picture's edge cuts continues elsewhere.
// angles: the pixel angle there, and the root of a pixel's solid angle.
bool find(vec3 n, int channel, bool second, out vec2 point, out vec2 angles)
{
    vec3 way = vec3(dot(view.row0.xyz, n), dot(view.row1.xyz, n), dot(view.row2.xyz, n));
    if (MAP)
        return find_in_map(way, channel, second, point, angles);
    point = way.xy / way.z;
    angles = vec2(view.row0.w * way.z * sqrt(way.z)); // n = way.z M (point, 1): the pixel lies 1 / way.z away
    return way.z > 0.0;
}

// True if something stands before a distance. A star outside the viewport, whose spot reaches in, may lie beyond the image's edge.
bool hidden(Place place, float distance)
{
    vec4 image = texelFetch(tiles, place.entry + 1);
    vec2 texel = clamp(place.texel, image.xy, image.zw);
    float depth = image.z > 0.0 ? texelFetch(depth_atlas, ivec2(texel), 0).r : 0.0;
    return depth * distance > view.boost.w * sqrt(1.0 + dot(place.face, place.face));
}

// A point of a disc around a direction, of evenly spread ones. radius: as an angle, or 0.
vec3 on_disc(vec3 n, float radius, int i)
{
    vec3 side = normalize(cross(n, abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0))), up = cross(side, n);
    float turn = float(i) * 2.39996323, off = radius * sqrt((float(i) + 0.5) / float(STAR_DISC_POINTS)); // the golden angle
    return normalize(n + off * (cos(turn) * side + sin(turn) * up));
}

// The part of a star that no still thing hides. from_eye: its direction, the cube map's axes.
float part_left(StarEntry star, vec3 from_eye, AberratedRay sight, float pixel_angle)
{
    bool is_disc = star.direction.w > 0.0 && star.light.z > 0.0;
    // The Sun's own ball, where a world has one, hides nothing of it.
    float distance = star.direction.w > 0.0 ? 0.98 * star.light.w : SKY_DISTANCE, left = 0.0;
    int points = is_disc ? STAR_DISC_POINTS : 1;
    for (int i = 0; i < points; ++i) {
        vec3 way = is_disc ? on_disc(from_eye, star.light.z, i) : from_eye; // of the cube map's place
        if (REPROJECT)
            way = reprojected(way, eye_offset(sight.n, world_rest_frame()), world_angle(sight, sight.n, pixel_angle),
                world_rest_frame());
        left += hidden(place_of(way, world_rest_frame()), distance) ? 0.0 : 1.0;
    }
    return left / float(points);
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
    gl_PointSize = 1.0;
    centre = vec3(0.0);
    light = vec3(0.0);
    glare = vec4(0.0);
    vec2 size = view.zenith.zw, point, angles;
    float reach = view.row2.w > 0.0 ? STAR_REACH : STAR_RADIUS;
    if (!find(sight.n, channel, second, point, angles) || any(lessThan(point, vec2(-reach)))
        || any(greaterThan(point, size + reach)))
        return;
    float pixel_angle = angles.x;
    vec3 from_eye = in_cube_axes(n, world_rest_frame());
    float left = part_left(star, from_eye, sight, pixel_angle);
    if (left == 0.0)
        return;
    // A moving body hides the star where the body is drawn.
    if (SEVERAL_REST_FRAMES && covered_by_bodies(sight.n, pixel_angle) > 0.5)
        return;
    float disc = star.direction.w > 0.0 ? star.light.z / world_angle(sight, sight.n, 1.0) : 0.0;
    float most = disc > 0.0 ? DISC_GLARE_MOST : GLARE_MOST;
    bool is_sun = false; // whose glare the warp pass adds
    glare.w = 1.0;
    light = starlight(star, sight) * (left * view.boost.z / (angles.y * angles.y));
#ifdef WITH_GLOBES
    int own = star.direction.w < 0.0 ? int(-1.0 - star.direction.w) : -1;
    light *= left_by_globes(from_eye, own);
    if (own >= 0) {
        is_sun = globe(own).shape.w == GLOBE_SUN;
        disc = star.light.y / world_angle(sight, sight.n, 1.0);
        light *= point_part(disc / pixel_angle);
    }
#endif
    if (METERING_SAMPLES) {
        vec2 place = vec2(mod(float(gl_VertexIndex), view.corner.x), floor(float(gl_VertexIndex) / view.corner.x)) + 0.5;
        gl_Position = vec4(place / view.corner.xy * 2.0 - 1.0, 0.0, 1.0);
        centre = vec3(angles.y, 0.0, 0.0);
        if (LAYERED) // fewer pixels of the picture show this star
            centre.x *= sqrt(part_of(ivec2(clamp(point, vec2(0.0), size - 1.0) + view.origin.xy)));
        return;
    }
    float radius = is_sun ? STAR_RADIUS : find_glare(point, channel, pixel_angle, disc, most);
    if (light == vec3(0.0))
        return;
    gl_PointSize = 2.0 * radius;
    float factor = RANGE ? range_factor(luminance_of(light) / STAR_SPOT) : 1.0; // by its spot's middle luminance
    if (CHANNELS)
        light *= vec3(equal(ivec3(0, 1, 2), ivec3(channel)));
    if (RANGE) {
        glare.y = max(luminance_of(light), 0.0);
        light *= factor;
    }
    centre = vec3(point + view.origin.xy, angles.y * angles.y);
    gl_Position = vec4((point + STAR_REACH) / (size + 2.0 * STAR_REACH) * 2.0 - 1.0, 0.0, 1.0);
}
