// The retarded times of a surface's points for light that reaches the eye at one moment. With `now` it is the points'
// times at the ship's present, which is later ahead. Places are relative to the eye.

/// A place's light-travel offset, in scene time, up to a constant, for steps from one pixel to the next. A device that
/// computes steps separately does not read buffers there, so they must not depend on `reference`.
float light_travel_offset(vec3 place)
{
    vec4 now = cube.now[floatBitsToInt(cube.first.w)];
    return now.w > 0.0 ? dot(now.xyz, place) : -length(place);
}

/// light_travel_offset(place) - light_travel_offset(reference.xyz), without the difference of two large numbers. reference.w: its distance.
float travel_offset_from(vec3 place, vec4 reference)
{
    vec4 now = cube.now[floatBitsToInt(cube.first.w)];
    if (now.w > 0.0)
        return dot(now.xyz, place - reference.xyz);
    return -dot(place - reference.xyz, place + reference.xyz) / (length(place) + reference.w);
}
