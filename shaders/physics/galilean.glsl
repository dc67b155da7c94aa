// The picture that would follow if velocities simply added (light at 1 in the world, and its velocity less the ship's on
// board): Bradley's aberration. For comparison only. Axes whose z is the motion; beta = (E - 1/E) / (E + 1/E).

FN real galilean_beta(real E, real inverse_E) { return (E - inverse_E) / (E + inverse_E); }

// The speed on board of light that comes from the camera's direction n (x): |n x - beta z| = 1. y: the root in that
// formula; x = y + beta n.z.
FN rvec2 galilean_speed(rvec3 n, real E, real inverse_E)
{
    real gamma_inverse = real(2.0) / (E + inverse_E);
    real along = galilean_beta(E, inverse_E) * n.z;
    real root = sqrt(along * along + gamma_inverse * gamma_inverse);
    // This form does not cancel where along < 0.
    real speed = along >= real(0.0) ? along + root : gamma_inverse * gamma_inverse / (root - along);
    return rvec2(speed, root);
}

// The same as world_from_camera: the world's direction n_w with n along n_w + beta z, and the frequency at which a moving
// observer meets the crests.
FN AberratedRay galilean_world_from_camera(rvec3 n, real E, real inverse_E)
{
    real beta = galilean_beta(E, inverse_E);
    AberratedRay sight;
    sight.n = n * galilean_speed(n, E, inverse_E).x - rvec3(real(0.0), real(0.0), beta);
    sight.D = real(1.0) + beta * sight.n.z;
    return sight;
}

FN AberratedRay galilean_camera_from_world(rvec3 n, real E, real inverse_E)
{
    real beta = galilean_beta(E, inverse_E);
    rvec3 on_board = rvec3(n.x, n.y, n.z + beta);
    AberratedRay sight;
    sight.n = on_board / sqrt(dot(on_board, on_board));
    sight.D = real(1.0) + beta * n.z;
    return sight;
}

// The growth, in the world, of a small angle at the camera's direction n: away from the motion's axis (x) and around it
// (y). Circles do not stay circles.
FN rvec2 galilean_stretch(rvec3 n, real E, real inverse_E)
{
    rvec2 speed = galilean_speed(n, E, inverse_E);
    return rvec2(speed.x / speed.y, speed.x);
}
