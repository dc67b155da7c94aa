// The tone curve: from exposed scene-linear light to a screen's range, 0 to 1, still linear Rec. 709.
// tone.h compiles it as C++ too.

// The brightest channel is linear up to the knee, then follows a shoulder, without a break in its slope, that reaches 1
// only at infinity. On the shoulder the colour approaches white along its hue's line in Oklab (Ottosson 2020), where hues
// look constant; mixed with white in linear light a blue would turn by 22 degrees. With the cube roots c of Oklab's cone
// responses that line is c + (1 - c) w. Its cube is multiplied out here, so that without w the light is unchanged and the
// roots need not be exact.
FN rvec3 tone_map(rvec3 light)
{
    const real knee = real(0.76);
    const real half_white = real(4.0); // half of the way to white above the knee
    real peak = max(light.x, max(light.y, light.z));
    real above = min(max(peak - knee, real(0.0)), real(1e15)); // its square stays finite
    real from_shoulder = above + real(1.0) - knee, from_white = above + half_white;
    real part = above / (from_shoulder * from_white); // divisions are slow without a GPU
    real shown = min(peak, knee) + (real(1.0) - knee) * part * from_white;
    real w = part * from_shoulder;
    real v = real(1.0) - w;

    rvec3 hue = light * (real(1.0) / max(peak, real(1e-30)));
    rvec3 cones = rvec3(dot(rvec3(0.4122214708, 0.5363325363, 0.0514459929), hue),
        dot(rvec3(0.2119034982, 0.6806995451, 0.1073969566), hue), dot(rvec3(0.0883024619, 0.2817188376, 0.6299787005), hue));
    rvec3 s = sqrt(cones); // from 0.226, blue's, to 1
    rvec3 c = ((s * real(0.18426305) - real(0.57889682)) * s + real(1.28624613)) * s + real(0.10874639); // s^(2/3) within 1e-3
    rvec3 mixed = c * (c * v + w) * (real(3.0) * v);
    rvec3 colour = hue * (v * v * v)
        + (rvec3(dot(rvec3(4.0767416621, -3.3077115913, 0.2309699292), mixed),
               dot(rvec3(-1.2684380046, 2.6097574011, -0.3413193965), mixed),
               dot(rvec3(-0.0041960863, -0.7034186147, 1.7076147010), mixed))
              + w * w)
            * w;
    // The line may leave the gamut by up to a tenth.
    real most = max(colour.x, max(colour.y, colour.z));
    return max(colour, rvec3(0.0)) * (shown / max(most, real(1e-30)));
}

// The part of the light that is brighter than a screen's white, or than any other level. A screen shows the rest itself.
FN rvec3 brighter_than(rvec3 light, real level)
{
    real peak = max(light.x, max(light.y, light.z));
    return light * (max(peak - level, real(0.0)) / max(peak, real(1e-30)));
}

FN real luminance_of(rvec3 light) { return dot(light, rvec3(0.2126, 0.7152, 0.0722)); } // Rec. 709

// The same where the order of luminances must stay. The curve above shows a colour by its brightest channel, so that a
// bright red is darker than a grey of its luminance. Here the shown luminance follows from the luminance alone, as a grey's
// does. The colour that the shoulder makes is darkened to it, or mixed with white up to it. Below the knee the light is
// unchanged.
FN rvec3 tone_map_in_order(rvec3 light)
{
    const real knee = real(0.76);
    real luminance = luminance_of(light);
    real above = max(luminance - knee, real(0.0));
    real wanted = min(luminance, knee) + (real(1.0) - knee) * above / (above + real(1.0) - knee);
    rvec3 colour = tone_map(light);
    real got = luminance_of(colour);
    real white = max(wanted - got, real(0.0)) / max(real(1.0) - got, real(1e-6));
    colour = colour * min(wanted / max(got, real(1e-30)), real(1.0));
    return colour + (rvec3(1.0) - colour) * white;
}
