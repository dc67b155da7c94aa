// When the light of a surface's points left that an eye gets at one moment. Places are from the eye.

/// How late light leaves a place, in scene time, but for a constant: for steps from one pixel to the next. A device that works
/// out steps alone does not read buffers there, so they must not depend on `reference`.
float lateness(vec3 place) { return -length(place); }

/// lateness(place) - lateness(reference.xyz), without the difference of two large numbers. reference.w: its distance.
float later(vec3 place, vec4 reference)
{
    return -dot(place - reference.xyz, place + reference.xyz) / (length(place) + reference.w);
}
