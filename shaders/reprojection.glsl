// The cube map seen from an eye that is not where it was drawn. Needs received_light.glsl.

#ifdef OWN_EYE
vec3 eye_offset(vec3 n, RestFrameView rest_frame) { return vec3(0.0); }
vec3 reprojected(vec3 n, vec3 offset, float texel, RestFrameView rest_frame) { return n; }
#else

// The eye's place from the cube map's, in the frame at rest, in the cube map's axes. n: the ship's direction, motion axes.
vec3 eye_offset(vec3 n, RestFrameView rest_frame)
{
    if (!TURNING)
        return rest_frame.eye.xyz;
    vec3 right = cross(n, rest_frame.eye.xyz); // as long as the sine of the angle from the zenith
    vec3 offset = right * (rest_frame.eye.w / max(length(right), view.zenith.x));
    offset.z *= 0.5 * (rest_frame.E.x + rest_frame.E.y); // simultaneous in the ship: stretched by gamma in the world
    return in_cube_axes(offset, rest_frame);
}

// Finds the place of the cube map that an eye beside the cube map's own sees along n (world). Seen from the cube map's
// place, the eye's line of sight is an arc from the nearest possible surface to n at infinity. The eye sees the first
// place on it where the cube map's surface is no farther than the line. The search goes in steps of about five texels
// (even in 1 / distance, as parallax is). If a surface ends between two steps, it also tests the surface's end. It then
// approximates P = d(m) m with P - offset along n. The cube map has no surfaces that are hidden from its place: there the
// surface behind the edge is stretched.
vec3 reprojected(vec3 n, vec3 offset, float texel, RestFrameView rest_frame)
{
    float across = length(offset - dot(offset, n) * n);
    float arc = min(across / rest_frame.nearest, MOST_PARALLAX);
    if (arc < 0.1 * texel)
        return n;
    float steps = clamp(ceil(0.2 * arc / texel), 1.0, float(REPROJECT_STEPS));
    float nearness = arc / across, shrink = nearness / steps; // in 1 / distance
    float far = 0.0, before = 0.0; // distance of the surface at this step, and of the last surface behind the line
    vec3 m = n, last = n;
    bool met = false;
    for (float i = 0.0; i <= steps && !met; i += 1.0) {
        bool finite = i < steps; // the last step is n itself, at infinity
        vec3 line = finite ? offset + n / (nearness - i * shrink) : n;
        m = normalize(line);
        far = distance_at(place_of(m, rest_frame));
        met = finite ? far <= length(line) : !is_sky(far);
        if (i > 0.0 && far > 1.1 * before) {
            // That surface ended between the steps; the line may have met it just before its end.
            vec3 edge = normalize(offset + dot(before * last - offset, n) * n);
            float there = distance_at(place_of(edge, rest_frame));
            vec3 from_eye = there * edge - offset;
            if (!is_sky(there) && length(from_eye - dot(from_eye, n) * n) < 0.3 * texel * there) {
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
        far = distance_at(place_of(m, rest_frame));
        if (is_sky(far)) {
            // The line passes behind its apparent hit to the sky: along n, or beside the edge that hides the sky there.
            if (off > 0.15 * texel)
                best = is_sky(distance_at(place_of(n, rest_frame))) ? n : m;
            break;
        }
    }
    return best;
}
#endif
