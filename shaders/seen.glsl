// What light a direction of the ship brings: aberration, the cube map's look-up, Doppler and headlight.

layout(constant_id = 1) const bool ABERRATION = true;
layout(constant_id = 2) const bool DOPPLER = true;
layout(constant_id = 3) const bool HEADLIGHT = true;
layout(constant_id = 4) const bool MIPS = false;
layout(constant_id = 5) const bool CHANNELS = false; // red, green and blue look different ways
layout(constant_id = 6) const bool REPROJECT = false; // the eye is not where the cube map was drawn
layout(constant_id = 7) const bool TURNING = false; // and on which side of it depends on the azimuth
layout(constant_id = 8) const bool STARS = false;

layout(push_constant) uniform Push { ViewPush view; };

layout(set = 0, binding = 1) uniform sampler2D atlas;
layout(set = 0, binding = 2) uniform Slots { SlotEntry slots[SLOT_COUNT]; };
layout(set = 0, binding = 3) uniform Colours { vec4 colours[COLOUR_STEPS * 3]; };
layout(set = 0, binding = 4) uniform sampler2D depth_atlas; // near / distance along the face's normal, 0 at infinity
layout(set = 0, binding = 5) uniform sampler2D stars_picture; // pixel for pixel the target's; light as the atlas's

struct Place {
    vec2 face;  // face coordinates
    vec2 atlas; // normalised
    vec4 detail;
    int slot;
};

// The image of the plan that holds the world's direction n: plan.cpp's slot_of, in float.
Place place_of(vec3 n)
{
    vec3 m = abs(n);
    bool x_greater = m.x >= m.y;
    float across = max(m.x, m.y);
    Place place;
    int slot;
    if (m.z >= across) {
        place.face = n.xy / m.z;
        float larger = across / m.z;
        // floor(-log2(larger^2)) from the exponent's bits; 126: an exact power of two goes to the coarser image.
        int level = 126 - (floatBitsToInt(larger * larger) >> 23);
        slot = n.z >= 0.0 ? SLOT_FRONT : SLOT_REAR + clamp(level, 0, int(view.row1.w));
    } else {
        place.face = vec2(x_greater ? n.y : n.x, n.z) / across;
        int side = x_greater ? (n.x >= 0.0 ? 0 : 1) : (n.y >= 0.0 ? 2 : 3);
        slot = SLOT_SIDES + side * SIDE_BANDS + int(place.face.y > -0.5) + int(place.face.y > 0.0);
    }
    place.slot = slot;
    vec4 to_atlas = slots[slot].atlas_from_face;
    place.atlas = place.face * to_atlas.xy + to_atlas.zw;
    place.detail = MIPS ? slots[slot].detail : vec4(0.0);
    return place;
}

// Aberration is conformal: the pixel's footprint stays round, so one number is its exact level of detail.
vec3 cube_map(Place place, float world_angle)
{
    if (!MIPS)
        return textureLod(atlas, place.atlas, 0.0).rgb;
    float distance_square = 1.0 + dot(place.face, place.face);
    float texels = world_angle * place.detail.x * pow(distance_square, 0.75);
    return textureLod(atlas, place.atlas, clamp(log2(texels), 0.0, place.detail.y)).rgb;
}

// A colour whose light is shifted by D. The achromatic part is a sunlit grey, which stays a black body; what is left over is
// three bands around the primaries that slide along the spectrum. The table holds, per step of ln D, the colours of both.
vec3 doppler_shifted(vec3 rgb, float D)
{
    float grey = min(rgb.r, min(rgb.g, rgb.b));
    vec4 parts = vec4(rgb - grey, grey);
    float at = (log2(D) + COLOUR_RANGE) * ((COLOUR_STEPS - 1) / (2.0 * COLOUR_RANGE));
    float inside = clamp(at, 0.0, float(COLOUR_STEPS - 1) - 0.001);
    int i = int(inside) * 3;
    float f = inside - floor(inside);
    vec3 shifted = vec3(dot(mix(colours[i], colours[i + 3], f), parts), dot(mix(colours[i + 1], colours[i + 4], f), parts),
        dot(mix(colours[i + 2], colours[i + 5], f), parts));
    // Above the table a hot body's visible light grows as D, so without the headlight's D^3 it falls as 1 / D^2.
    if (at > float(COLOUR_STEPS - 1)) {
        float beyond = exp2(COLOUR_RANGE) / D;
        shifted *= beyond * beyond;
    }
    return max(shifted, vec3(0.0));
}

// Distance of what a place of the cube map shows, from where it was drawn, scene units; infinite for the sky.
float distance_at(Place place)
{
    float depth = texelFetch(depth_atlas, ivec2(place.atlas * view.origin.zw), 0).r;
    return depth > 0.0 ? view.boost.w * sqrt(1.0 + dot(place.face, place.face)) / depth : intBitsToFloat(0x7f800000);
}

// The eye's place from the cube map's, in the world at rest. n: the ship's direction.
vec3 eye_offset(vec3 n)
{
    if (!TURNING)
        return view.eye.xyz;
    vec3 right = cross(n, view.eye.xyz); // as long as the sine of the angle from the zenith
    vec3 offset = right * (view.eye.w / max(length(right), view.zenith.x));
    offset.z *= 0.5 * (view.boost.x + view.boost.y); // simultaneous in the ship: stretched by gamma in the world
    return offset;
}

// Where the cube map shows what an eye beside it sees along n (world). The eye's line of sight, seen from the cube map's place,
// is an arc from the nearest surface that there may be to n at infinity: the first place on it where the cube map's surface
// is no farther than the line is what the eye sees. It is looked for in steps of about five texels (even in 1 / distance, as
// parallax is) and, where a surface ends between two steps, before its end; then drawn closer to P = d(m) m with P - offset
// along n. What the cube map's place does not see it cannot show: there the surface behind the edge is drawn out.
vec3 reprojected(vec3 n, vec3 offset, float texel)
{
    float across = length(offset - dot(offset, n) * n);
    float arc = min(across / view.zenith.y, MOST_PARALLAX);
    if (arc < 0.1 * texel)
        return n;
    float steps = clamp(ceil(0.2 * arc / texel), 1.0, float(REPROJECT_STEPS));
    float nearness = arc / across, shrink = nearness / steps; // 1 / distance
    float far = 0.0, before = 0.0; // distance of the surface at this step, and of that in front of which the line passed last
    vec3 m = n, last = n;
    bool met = false;
    for (float i = 0.0; i <= steps && !met; i += 1.0) {
        bool finite = i < steps; // the last step is n itself, at infinity
        vec3 line = finite ? offset + n / (nearness - i * shrink) : n;
        m = normalize(line);
        far = distance_at(place_of(m));
        met = finite ? far <= length(line) : !isinf(far);
        if (i > 0.0 && far > 1.1 * before) {
            // That surface ended between the steps: the line may have met it just before its end.
            vec3 edge = normalize(offset + dot(before * last - offset, n) * n);
            float there = distance_at(place_of(edge));
            vec3 from_eye = there * edge - offset;
            if (!isinf(there) && length(from_eye - dot(from_eye, n) * n) < 0.3 * texel * there) {
                m = edge;
                far = there;
                met = true;
            }
        }
        before = far;
        last = m;
    }
    if (!met)
        return n;
    vec3 best = m;
    float off = 1e30;
    for (int round = 0; round < REPROJECT_ROUNDS; ++round) {
        vec3 from_eye = far * m - offset;
        float along = dot(from_eye, n);
        float miss = length(from_eye - along * n) / far;
        if (miss < off)
            off = miss, best = m;
        if (along <= 0.0 || miss < 0.05 * texel)
            break;
        m = normalize(offset + along * n);
        far = distance_at(place_of(m));
        if (isinf(far)) {
            // The line passes behind what it seemed to meet, on to the sky: along n, or beside the edge that hides it there.
            if (off > 0.15 * texel)
                best = isinf(distance_at(place_of(n))) ? n : m;
            break;
        }
    }
    return best;
}

// Where the cube map holds what the ship's direction n shows: in the world, and D.
Sight sight_of(vec3 n, float pixel_angle)
{
    Sight sight = world_from_camera(n, view.boost.x, view.boost.y);
    if (!ABERRATION)
        sight.n = n;
    if (REPROJECT)
        sight.n = reprojected(sight.n, eye_offset(n), ABERRATION ? sight.D * pixel_angle : pixel_angle);
    return sight;
}

// Scene-linear light, pre-exposed by the cube map's factor.
vec3 light_seen(Place place, float D, float pixel_angle)
{
    vec3 light = cube_map(place, ABERRATION ? D * pixel_angle : pixel_angle);
    if (DOPPLER)
        light = doppler_shifted(light, D);
    if (HEADLIGHT)
        light *= headlight(D);
    return light;
}
