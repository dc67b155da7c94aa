// Boosts, composed and carried out. c = 1.
// u, w: proper velocities (gamma beta), so that no speed is ever too close to light's to be a number.

FN real gamma_of(rvec3 u) { return sqrt(real(1.0) + dot(u, u)); }

// E = e^rapidity of a speed |u| = gamma beta >= 0. The shaders get E and 1/E, never beta.
FN real exp_rapidity(real u) { return u + sqrt(real(1.0) + u * u); }

// An event (t, x) of the frame that moves with u (axes carried by the pure boost), in the world's frame.
// Velocity addition is the same formula: the 4-velocity (gamma_w, w) is such a pair.
FN real world_time(rvec3 u, real t, rvec3 x) { return gamma_of(u) * t + dot(u, x); }
FN rvec3 world_place(rvec3 u, real t, rvec3 x)
{
    return x + (t + dot(u, x) / (real(1.0) + gamma_of(u))) * u;
}

// Proper velocity in the world of what moves with w in the frame that moves with u.
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
