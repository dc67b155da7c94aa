// Blinking light, evaluated for each point at its own retarded time.

/// The part of a pixel in which the light is on. blink: of TimeEntry; later_: this point's light-travel offset; step_: its
/// steps to the right and down.
float blinking(vec4 blink, float later_, vec2 step_)
{
    float at = blink.x + later_ * blink.y;
    float w = max((abs(step_.x) + abs(step_.y)) * abs(blink.y), 1e-6); // periods from one pixel's edge to the other
    // The mean over the pixel is the integral of a function that is 1 in the part blink.z of each period.
    vec2 ends = vec2(at - 0.5 * w, at + 0.5 * w), whole = floor(ends);
    vec2 sum = whole * blink.z + min(ends - whole, vec2(blink.z));
    return clamp((sum.y - sum.x) / w, 0.0, 1.0);
}
