// Boosts, composed and carried out. c = 1.
// u, w: proper velocities (gamma beta), so that no speed is ever too close to light's to be a number.

FN real gamma_of(rvec3 u) { return sqrt(real(1.0) + dot(u, u)); }

// E = e^rapidity of a speed |u| = gamma beta >= 0. The shaders receive E and 1/E, never beta.
FN real exp_rapidity(real u) { return u + sqrt(real(1.0) + u * u); }

// An event (t, x) of the frame that moves with u (axes carried by the pure boost), in the world's frame.
// Velocity addition is the same formula: the 4-velocity (gamma_w, w) is such a pair.
FN real world_time(rvec3 u, real t, rvec3 x) { return gamma_of(u) * t + dot(u, x); }
FN rvec3 world_place(rvec3 u, real t, rvec3 x)
{
    return x + (t + dot(u, x) / (real(1.0) + gamma_of(u))) * u;
}

// The proper velocity, in the world, of an object that moves with w in the frame that moves with u.
FN rvec3 composed(rvec3 u, rvec3 w) { return world_place(u, gamma_of(w), w); }

// The Thomas-Wigner turn of the same composition as a unit quaternion (x, y, z; w last): boost(u) boost(w) =
// boost(composed(u, w)) turn. From the product of the two boosts in SL(2, C); no angle is formed, so small turns stay exact.
FN rvec4 wigner_turn(rvec3 u, rvec3 w)
{
    rvec3 axis = cross(w, u);
    real scalar = (real(1.0) + gamma_of(u)) * (real(1.0) + gamma_of(w)) + dot(u, w);
    real inverse_length = real(1.0) / sqrt(dot(axis, axis) + scalar * scalar);
    return rvec4(axis * inverse_length, scalar * inverse_length);
}

// The velocity of an object that moves with u, in the frame that moves with w: boost(-w) boost(u) = boost(relative.u) turn.
// Both frames' axes are the world's, carried by pure boosts; `turn` (x, y, z; w last) leads from the axes of u to those
// that the frame of w carries there.
struct Relative {
    rvec3 u;
    rvec4 turn;
};

// From the two boosts in SL(2, C) in half rapidities: composed(-w, u) without its loss of gamma_u gamma_w roundings where
// both are great and alike. Here a loss of gamma^2 is left, and none where u = w.
FN Relative relative(rvec3 w, rvec3 u)
{
    real gamma_w = gamma_of(w), gamma_u = gamma_of(u);
    real scale = real(0.5) / sqrt((real(1.0) + gamma_w) * (real(1.0) + gamma_u)); // 1 / (4 cosh cosh) of the half rapidities
    rvec3 apart = u - w;
    // V = cosh_w sinh_u - cosh_u sinh_w, B = sinh_w x sinh_u, A = cosh cosh - sinh . sinh.
    rvec3 V = (apart * (real(1.0) + gamma_w) - w * (dot(apart, u + w) / (gamma_u + gamma_w))) * scale;
    rvec3 B = cross(w, apart) * scale;
    real A = sqrt(max(real(1.0) + dot(V, V) - dot(B, B), real(0.0)));
    Relative r;
    r.u = (V * A + cross(B, V)) * real(2.0);
    r.turn = rvec4(B, A) / sqrt(A * A + dot(B, B));
    return r;
}
