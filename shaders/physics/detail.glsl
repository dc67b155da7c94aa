// Detail that a globe's maps are too coarse for. It is not measured: sums of octaves of value noise, each half as wide as
// the one before (Perlin, "An image synthesizer", 1985). They keep each map's mean, because the noise has the mean 0 and the
// variance 1 over the ground. The first sum is that of clouds. Its widest octaves are weak, because clouds as wide as a texel
// are in the map: the map's part of clouds is thin or broken cloud, which looks grey from afar.

const int DETAIL_MOST = 9; // octaves
const int DETAIL_CLOUD_PEAK = 4; // the clouds' strongest octave, as wide as a sixteenth of a texel
const rvec2 DETAIL_FIRST = rvec2(real(0.23877), real(0.78461)); // strengths of the first octave; all have the variance 1
const real DETAIL_GAIN = real(0.62); // of an octave over the one before
const real DETAIL_CLOUD_RISE = real(1.24); // the same of clouds up to their peak
// The standard deviation of an octave: of the cells' corners 1/3, and between them (26/35)^3 of that.
const real DETAIL_SPREAD = real(0.36965);
const real DETAIL_LEFT = real(0.12); // the variance that stays hidden, however near the eye is: an edge's softness

// Two fields at a place, the clouds' and the ground's.
struct Detail {
    rvec2 value; // each with the mean 0, and a variance that grows to 1 with the octaves
    rvec2 slope; // its change along a vector
    rvec2 variance; // of the octaves that are seen
};

FN uint detail_mixed(uint h)
{
    h = (h ^ (h >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}
// Both fields at a corner of a cell, 0 to 65535.
FN rvec2 detail_corner(uint h)
{
    uint mixed = detail_mixed(h);
    return rvec2(real(int(mixed & 0xffffu)), real(int(mixed >> 16u)));
}

// One octave: the fields at p, -1 to 1, and their change along the vector. Cells have the width 1.
FN rvec4 detail_octave(rvec3 p, rvec3 along)
{
    rvec3 low = floor(p), f = p - low;
    rvec3 u = f * f * (real(3.0) - real(2.0) * f), d = real(6.0) * f * (real(1.0) - f) * along;
    uint x0 = uint(int(low.x)) * 0x8da6b343u, y0 = uint(int(low.y)) * 0xd8163841u, z0 = uint(int(low.z)) * 0xcb1ab31fu;
    uint x1 = x0 + 0x8da6b343u, y1 = y0 + 0xd8163841u, z1 = z0 + 0xcb1ab31fu;
    uint near0 = y0 ^ z0, near1 = y1 ^ z0, far0 = y0 ^ z1, far1 = y1 ^ z1;
    rvec2 a = detail_corner(x0 ^ near0), b = detail_corner(x0 ^ near1), c = detail_corner(x0 ^ far0),
          e = detail_corner(x0 ^ far1);
    rvec2 da = detail_corner(x1 ^ near0) - a, db = detail_corner(x1 ^ near1) - b, dc = detail_corner(x1 ^ far0) - c,
          de = detail_corner(x1 ^ far1) - e;
    a += u.x * da, b += u.x * db, c += u.x * dc, e += u.x * de; // across the cell in x
    da *= d.x, db *= d.x, dc *= d.x, de *= d.x;
    da += u.y * (db - da) + d.y * (b - a), dc += u.y * (de - dc) + d.y * (e - c); // in y
    a += u.y * (b - a), c += u.y * (e - c);
    da += u.z * (dc - da) + d.z * (c - a), a += u.z * (c - a); // in z
    const real scale = real(2.0 / 65535.0);
    return rvec4(a.x * scale - real(1.0), a.y * scale - real(1.0), da.x * scale, da.y * scale);
}

FN rvec3 detail_turned(rvec3 p)
{
    return rvec3(real(1.6) * p.y - real(1.2) * p.z, real(1.2) * p.y + real(1.6) * p.z, real(2.0) * p.x);
}

// The fields at a place. p: in cells of the first octave; along: a vector in the same axes and unit; octaves: how many are
// wider than a pixel; the last one counts in part.
FN Detail detail_at(rvec3 p, rvec3 along, real octaves)
{
    Detail all;
    all.value = rvec2(real(0.0)), all.slope = rvec2(real(0.0)), all.variance = rvec2(real(0.0));
    rvec2 strength = DETAIL_FIRST;
    for (int i = 0; i < DETAIL_MOST && real(i) < octaves; ++i) {
        rvec2 part = strength * min(octaves - real(i), real(1.0));
        rvec4 here = detail_octave(p, along);
        all.value += part * rvec2(here.x, here.y);
        all.slope += part * rvec2(here.z, here.w);
        all.variance += part * part;
        strength *= rvec2(i < DETAIL_CLOUD_PEAK ? DETAIL_CLOUD_RISE : DETAIL_GAIN, DETAIL_GAIN);
        // Twice as fine, and turned, so that the cells' sides lie elsewhere.
        rvec3 q = detail_turned(p);
        p = rvec3(q.x + real(17.3), q.y + real(5.9), q.z + real(9.7));
        along = detail_turned(along);
    }
    all.value *= real(1.0) / DETAIL_SPREAD, all.slope *= real(1.0) / DETAIL_SPREAD;
    return all;
}

// The part of a pixel that is covered, where a map says that `part` of the place around is. A place is covered where a field
// is above a level; the octaves that are too fine for the pixel are a normal distribution around those that are seen. Its
// integral is taken as a logistic curve (within 0.01; Bowling and others 2009).
FN real detail_cover(real part, real value, real variance)
{
    real inside = min(max(part, real(1e-4)), real(1.0 - 1e-4));
    real seen = real(1.0) - variance * (real(1.0) - DETAIL_LEFT);
    real level = log(inside / (real(1.0) - inside)) + real(1.702) * sqrt(real(1.0) - DETAIL_LEFT) * value;
    return real(1.0) / (real(1.0) + exp(-level / sqrt(seen)));
}

// The factor of light that gathers in spots, of the mean 1. strength: the standard deviation of its logarithm.
FN real detail_spots(real value, real variance, real strength)
{
    return exp(strength * value - real(0.5) * strength * strength * variance);
}

// A slope without the steepest parts. relief: the height's standard deviation over the first octave's cell.
FN real detail_slope(real slope, real relief)
{
    real whole = slope * relief;
    return whole / (real(1.0) + real(2.0) * abs(whole));
}
