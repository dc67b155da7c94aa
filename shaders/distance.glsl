// The distance of the surface that a direction shows, between the samples of the cube map's depth. near / depth is linear
// across a plane's picture, so a plane through neighbouring texels is exact. Needs received_light.glsl.

// The place of depth_atlas's sample in a texel: a multisampled depth is that of sample 0, at Vulkan's standard place.
// covered_atlas is the mean of all samples, whose places are symmetric around the middle.
vec2 sample_place()
{
    if (SEVERAL_REST_FRAMES || CUBE_SAMPLES == 1)
        return vec2(0.5);
    return CUBE_SAMPLES == 2 ? vec2(0.75) : CUBE_SAMPLES == 4 ? vec2(0.375, 0.125) : vec2(0.5625, 0.3125);
}

// depth_of inside an image of the plan (its first and last texel), 0 outside.
float depth_within(ivec2 texel, ivec4 image)
{
    return all(greaterThanEqual(texel, image.xy)) && all(lessThanEqual(texel, image.zw)) ? depth_of(texel) : 0.0;
}

// The change of depth over `offset` texels along `way` on a texel's surface. Of the texels before, around and after it, the
// three that bend least lie on the surface. Where all of them bend, it is hardly wider than a texel: 0. Where the next texel
// is not on the surface, the surface ends: one that is seen along itself must not be drawn out there, far past its end.
float change_along(ivec2 texel, ivec2 way, float offset, ivec4 image, float here)
{
    float before2 = depth_within(texel - 2 * way, image), before = depth_within(texel - way, image);
    float after = depth_within(texel + way, image), after2 = depth_within(texel + 2 * way, image);
    float slope = 0.0, least = 1e30;
    if (before > 0.0 && after > 0.0)
        least = abs(before - 2.0 * here + after), slope = 0.5 * (after - before);
    if (before2 > 0.0 && before > 0.0 && abs(before2 - 2.0 * before + here) < 0.5 * least)
        least = abs(before2 - 2.0 * before + here), slope = here - before;
    if (after > 0.0 && after2 > 0.0 && abs(here - 2.0 * after + after2) < 0.5 * least)
        least = abs(here - 2.0 * after + after2), slope = after - here;
    if (least >= max(0.25 * abs(slope), 1e-3 * here))
        return 0.0;
    float next = offset > 0.0 ? after : before, on_plane = here + (offset > 0.0 ? slope : -slope);
    float most = abs(next - on_plane) < 0.5 * abs(slope) + 1e-4 * here ? 1e30 : 2e-3 * here;
    return clamp(slope * offset, -most, most);
}

// The depth at `at`, texels with samples at whole numbers, of the surface that `texel` shows.
float plane_depth(ivec2 texel, vec2 at, ivec4 image)
{
    float here = depth_of(texel);
    vec2 offset = at - vec2(texel);
    float depth = here + change_along(texel, ivec2(1, 0), offset.x, image, here)
        + change_along(texel, ivec2(0, 1), offset.y, image, here);
    return depth > 0.0 ? depth : here;
}

// The same as distance_at, but exact on planes.
float exact_distance_at(Place place)
{
    ivec4 image = ivec4(texelFetch(tiles, place.entry + 1));
    vec2 at = place.texel - sample_place();
    ivec2 texel = clamp(ivec2(round(at)), image.xy, image.zw);
    if (depth_of(texel) <= 0.0)
        return SKY_DISTANCE;
    return view.boost.w * sqrt(1.0 + dot(place.face, place.face)) / plane_depth(texel, at, image);
}

// Makes Shown::distance exact, of a surface in one of several rest frames. n0: the ship's direction.
#ifdef ONE_REST_FRAME
float exact_distance_in(float distance, int frame, vec3 n0, float pixel_angle) { return distance; }
#else
float exact_distance_in(float distance, int frame, vec3 n0, float pixel_angle)
{
    int i = 0;
    while (i + 1 < rest_frame_count() && int(rest_frames.entries[i].boost.w) != frame)
        ++i;
    float angle;
    AberratedRay sight;
    Place place = place_in(i, n0, pixel_angle, sight, angle);
    float in_ship = ABERRATION ? from_camera(n0, view.boost.xy).D : 1.0;
    float per_depth = sight.D * view.boost.w * sqrt(1.0 + dot(place.face, place.face)) / in_ship;
    ivec4 image = ivec4(texelFetch(tiles, place.entry + 1));
    // The surface is that of the nearest texel. Where this frame has nothing there, it belongs to the texel around whose
    // depth is nearest to the shown one, which is a mean over the pixel.
    vec2 at = place.texel - sample_place();
    ivec2 texel = clamp(ivec2(round(at)), image.xy, image.zw);
    if (depth_of(texel) <= 0.0) {
        float shown = per_depth / distance, least = 1e30;
        texel = ivec2(-1);
        for (int k = 0; k < 4; ++k) {
            float depth = depth_within(texel_of(place, k), image), off = abs(depth - shown);
            if (depth > 0.0 && off < least)
                least = off, texel = texel_of(place, k);
        }
    }
    return texel.x < 0 ? distance : per_depth / plane_depth(texel, at, image);
}
#endif

// The distance that the instruments read along the ship's direction of `shown`; SKY_DISTANCE for the sky. An eye beside the
// cube map's own keeps the nearest texel's distance, by which its direction was found.
float exact_distance(Shown shown, float pixel_angle)
{
    if (REPROJECT || shown.frame < 0.0)
        return shown.distance;
    if (!SEVERAL_REST_FRAMES)
        return exact_distance_at(place_of(shown.sight.n, world_rest_frame()));
    return is_sky(shown.distance) ? shown.distance : exact_distance_in(shown.distance, int(shown.frame), shown.n, pixel_angle);
}
