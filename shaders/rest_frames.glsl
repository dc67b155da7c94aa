// Several rest frames: each has a cube map of its own, boosted directly to the camera. Along a line of sight, the light's
// travel distance in the ship is D times that in any frame; the frames' surfaces are ordered by it, in front of the sky.

#ifdef ONE_REST_FRAME
vec3 light_over_sky(Place place, AberratedRay sight, float angle) { return light_seen(place, sight.D, angle); }
vec3 light_of_rest_frames(vec3 n0, float pixel_angle, inout AberratedRay sight, out float distance_, out float frame)
{
    distance_ = frame = 0.0;
    return vec3(0.0);
}
float covered_by_bodies(vec3 n0, float pixel_angle) { return 0.0; }
#else

#define SKY rest_frames.sky
#include "sky.glsl"

int rest_frame_count() { return int(rest_frames.count[floatBitsToInt(rest_frames.first.w)].x); }

RestFrameView rest_frame_of(int i)
{
    RestFrameEntry entry = entry_of(i);
    return RestFrameView(i, entry.boost.xy, entry.eye, entry.nearest.y, int(entry.boost.z), int(entry.row1.w));
}

// The light of the world's rest frame in front of the sky. What a texel's surfaces leave free, premultiplied, is the sky's.
vec3 light_over_sky(Place place, AberratedRay sight, float angle)
{
    vec4 coefficients[MAX_GROUPS], sky[MAX_GROUPS];
    cube_map(place, angle, coefficients);
    float left = 1.0 - min(textureLod(covered_atlas, place.texel * view.origin.zw, level_of(place, angle)).r, 1.0);
    sky_light(sight.n, angle, sky);
    for (int group = 0; group < GROUPS; ++group)
        coefficients[group] += left * sky[group];
    return light_of(coefficients, sight.D);
}

// A rest frame's surfaces in up to four parts side by side: each one's distance in the ship, and its coverage of the
// pixel. One part if the four texels around belong to one surface; several otherwise.
struct Part {
    Place place;
    float D, world_angle, level;
    vec4 ways, covers;
};

ivec2 texel_of(Place place, int k) { return ivec2(floor(place.texel - 0.5)) + ivec2(k & 1, k >> 1); }

// The place that the ship's direction n0 looks at in a rest frame's part of the cube map; the ray there, and the pixel's
// angle.
Place place_in(int i, vec3 n0, float pixel_angle, out AberratedRay sight, out float world_angle)
{
    RestFrameEntry entry = entry_of(i);
    RestFrameView rest_frame = rest_frame_of(i);
    vec3 n = i == 0 ? n0 : vec3(dot(entry.row0.xyz, n0), dot(entry.row1.xyz, n0), dot(entry.row2.xyz, n0));
    sight = from_camera(n, rest_frame.E);
    world_angle = growth(sight, n, rest_frame.E) * pixel_angle;
    sight.n = in_cube_axes(sight.n, rest_frame);
    if (REPROJECT)
        sight.n = reprojected(sight.n, eye_offset(n, rest_frame), world_angle, rest_frame);
    return place_of(sight.n, rest_frame);
}

Part part_of(int i, vec3 n0, float pixel_angle, float D_beside)
{
    AberratedRay sight;
    Part part;
    part.place = place_in(i, n0, pixel_angle, sight, part.world_angle);
    part.D = sight.D * D_beside;
    part.ways = vec4(SKY_DISTANCE);
    part.covers = vec4(0.0);
    vec4 image = texelFetch(tiles, part.place.entry + 1);
    vec2 texel = part.place.texel;
    // Moving things do not fill their images, and pixels see past them: nothing beyond their edges enters the filter.
    float margin = i == 0 ? 0.5 : 2.0 * exp2(part.place.last_level);
    if (!(image.z > 0.0 && all(greaterThanEqual(texel, image.xy + margin)) && all(lessThanEqual(texel, image.zw + 1.0 - margin))))
        return part;
    part.level = level_of(part.place, part.world_angle);
    float per_depth = sight.D * view.boost.w * sqrt(1.0 + dot(part.place.face, part.place.face));
    vec2 covered;
    if (part.level >= 0.5) {
        covered = textureLod(covered_atlas, texel * view.origin.zw, part.level).rg;
    } else {
        vec4 depths, parts;
        for (int k = 0; k < 4; ++k) {
            vec2 one = texelFetch(covered_atlas, texel_of(part.place, k), 0).rg;
            parts[k] = one.x;
            depths[k] = one.y;
        }
        vec2 at = fract(texel - 0.5);
        vec4 covers = parts * vec4((1.0 - at.x) * (1.0 - at.y), at.x * (1.0 - at.y), (1.0 - at.x) * at.y, at.x * at.y);
        depths /= max(parts, vec4(1e-3));
        vec4 nearest = mix(vec4(SKY_DISTANCE), depths, greaterThan(parts, vec4(0.0)));
        float least = min(min(nearest.x, nearest.y), min(nearest.z, nearest.w));
        float most = max(max(depths.x, depths.y), max(depths.z, depths.w));
        if (most > 1.1 * least) {
            part.covers = covers;
            part.ways = per_depth / max(depths, vec4(1e-30));
            return part;
        }
        covered = vec2(dot(covers, vec4(1.0)), dot(covers, depths));
    }
    if (covered.x > 0.0 && covered.y > 0.0) {
        part.ways.x = per_depth * covered.x / covered.y;
        part.covers.x = min(covered.x, 1.0);
    }
    return part;
}

// parts[at], of few rest frames. For more, the callers index the array themselves: a function would copy all of it.
void keep(inout Part parts[REST_FRAMES], int at, Part part)
{
    for (int i = 0; i < REST_FRAMES; ++i)
        if (i == at)
            parts[i] = part;
}
Part kept(Part parts[REST_FRAMES], int at)
{
    Part part = parts[0];
    for (int i = 1; i < REST_FRAMES; ++i)
        if (i == at)
            part = parts[i];
    return part;
}

// The part of a pixel that a rest frame covers nearer than `way`.
float before(Part part, float way) { return dot(part.covers, vec4(lessThan(part.ways, vec4(way)))); }

// The basis coefficients of a rest frame's k-th part without other parts in front: premultiplied.
void coefficients_of_part(Part part, int k, out vec4 coefficients[MAX_GROUPS])
{
    if (part.covers.y + part.covers.z + part.covers.w == 0.0) {
        cube_map(part.place, part.world_angle, coefficients);
        return;
    }
    ivec2 texel = texel_of(part.place, k);
    float whole = texelFetch(covered_atlas, texel, 0).r, weight = whole > 0.0 ? part.covers[k] / whole : 0.0;
    coefficients[0] = texelFetch(atlas, texel, 0) * weight;
    if (GROUPS > 1)
        coefficients[1] = texelFetch(atlas1, texel, 0) * weight;
    if (GROUPS > 2)
        coefficients[2] = texelFetch(atlas2, texel, 0) * weight;
    if (GROUPS > 3)
        coefficients[3] = texelFetch(atlas3, texel, 0) * weight;
}

// The light in the ship's direction n0 (the world's motion axes): of all rest frames, each part behind the other frames'
// nearer coverage, and of the sky behind them all. The order of frames does not matter, because a frame's own parts are
// side by side. sight: the world's; its D, the distance and the frame become those of the source that fills most of the
// pixel.
vec3 light_of_rest_frames(vec3 n0, float pixel_angle, inout AberratedRay sight, out float distance_, out float frame)
{
    // Without aberration, directions are the world's, and moving things are seen from the world's rest frame; D includes
    // the ship's own.
    float D_beside = ABERRATION ? 1.0 : sight.D, sky_D = sight.D;
    int count = rest_frame_count();
    Part parts[REST_FRAMES];
    for (int i = 0; FEW_REST_FRAMES && i < REST_FRAMES; ++i)
        parts[i].covers = vec4(0.0);
    float left = 1.0; // for the sky
    int shown = 0;
    for (int i = 0; i < count; ++i) {
        // The filter reaches some pixels beyond the surfaces; the last addend is the rounding of the dot product.
        RestFrameEntry entry = entry_of(i);
        if (dot(n0, entry.cap.xyz) < entry.cap.w - 4.0 * pixel_angle - 1e-6)
            continue;
        Part part = part_of(i, n0, pixel_angle, D_beside);
        if (is_sky(part.ways.x) && part.covers == vec4(0.0))
            continue;
        left *= 1.0 - min(dot(part.covers, vec4(1.0)), 1.0);
        part.level = entry.boost.w; // from here on: the index of its rest frame
        if (FEW_REST_FRAMES)
            keep(parts, shown, part);
        else
            parts[shown] = part;
        ++shown;
    }
    // The world's rest frame has the sky's D, so both share one table look-up; each moving frame needs one more.
    vec4 world[MAX_GROUPS];
    sky_light(sight.n, world_angle(sight, n0, pixel_angle), world);
    for (int group = 0; group < GROUPS; ++group)
        world[group] *= left;
    vec3 light = vec3(0.0);
    float most = 0.0;
    distance_ = SKY_DISTANCE;
    frame = 0.0;
    for (int i = 0; i < shown; ++i) {
        Part part;
        if (FEW_REST_FRAMES)
            part = kept(parts, i);
        else
            part = parts[i];
        bool rests = part.level == 0.0, any_seen = false;
        vec4 moving[MAX_GROUPS];
        for (int group = 0; group < GROUPS; ++group)
            moving[group] = vec4(0.0);
        // A part that is alone is the first.
        int samples = part.covers.y + part.covers.z + part.covers.w == 0.0 ? 1 : 4;
        for (int k = 0; k < samples; ++k) {
            float covers = part.covers[k], way = part.ways[k];
            if (covers <= 0.0)
                continue;
            float seen = 1.0;
            for (int j = 0; j < (FEW_REST_FRAMES ? REST_FRAMES : shown); ++j)
                if (j != i)
                    seen *= 1.0 - min(before(parts[j], way), 1.0);
            if (seen < 0.002)
                continue;
            vec4 coefficients[MAX_GROUPS];
            coefficients_of_part(part, k, coefficients);
            any_seen = true;
            for (int group = 0; group < GROUPS; ++group)
                moving[group] += seen * coefficients[group];
            if (seen * covers > most) {
                most = seen * covers;
                distance_ = way / (ABERRATION ? sky_D : 1.0);
                sight.D = part.D;
                frame = part.level;
            }
        }
        if (rests)
            for (int group = 0; group < GROUPS; ++group)
                world[group] += moving[group];
        else if (any_seen)
            light += light_of(moving, part.D);
    }
    if (left > 0.5) { // the sky fills most of the pixel
        distance_ = SKY_DISTANCE;
        sight.D = sky_D;
        frame = 0.0;
    }
    return light + light_of(world, sky_D);
}

// The greatest part of a pixel that a moving body covers in front of the sky.
float covered_by_bodies(vec3 n0, float pixel_angle)
{
    float most = 0.0;
    for (int i = 1; i < rest_frame_count(); ++i)
        most = max(most, dot(part_of(i, n0, pixel_angle, 1.0).covers, vec4(1.0)));
    return most;
}
#endif
