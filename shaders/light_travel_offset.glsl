// When the light of a surface's points left that an eye gets at one moment; or, where everything is shown where it is now,
// what time it is there: what is simultaneous in the ship is later ahead. Places are from the eye.

/// How late light leaves a place, in scene time, but for a constant: for steps from one pixel to the next. A device that works
/// out steps alone does not read buffers there, so they must not depend on `reference`.
float light_travel_offset(vec3 place) { return cube.now.w > 0.0 ? dot(cube.now.xyz, place) : -length(place); }

/// lateness(place) - lateness(reference.xyz), without the difference of two large numbers. reference.w: its distance.
float travel_offset_from(vec3 place, vec4 reference)
{
    if (cube.now.w > 0.0)
        return dot(cube.now.xyz, place - reference.xyz);
    return -dot(place - reference.xyz, place + reference.xyz) / (length(place) + reference.w);
}
