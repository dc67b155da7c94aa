// The colours of a scale from near (0) to far (1): bright yellow over green to deep violet, ever darker, so that neighbouring
// steps differ by CIEDE2000 of at least 10 to every colour vision: tests/light/false_colours_test.cpp. tone.h compiles them as C++ too.
// After viridis (Smith and van der Walt 2015), with its first two steps farther apart and its last one darker. Linear light.
FN rvec3 scale_colour(real t)
{
    const rvec3 steps[7] = {rvec3(0.990, 0.860, 0.030), rvec3(0.370, 0.580, 0.075), rvec3(0.055, 0.440, 0.150),
        rvec3(0.012, 0.255, 0.260), rvec3(0.029, 0.135, 0.268), rvec3(0.055, 0.037, 0.200), rvec3(0.040, 0.001, 0.055)};
    real at = clamp(t, real(0.0), real(1.0)) * real(5.9999);
    int i = int(at);
    return mix(steps[i], steps[i + 1], at - real(i));
}
