// A ship's motion under constant proper acceleration, in closed form, and the events of its eyes. c = 1.

struct ThrustSegment {
    rvec3 du; // change of the proper velocity
    rvec3 dx; // way in the world
    real dt;  // world time that passes
};

// sinh(x)/x and (cosh(x) - 1)/x without cancellation: below 1 the series, whose first dropped term is under 1e-17. It
// reaches that far because a GPU may form sinh(x) as (e^x - e^-x)/2, which at 0.02 is wrong in the fifth digit of a float.
FN real sinh_ratio(real x)
{
    if (abs(x) >= real(1.0))
        return sinh(x) / x;
    real s = x * x;
    real sum = real(1.0) + s / real(272.0);
    sum = real(1.0) + s / real(210.0) * sum;
    sum = real(1.0) + s / real(156.0) * sum;
    sum = real(1.0) + s / real(110.0) * sum;
    sum = real(1.0) + s / real(72.0) * sum;
    sum = real(1.0) + s / real(42.0) * sum;
    sum = real(1.0) + s / real(20.0) * sum;
    return real(1.0) + s / real(6.0) * sum;
}
FN real cosh_less_one_ratio(real x)
{
    real half_ratio = sinh_ratio(real(0.5) * x);
    return real(0.5) * x * half_ratio * half_ratio;
}

// The motion for a time dtau of the ship's under proper acceleration `strength` along the unit vector `way` (ship's frame,
// axes carried by the pure boost; it keeps its place among gyroscopes). It is hyperbolic motion in the plane of (1, u) and
// the boosted way: U(tau) = U cosh + A sinh, exact for any step.
FN ThrustSegment thrust_segment(rvec3 u, rvec3 way, real strength, real dtau)
{
    real gamma = gamma_of(u);
    real angle = strength * dtau;
    real along = dot(u, way);
    rvec3 A = way + u * (along / (real(1.0) + gamma));
    real s = sinh_ratio(angle);
    real c = cosh_less_one_ratio(angle);
    ThrustSegment leg;
    leg.du = (u * c + A * s) * angle;
    leg.dx = (u * s + A * c) * dtau;
    leg.dt = (gamma * s + along * c) * dtau;
    return leg;
}

// The event of an eye at `offset` (ship's frame), simultaneous in that frame with the ship's own event: its time and its
// place in the world, from the ship's event. Two eyes differ in time as well as in place.
FN real eye_time(rvec3 u, rvec3 offset) { return dot(u, offset); }
FN rvec3 eye_place(rvec3 u, rvec3 offset) { return world_place(u, real(0.0), offset); }
