// An eclipse of the Sun: the overlap of two discs, of which the Sun's is darker at its limb. Its radiance at 550 nm over that of its
// middle is 1 - u1 (1 - mu) - u2 (1 - mu)^2, fitted to Neckel and Labs, Solar Physics 153 (1994), 91, within 0.4 % of the disc (rms).

// That radiance by powers of mu, the cosine at the Sun's surface: with u1 = 0.487, u2 = 0.204.
FN rvec3 sun_powers() { return rvec3(real(0.309), real(0.895), real(-0.204)); }

// The light from the limb up to mu, over pi.
FN real light_outside(real mu)
{
    rvec3 a = sun_powers();
    return mu * mu * (a.x + mu * (a.y * real(2.0) / real(3.0) + mu * a.z * real(0.5)));
}

// The part of the Sun's light that a dark disc before it leaves. disc: its radius; apart: the distance of the middles; both in radii
// of the Sun's disc. Within 0.004.
FN real left_of_sun(real disc, real apart)
{
    real inner = disc - apart; // up to here the Sun is wholly covered
    real whole = light_outside(real(1.0));
    real hidden = inner > real(0.0) ? whole - light_outside(sqrt(max(real(1.0) - inner * inner, real(0.0)))) : real(0.0);
    // Rings of the Sun that are covered in part. Both ends of an arc's length change as a root does, and so do even steps of this
    // angle at its ends.
    real low = abs(inner), high = min(apart + disc, real(1.0)), middle = real(0.5) * (low + high), reach = real(0.5) * (high - low);
    rvec3 a = sun_powers();
    // Lavapipe computes both sides of a condition, but not the rounds of a loop.
    const int most = 8;
    int steps = high > low ? most : 0;
    real c = cos(real(3.14159265358979 / 16.0)), s = sin(real(3.14159265358979 / 16.0)); // of the angle in the middle of a step
    real step_c = cos(real(3.14159265358979 / 8.0)), step_s = sin(real(3.14159265358979 / 8.0));
    for (int i = 0; i < steps; ++i) {
        real r = middle - reach * c;
        real mu = sqrt(max(real(1.0) - r * r, real(0.0)));
        real cosine = (r * r + apart * apart - disc * disc) / (real(2.0) * r * max(apart, real(1e-6)));
        real arc = acos(clamp(cosine, real(-1.0), real(1.0)));
        hidden += (a.x + mu * (a.y + mu * a.z)) * real(2.0) * r * arc * reach * s / real(most);
        real next = c * step_c - s * step_s;
        s = s * step_c + c * step_s;
        c = next;
    }
    return clamp(real(1.0) - hidden / whole, real(0.0), real(1.0));
}
