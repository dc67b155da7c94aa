// The retarded position of a point that moves uniformly (Lienard and Wiechert). c = 1.

struct RetardedPosition {
    real tau;    // its own retarded time, from its place at the observer's time on: never above 0
    rvec3 place; // its retarded position, from the observer
    real delay;  // the light's travel time: the length of `place`
    real D;      // Doppler factor, observer over source
};

// r: its place from the observer at the observer's time; way: unit direction of its motion; u: gamma beta along it; gamma =
// sqrt(1 + u^2). A float keeps 1e-6 of all times at any gamma where `way` is one of the axes. Elsewhere it keeps 1e-7
// gamma, because r's component along the motion is no more accurate. The point was at r + u tau at gamma tau, and that
// event lies on the past light cone: tau^2 - 2 (r.u) tau - r^2 = 0. The formula is the earlier root, in the form that does
// not cancel. 1 - v^2 is never formed. D = delay / (k.U), with k the light's way and U the source's 4-velocity; k.U is the
// square root.
FN RetardedPosition retarded_position(rvec3 r, rvec3 way, real u, real gamma)
{
    real along = dot(r, way) * u;
    real square = dot(r, r);
    real root = sqrt(along * along + square);
    RetardedPosition s;
    s.tau = along > real(0.0) ? -square / (along + root) : along - root;
    s.place = r + way * (u * s.tau);
    s.delay = -gamma * s.tau;
    s.D = s.delay / root;
    return s;
}
