// The colours of a scale from near (0) to far (1): bright yellow over green to deep violet, even in lightness, so that it
// reads the same to most people with another colour vision. After viridis (Smith and van der Walt 2015), linear light.
vec3 scale_colour(float t)
{
    const vec3 steps[7] = vec3[7](vec3(0.983, 0.799, 0.018), vec3(0.411, 0.638, 0.093), vec3(0.060, 0.462, 0.184),
        vec3(0.014, 0.280, 0.263), vec3(0.029, 0.145, 0.268), vec3(0.059, 0.042, 0.207), vec3(0.058, 0.002, 0.089));
    float at = clamp(t, 0.0, 1.0) * 5.9999;
    int i = int(at);
    return mix(steps[i], steps[i + 1], at - float(i));
}
