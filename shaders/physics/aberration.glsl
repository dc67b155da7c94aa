// Aberration and the Doppler factor of one line of sight, in axes whose z is the direction of motion.
// n: unit direction from the observer towards the source. D = f_camera / f_world, above 1 is blue.

struct AberratedRay {
    rvec3 n; // unit direction towards the source in the other frame
    real D;  // Doppler factor
};

// cos^2 (x) and sin^2 (y) of half the angle between v and the z axis, times v's length, each without cancellation.
FN rvec2 half_angle_squares(rvec3 v, real length_)
{
    real across = v.x * v.x + v.y * v.y;
    real large = real(0.5) * (length_ + abs(v.z));
    real small = real(0.25) * across / large;
    return v.z >= real(0.0) ? rvec2(large, small) : rvec2(small, large);
}

// A vector of any length towards the source in the other frame. Much needs no unit direction, and of D its logarithm alone.
struct AberratedVector {
    rvec3 v;
    real length_; // of v: the length of the camera's vector, over D
};

// The world's vector of the camera's vector v. E = e^rapidity >= 1 and inverse_E = 1/E. tan(theta_w / 2) = E tan(theta_c / 2),
// written in the half angles' squares: no acos, no gamma, and one division.
FN AberratedVector world_vector_from_camera(rvec3 v, real length_, real E, real inverse_E)
{
    rvec2 h = half_angle_squares(v, length_);
    real A = h.x * inverse_E;
    real B = h.y * E;
    AberratedVector there;
    there.v = rvec3(v.x, v.y, A - B);
    there.length_ = A + B;
    return there;
}

// The world's unit direction and D of the camera's unit direction n. At rest (E = 1) it is the identity to the bit.
FN AberratedRay world_from_camera(rvec3 n, real E, real inverse_E)
{
    AberratedRay sight;
    sight.n = n;
    sight.D = real(1.0);
    if (E != real(1.0)) {
        AberratedVector there = world_vector_from_camera(n, real(1.0), E, inverse_E);
        sight.D = real(1.0) / there.length_;
        sight.n = there.v * sight.D;
    }
    return sight;
}

// The camera's direction towards the world's direction n: the same formula with E and 1/E exchanged.
FN AberratedRay camera_from_world(rvec3 n, real E, real inverse_E)
{
    AberratedRay sight = world_from_camera(n, inverse_E, E);
    if (E != real(1.0)) {
        rvec2 h = half_angle_squares(n, real(1.0));
        sight.D = h.x * E + h.y * inverse_E;
    }
    return sight;
}

// Cosine of the camera's angle from the motion at which nothing is shifted (D = 1): (gamma - 1) / (gamma beta),
// the paper's theta_0, which is tanh(rapidity / 2). 90 degrees in the limit of rest.
FN real unshifted_cosine(real E) { return (E - real(1.0)) / (E + real(1.0)); }

// The headlight effect of the paper: photon radiance, and spectral radiance per frequency, grow as D^3.
FN real headlight(real D) { return D * D * D; }
