// The northern and southern lights: two ovals around the geomagnetic poles, each of an outer and an inner arc that fold and
// change along their way, with a dim veil around them. Where an arc runs is invented; sizes, heights and brightness are those
// of real ones (docs/physics/solar-system.md). Needs detail.glsl.

const real AURORA_RADIUS = real(0.36); // of an oval, radians: 20.6 degrees
const real AURORA_WIDTH = real(0.0035); // of an arc, radians: 22 km
const real AURORA_REACH = real(0.16); // the greatest distance of light from the oval, radians

// A place among the arcs: its distances from the outer and from the inner one, radians, and their strength there.
struct AuroraPlace {
    real outer, inner, strength;
};
// up: direction from the globe's middle, own axes, unit; centre: of the oval on that half, unit.
FN AuroraPlace aurora_place(rvec3 up, rvec3 centre)
{
    AuroraPlace at;
    real off = acos(min(dot(up, centre), real(1.0))) - AURORA_RADIUS;
    at.outer = off, at.inner = off + real(0.045), at.strength = real(0.0);
    if (abs(off) > AURORA_REACH)
        return at;
    rvec4 wide = detail_octave(up * real(7.0), rvec3(real(0.0))), folds = detail_octave(up * real(38.0), rvec3(real(0.0)));
    at.outer -= real(0.06) * wide.x + real(0.014) * folds.x;
    at.inner = at.outer + real(0.045) + real(0.02) * folds.y;
    at.strength = max(real(0.55) + real(0.9) * wide.y, real(0.05));
    return at;
}

// The width of a pixel with the drift of what shines. Atoms that shine red were hit 110 s before, in which winds of 500 m/s carry
// them on. height: above the ground, radii.
FN real aurora_pixel(real pixel, real height)
{
    real drift = min(max(height - real(0.02), real(0.0)), real(0.01));
    return sqrt(pixel * pixel + drift * drift);
}

// The rays of the outer arc: the factor of its light, of the mean 1. pixel: a pixel's width there, radians.
FN real aurora_rays(rvec3 up, real pixel)
{
    real seen = max(real(1.0) - pixel * real(300.0), real(0.0));
    return seen > real(0.0) ? real(1.0) + real(0.9) * seen * detail_octave(up * real(300.0), rvec3(real(0.0))).x : real(1.0);
}

// The mean light of an arc on a way between two distances from it, over that at its middle.
FN real aurora_arc(real from, real to, real width)
{
    real low = tanh(from / width), high = tanh(to / width);
    if (abs(to - from) < real(0.02) * width)
        return real(1.0) - low * high;
    return width * (high - low) / (to - from);
}

// The mean light of a column on a way between two places, over that of a full arc's column. A pixel that is wider than an arc
// has the arc's mean.
FN real aurora(AuroraPlace from, AuroraPlace to, real rays, real pixel)
{
    real width = sqrt(AURORA_WIDTH * AURORA_WIDTH + pixel * pixel), middle = real(0.5) * (from.outer + to.outer);
    real arcs = rays * aurora_arc(from.outer, to.outer, width) + real(0.5) * aurora_arc(from.inner, to.inner, width);
    real veil = real(0.08) * exp(-middle * middle / real(0.0012));
    return real(0.5) * (from.strength + to.strength) * (AURORA_WIDTH / width * arcs + veil);
}
