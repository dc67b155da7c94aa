// Noise of up to half a step of 8 bits either way: the bytes' local mean is the wanted value, however slowly it rises.
// The noise is uniform, so that black stays black, and the same in every frame. It is the plane's most even additive
// recurrence (Roberts 2018) in whole numbers, the same on every device. Each colour gets a different third of the
// sequence, so that a grey's brightness wavers less.
vec3 dither(ivec2 pixel)
{
    uint n = uint(pixel.x) * 3242174889u + uint(pixel.y) * 2447445414u; // 2^32 / 1.32472, 2^32 / 1.32472^2
    uvec3 of_channel = uvec3(n, n + 0x55555555u, n + 0xaaaaaaaau) >> 8u;
    // Slightly less than half, because a device's own rounding may be off by as much.
    return (vec3(of_channel) * (1.0 / 16777216.0) - 0.5) * (0.96 / 255.0);
}

// Noise for a target that encodes by sRGB's curve. That curve's slope, within 5 %, is 2.4 / 1.055 times the light to the
// power 1.4 / 2.4; a float's bits, read as a whole number, rise nearly as its logarithm.
vec3 dithered_srgb(vec3 light, ivec2 pixel)
{
    vec3 power = intBitsToFloat(ivec3(vec3(floatBitsToInt(light)) * (1.4 / 2.4) + 453659763.0));
    vec3 slope = max(power, vec3(1.0 / 12.92));
    // Below a tenth of the first step the noise fades: some devices round 0.45 of a step up, and black must stay black.
    vec3 fade = min(light * (10.0 * 255.0 * 12.92), vec3(1.0));
    return light + dither(pixel) * slope * fade;
}
