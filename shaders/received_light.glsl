// The light seen in a direction of the ship: aberration, the cube map's look-up, Doppler effect and headlight effect.
//
// A driver translates all that a shader may call before it drops what the constants below rule out. Each shader that includes
// this is therefore built four times: whole; with OWN_EYE, for views whose cube map is drawn at their own eye; and with
// ONE_REST_FRAME as well, for worlds where nothing moves. The last build's pipelines are made in a fifth of the time. A fourth,
// with ONE_REST_FRAME and WITH_GLOBES, is for worlds with globes.

#include "constants.h"

COEFFICIENT_CONSTANTS(DECLARED)
RECEIVED_CONSTANTS(DECLARED)
RESPONSE_CONSTANTS(DECLARED)
#ifdef OWN_EYE
const bool REPROJECT = false;
#else
EYE_CONSTANTS(DECLARED)
#endif
#ifdef ONE_REST_FRAME
const bool SEVERAL_REST_FRAMES = false, WORLD_ALONE = false;
const int REST_FRAMES = 1;
#else
MOTION_CONSTANTS(DECLARED)
REST_FRAME_CONSTANTS(DECLARED)
PANORAMA_CONSTANTS(DECLARED)
#endif

const int GROUPS = GROUP_COUNT(REFLECTED + OWN, WITH_ALPHA);

layout(push_constant) uniform Push { ViewPush view; };

layout(set = 0, binding = 1) uniform sampler2D atlas; // the first group of the light's coefficients
layout(set = 0, binding = 2) uniform samplerBuffer tiles; // TileTable
layout(set = 0, binding = 3) uniform usamplerBuffer response; // Response's rows
layout(set = 0, binding = 4) uniform sampler2D depth_atlas; // near / distance along the face's normal, 0 at infinity
layout(set = 0, binding = 5) uniform sampler2D stars_picture; // pixel for pixel the target's; exposed light
layout(set = 0, binding = 7) uniform sampler2D atlas1; // the second group, and so on
layout(set = 0, binding = 8) uniform sampler2D atlas2;
layout(set = 0, binding = 9) uniform sampler2D atlas3;
layout(set = 0, binding = 10) uniform Own { vec4 own_rows[MOST_OWN_ROWS]; };

layout(set = 0, binding = 11) uniform sampler2D covered_atlas; // the covered part of a texel; the same times its depth
layout(set = 0, binding = 12) uniform RestFrames { RestFrameConstants rest_frames; };
layout(set = 0, binding = 14) uniform sampler2D milky_way; // the sky's panorama
layout(set = 0, binding = 21) uniform sampler2D response_picture; // SAMPLED_RESPONSE: the rows as columns (picture_of in response.h)

// A rest frame's part of the cube map and the eye event there, in the cube map's axes.
struct RestFrameView {
    int entry; // of rest_frames
    vec2 E; // and its inverse
    vec4 eye;
    float nearest;
    int tiles, finest_clip_level;
};
// The world's own rest frame.
RestFrameView world_rest_frame() { return RestFrameView(0, view.boost.xy, view.eye, view.zenith.y, 0, int(view.row1.w)); }

// Elements of an array are read by constant indices where they are few: a driver in software reads and writes any other
// pixel by pixel.
const bool FEW_REST_FRAMES = REST_FRAMES < MAX_REST_FRAMES;
RestFrameEntry entry_of(int i)
{
    if (!FEW_REST_FRAMES)
        return rest_frames.entries[i];
    RestFrameEntry entry = rest_frames.entries[0];
    for (int at = 1; at < REST_FRAMES; ++at)
        if (at == i)
            entry = rest_frames.entries[at];
    return entry;
}

// A direction of the frame, given in motion axes, in the cube map's axes.
vec3 in_cube_axes(vec3 n, RestFrameView rest_frame)
{
    if (!UNALIGNED)
        return n;
    RestFrameEntry entry = entry_of(rest_frame.entry);
    return vec3(dot(entry.cube0.xyz, n), dot(entry.cube1.xyz, n), dot(entry.cube2.xyz, n));
}

// The world's direction and D of the camera's direction n, and the magnification of angles from there to the world.
AberratedRay from_camera(vec3 n, vec2 E) { return GALILEAN ? galilean_world_from_camera(n, E.x, E.y) : world_from_camera(n, E.x, E.y); }
float growth(AberratedRay sight, vec3 n, vec2 E)
{
    if (!GALILEAN)
        return sight.D;
    vec2 stretch = galilean_stretch(n, E.x, E.y);
    return sqrt(stretch.x * stretch.y);
}

struct Place {
    vec2 face;  // face coordinates
    vec2 texel; // of the atlas
    float texels_per_unit, last_level; // of the image
    int entry; // of the image in `tiles`
};

// Finds the plan's image of the direction n: tiles.cpp's tile_of, in float.
Place place_of(vec3 n, RestFrameView rest_frame)
{
    vec3 m = abs(n);
    bool x_greater = m.x >= m.y;
    float across = max(m.x, m.y);
    bool along = m.z >= across, ahead = n.z >= 0.0;
    Place place;
    int tile;
    if (SINGLE) {
        place.face = n.xy / n.z;
        tile = TILE_FRONT;
    } else {
        vec2 side = x_greater ? n.xy : n.yx; // across the face, and along it
        float inverse = 1.0 / max(m.z, across), larger = across * inverse;
        place.face = (along ? n.xy : vec2(side.y, n.z)) * inverse;
        // floor(-log2(larger^2)) from the exponent's bits; 126: an exact power of two goes to the coarser image.
        int rear = clamp(126 + TILE_REAR - (floatBitsToInt(larger * larger) >> 23), TILE_REAR, TILE_REAR + rest_frame.finest_clip_level);
        int first = (x_greater ? TILE_SIDES : TILE_SIDES + 2 * SIDE_BANDS) + SIDE_BANDS * int(floatBitsToUint(side.x) >> 31);
        int sides = first + int(place.face.y > -0.5) + int(place.face.y > 0.0);
        tile = along ? (ahead ? TILE_FRONT : rear) : sides;
    }
    tile += rest_frame.tiles;
    ivec2 cell = ivec2(0);
    if (CUT) {
        vec4 sub_tiles_from_face = texelFetch(tiles, tile);
        vec2 spread = along && !ahead ? place.face * abs(place.face) : place.face;
        cell = min(ivec2(spread * sub_tiles_from_face.xy + sub_tiles_from_face.zw), TILE_SUB_TILES - 1);
    }
    place.entry = TILE_ENTRY(tile, cell.y * TILE_SUB_TILES + cell.x);
    vec4 to_texel = SINGLE ? view.eye : texelFetch(tiles, place.entry);
    place.texel = place.face * to_texel.x + to_texel.yz;
    place.texels_per_unit = to_texel.x;
    place.last_level = to_texel.w;
    return place;
}

// Aberration is conformal: the pixel's footprint stays round, so one number is its exact level of detail.
float level_of(Place place, float world_angle)
{
    if (!MIPS)
        return 0.0;
    float distance_square = 1.0 + dot(place.face, place.face);
    float at_middle = min(world_angle * place.texels_per_unit, 1e9), square = at_middle * at_middle; // of texels
    // A texel is the mean over its square, and interpolation between texels is linear: together they spread light with a
    // variance of 1/4 of a texel's square. A square pixel has a variance of 1/12 of its own square. The texels should
    // therefore be finer by the root of 3, 0.79 levels.
    return clamp(0.25 * log2(square * square * (distance_square * distance_square * distance_square)) - 0.79, 0.0, place.last_level);
}
void cube_map(Place place, float world_angle, out vec4 coefficients[MAX_GROUPS])
{
    float level = level_of(place, world_angle);
    vec2 at = place.texel * view.origin.zw;
    coefficients[0] = textureLod(atlas, at, level);
    if (GROUPS > 1)
        coefficients[1] = textureLod(atlas1, at, level);
    if (GROUPS > 2)
        coefficients[2] = textureLod(atlas2, at, level);
    if (GROUPS > 3)
        coefficients[3] = textureLod(atlas3, at, level);
}

// A pair of halves: a value and its increase up to the next row.
float halves(uint word, float part)
{
    vec2 pair = unpackHalf2x16(word);
    return pair.x + part * pair.y;
}

float coefficient(vec4 coefficients[MAX_GROUPS], int k)
{
    int place = PLACE_IN_GROUPS(k, WITH_ALPHA);
    return coefficients[place / 4][place % 4];
}

// The four coefficients from the k-th on.
vec4 four_from(vec4 coefficients[MAX_GROUPS], int k)
{
    if (!WITH_ALPHA)
        return coefficients[k / 4];
    return vec4(coefficient(coefficients, k), k + 1 < REFLECTED ? coefficient(coefficients, k + 1) : 0.0,
        k + 2 < REFLECTED ? coefficient(coefficients, k + 2) : 0.0, k + 3 < REFLECTED ? coefficient(coefficients, k + 3) : 0.0);
}

// The colour of the reflected light at a row of the response, as a part of 2^scale.
vec3 reflected_at(vec4 coefficients[MAX_GROUPS], float at, out float scale)
{
    float part = fract(at);
    int row = int(at) * RESPONSE_TEXELS(REFLECTED);
    vec3 light = vec3(0.0);
    // The parts of four coefficients in three colours take three texels.
    for (int four = 0; four < (REFLECTED + 3) / 4; ++four) {
        vec4 own = four_from(coefficients, 4 * four);
        uvec4 first = texelFetch(response, row + 3 * four), second = texelFetch(response, row + 3 * four + 1);
        uvec4 third = texelFetch(response, row + 3 * four + 2);
        light += own.x * vec3(halves(first.x, part), halves(first.y, part), halves(first.z, part));
        if (4 * four + 1 < REFLECTED)
            light += own.y * vec3(halves(first.w, part), halves(second.x, part), halves(second.y, part));
        if (4 * four + 2 < REFLECTED)
            light += own.z * vec3(halves(second.z, part), halves(second.w, part), halves(third.x, part));
        if (4 * four + 3 < REFLECTED)
            light += own.w * vec3(halves(third.y, part), halves(third.z, part), halves(third.w, part));
    }
    const int last = 3 * REFLECTED;
    float here = uintBitsToFloat(texelFetch(response, row + last / 4)[last % 4]);
    float added = uintBitsToFloat(texelFetch(response, row + (last + 1) / 4)[(last + 1) % 4]);
    scale = here + part * added;
    return light;
}
vec3 sampled_reflected_at(vec4 coefficients[MAX_GROUPS], float across, out float scale)
{
    vec3 light = vec3(0.0);
    scale = 0.0;
    for (int k = 0; k < REFLECTED; ++k) {
        vec4 column = textureLod(response_picture, vec2(across, (float(k) + 0.5) / float(REFLECTED)), 0.0);
        light += coefficient(coefficients, k) * column.rgb;
        if (k < 2)
            scale += column.a;
    }
    return light;
}

// The colour of light that is shifted by D, the same as response.cpp's seen, times 2^stops.
vec3 shifted(vec4 coefficients[MAX_GROUPS], float log2_D, float stops)
{
    float across = log2_D * view.corner.w + view.row2.w, scale;
    float at = clamp(across * float(RESPONSE_ROWS) - 0.5, 0.0, float(RESPONSE_ROWS) - 1.001);
    // Beyond the table every tail falls as 1 / D^2.
    stops += min(view.corner.z - 2.0 * log2_D, 0.0);
    vec3 light = SAMPLED_RESPONSE ? sampled_reflected_at(coefficients, across, scale) : reflected_at(coefficients, at, scale);
    light *= exp2(scale + stops);
    if (OWN > 0) {
        float strength = exp2(stops), own_at = min(at / float(RESPONSE_OWN_STEP(OWN)), float(RESPONSE_ROWS / RESPONSE_OWN_STEP(OWN)) - 1.001);
        int j = int(own_at) * OWN;
        for (int k = 0; k < OWN; ++k) {
            vec4 own = mix(own_rows[j + k], own_rows[j + OWN + k], fract(own_at));
            light += own.rgb * (strength * exp2(own.w) * coefficient(coefficients, REFLECTED + k));
        }
    }
    return light;
}

// near / distance along the face's normal at a texel of the cube map, 0 for the sky.
float depth_of(ivec2 texel)
{
    if (!SEVERAL_REST_FRAMES)
        return texelFetch(depth_atlas, texel, 0).r;
    vec2 covered = texelFetch(covered_atlas, texel, 0).rg;
    return covered.x > 0.0 ? covered.y / covered.x : 0.0;
}

bool is_sky(float distance) { return distance > 0.1 * SKY_DISTANCE; }

// The distance at a place of the cube map, from its eye event, scene units; SKY_DISTANCE for the sky.
float distance_at(Place place)
{
    float depth = depth_of(ivec2(place.texel));
    return depth > 0.0 ? view.boost.w * sqrt(1.0 + dot(place.face, place.face)) / depth : SKY_DISTANCE;
}

#include "reprojection.glsl"

// The angle in the world of a pixel at the ship's direction n.
float world_angle(AberratedRay sight, vec3 n, float pixel_angle)
{
    return ABERRATION ? growth(sight, n, view.boost.xy) * pixel_angle : pixel_angle;
}

// The cube map's direction for the ship's direction n (motion axes): in the world, the cube map's axes, with D.
AberratedRay sight_of(vec3 n, float pixel_angle)
{
    AberratedRay sight = from_camera(n, view.boost.xy);
    if (!ABERRATION)
        sight.n = n;
    sight.n = in_cube_axes(sight.n, world_rest_frame());
    if (REPROJECT)
        sight.n = reprojected(sight.n, eye_offset(n, world_rest_frame()), world_angle(sight, n, pixel_angle), world_rest_frame());
    return sight;
}

// Scene-linear light times 2^stops, pre-exposed by the cube map's factor; colours outside Rec. 709 have negative channels. D comes
// with its binary logarithm, which alone the table needs.
vec3 light_of(vec4 coefficients[MAX_GROUPS], float D, float log2_D, float stops)
{
    if (BY_TABLE)
        return shifted(coefficients, DOPPLER ? log2_D : 0.0, HEADLIGHT ? stops + 3.0 * log2_D : stops);
    return coefficients[0].rgb * (HEADLIGHT ? headlight(D) * exp2(stops) : exp2(stops));
}
vec3 light_of(vec4 coefficients[MAX_GROUPS], float D) { return light_of(coefficients, D, log2(D), 0.0); }
vec3 light_seen(Place place, float D, float log2_D, float angle, float stops)
{
    vec4 coefficients[MAX_GROUPS];
    cube_map(place, angle, coefficients);
    return light_of(coefficients, D, log2_D, stops);
}
vec3 light_seen(Place place, float D, float angle) { return light_seen(place, D, log2(D), angle, 0.0); }

#include "rest_frames.glsl"

#ifdef WITH_GLOBES
#include "globes.glsl"
#endif

// The result of a direction.
struct Shown {
    vec3 n;         // unit direction in the ship, motion axes
    AberratedRay sight;    // in the world, the cube map's axes; its D is the source's
    float distance; // in the world, the light's travel distance there; SKY_DISTANCE for the sky
    float frame;    // the source's rest frame, of the world's frames; -1: a globe, at rest in the world
    vec3 light;     // from light_seen
};
Shown shown_along(vec3 n, float pixel_angle)
{
    Shown shown;
    shown.n = n;
    shown.sight = sight_of(n, pixel_angle);
    if (SEVERAL_REST_FRAMES && !WORLD_ALONE) {
        shown.light = light_of_rest_frames(n, pixel_angle, shown.sight, shown.distance, shown.frame);
        return shown;
    }
    Place place = place_of(shown.sight.n, world_rest_frame());
    float angle = world_angle(shown.sight, n, pixel_angle);
    if (WORLD_ALONE)
        shown.light = light_over_sky(place, shown.sight, angle);
    else
        shown.light = light_seen(place, shown.sight.D, angle);
    shown.distance = distance_at(place);
    shown.frame = 0.0;
#ifdef WITH_GLOBES
    // They are far from the ship, and found for the eye itself.
    vec3 to_globes = in_cube_axes(ABERRATION ? from_camera(n, view.boost.xy).n : n, world_rest_frame());
    float globe_distance = 0.0;
    add_globes(to_globes, angle, shown.sight.D, shown.light, globe_distance);
    if (globe_distance > 0.0) {
        shown.sight.n = to_globes;
        shown.distance = globe_distance;
        shown.frame = -1.0;
    }
#endif
    return shown;
}

// The result of a pixel, or of a pixel that is several times as wide.
Shown shown_at(vec2 pixel, int channel, float coarser, out float pixel_angle)
{
    vec3 n = look(view.row0, view.row1, view.row2, pixel, channel, pixel_angle);
    if (!MAP || pixel_angle > 0.0)
        return shown_along(n, pixel_angle * coarser);
    return Shown(n, AberratedRay(n, 1.0), 0.0, 0.0, vec3(0.0)); // nothing
}

// True where a view shows the light of one cube map, drawn at its own eye, and no other.
#if defined ONE_REST_FRAME && !defined WITH_GLOBES
const bool ONE_LIGHT = true;
#else
const bool ONE_LIGHT = false;
#endif

// The light along the ship's vector v, times 2^stops. square: of v's length. One light needs no unit direction, and of D its
// logarithm alone.
vec3 light_along(vec3 v, float square, float pixel_angle, float stops)
{
    if (!ONE_LIGHT)
        return shown_along(v * inversesqrt(square), pixel_angle).light * exp2(stops);
    vec3 in_world = v;
    float D = 1.0, log2_D = 0.0, magnified = 1.0; // angles
    if (GALILEAN) {
        vec3 n = v * inversesqrt(square);
        AberratedRay sight = from_camera(n, view.boost.xy);
        in_world = sight.n, D = sight.D, log2_D = log2(D), magnified = growth(sight, n, view.boost.xy);
    } else if (ABERRATION || DOPPLER || HEADLIGHT) {
        AberratedVector there = world_vector_from_camera(v, sqrt(square), view.boost.x, view.boost.y);
        in_world = there.v, magnified = D = sqrt(square) / there.length_;
        log2_D = 0.5 * log2(square) - log2(there.length_);
    }
    if (!ABERRATION)
        in_world = v, magnified = 1.0;
    Place place = place_of(in_cube_axes(in_world, world_rest_frame()), world_rest_frame());
    return light_seen(place, D, log2_D, magnified * pixel_angle, stops);
}

// The light along the middle of a pixel, times 2^stops; 0 where the angle is.
vec3 light_at_middle(vec2 pixel, int channel, float stops, out float pixel_angle)
{
    float square;
    vec3 v = look_along(view.row0, view.row1, view.row2, pixel, channel, square, pixel_angle);
    return !MAP || pixel_angle > 0.0 ? light_along(v, square, pixel_angle, stops) : vec3(0.0);
}

// The light of a pixel, times 2^stops: the mean along RAYS x RAYS evenly distributed directions; 0 where the angle is.
vec3 light_at(vec2 pixel, int channel, float stops, out float pixel_angle)
{
    if (RAYS == 1)
        return light_at_middle(pixel, channel, stops, pixel_angle);
    MapAround map;
    if (MAP) {
        map = map_around(pixel, channel);
        pixel_angle = map.here.w;
        if (pixel_angle == 0.0)
            return vec3(0.0);
    }
    vec3 sum = vec3(0.0);
    for (int ray = 0; ray < RAYS * RAYS; ++ray) {
        vec2 offset = (vec2(ray % RAYS, ray / RAYS) + 0.5) / float(RAYS) - 0.5;
        float square;
        vec3 v = MAP ? look_within(view.row0, view.row1, view.row2, map, offset, square)
                     : look_along(view.row0, view.row1, view.row2, pixel + offset, channel, square, pixel_angle);
        sum += light_along(v, square, pixel_angle / float(RAYS), stops);
    }
    return sum / float(RAYS * RAYS);
}
