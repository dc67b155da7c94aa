// The Sun's surface seen from near: granules, spots and faculae. Nobody measured these: they lie where a hash places them, with
// sizes and contrasts of real ones (docs/physics/solar-system.md). Needs detail.glsl.

const real GRANULE_CELLS = real(500.0); // of the noise to a radius: of 1,390 km
const real GRANULE_CONTRAST = real(0.14); // standard deviation over the mean, at the disc's middle
const real SPOT_SECTORS = real(12.0); // of the longitude; each has one group or none on either side of the equator
const real FACULAE_REACH = real(0.13); // from a group's middle, radians; less than to the sector's edge

// The part of a noise's strength that a pixel shows: none where it is half as wide as a cell, all where it is a quarter as wide.
// Lanes and bends are narrower than cells. fineness: -1 - log2 of the pixel's width, radii.
FN real sun_seen(real cells, real fineness) { return min(max(fineness - log2(cells), real(0.0)), real(1.0)); }

FN rvec4 sun_noise(rvec3 at, real cells, real fineness)
{
    return sun_seen(cells, fineness) * detail_octave(at * cells, rvec3(real(0.0)));
}

// The part of light that a spot leaves. off: from its middle; pixel: both in radii of the Sun.
FN real sun_spot(rvec2 off, real radius, real pixel)
{
    real distance = length(off), soft = max(pixel, real(0.12) * radius);
    real shown = min(real(1.0), real(4.0) * radius * radius / (pixel * pixel)); // of a spot smaller than a pixel
    real penumbra = min(max(real(0.5) + (radius - distance) / soft, real(0.0)), real(1.0));
    real umbra = min(max(real(0.5) + (real(0.42) * radius - distance) / soft, real(0.0)), real(1.0));
    return real(1.0) - shown * (real(0.2) * penumbra + real(0.55) * umbra);
}

// The factor of the mean surface's light. at: unit, the Sun's own axes, z to its north pole; pixel: its width there, radii; mu:
// cosine of the ray's angle from the vertical.
FN real sun_surface(rvec3 at, real pixel, real mu)
{
    real light = real(1.0), fineness = real(-1.0) - log2(pixel), granules = sun_seen(GRANULE_CELLS, fineness);
    if (granules > real(0.0)) {
        // Dark lanes where either field is 0. `bright` has the mean 0.414 and the standard deviation 0.204.
        rvec4 field = detail_octave(at * GRANULE_CELLS, rvec3(real(0.0)));
        real least = min(abs(field.x), abs(field.y)), bright = least / (least + real(0.2));
        light += granules * GRANULE_CONTRAST * mu * (bright - real(0.414)) / real(0.204);
    }
    real longitude = atan(at.y, at.x) * (SPOT_SECTORS / real(6.283185307179586)), sector = floor(longitude);
    uint h = detail_mixed(uint(int(sector) + (at.z > real(0.0) ? 97 : 211)));
    if ((h & 7u) > 2u || abs(at.z) > real(0.7))
        return light;
    // A group's three numbers, from 0 to 255 each. A group is small, so differences of sines are those of latitudes times `across`.
    real size = real(int(h >> 8u & 255u)), place = real(0.35) + real(0.3 / 255.0) * real(int(h >> 16u & 255u));
    real sine = real(0.16) + real(0.29 / 255.0) * real(int(h >> 24u)), across = sqrt(real(1.0) - at.z * at.z);
    rvec2 off = rvec2(
        (longitude - sector - place) * (real(6.283185307179586) / SPOT_SECTORS) * across, (abs(at.z) - sine) / across);
    rvec4 wide = sun_noise(at, real(60.0), fineness), fine = sun_noise(at, real(240.0), fineness);
    real near = max(real(1.0) - dot(off, off) / (FACULAE_REACH * FACULAE_REACH), real(0.0));
    light += real(0.5) * (real(1.0) - mu) * near * near * max(fine.x + real(0.5) * wide.y, real(0.0)); // bright at the limb
    // The greater spot leads in the rotation's direction, nearer to the equator.
    off += real(0.008) * rvec2(wide.x, wide.y) + real(0.004) * rvec2(fine.x, fine.y);
    real radius = real(0.012) + real(0.024 / 65025.0) * size * size;
    light *= sun_spot(off - rvec2(real(0.05), real(-0.01)), radius, pixel);
    light *= sun_spot(off - rvec2(real(-0.045), real(0.012)), real(0.7) * radius, pixel);
    light *= sun_spot(off - rvec2(real(-0.012), real(0.006)), real(0.3) * radius, pixel);
    return light;
}
