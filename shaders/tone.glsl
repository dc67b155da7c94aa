// Scene-linear light to what a screen can show, 0 to 1, still linear: straight up to `knee`, then a shoulder that reaches 1
// only at infinity, desaturating on its way so that the brightest light of any hue ends white.
vec3 tone_map(vec3 light)
{
    const float knee = 0.76;
    float peak = max(light.r, max(light.g, light.b));
    float above = max(peak - knee, 0.0);
    float shown = min(peak, knee) + (1.0 - knee) * above / (above + 1.0 - knee);
    float white = above / (above + 8.0);
    return mix(light * (shown / max(peak, 1e-30)), vec3(shown), white);
}
