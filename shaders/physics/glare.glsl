// An eye's or a camera's glare: light of a point that is scattered around it, per steradian. CIE 146:2002, equation for small
// angles (0.1 to 30 degrees), of an observer of 35 years: 10 / angle^3 + 5 (1 + (35 / 62.5)^4) / angle^2, in degrees.

// square: of the angle and of the least angle together, degrees^2. Within the least angle the glare grows no more: light there
// belongs to the point's own spot.
FN real glare_at(real square) { return real(10.0) / (square * sqrt(square)) + real(5.4917248) / square; }

// The part of a point's light that its glare holds within an angle, above a level.
FN real glare_within(real angle, real least, real level)
{
    const real square_degree = real(3.0461742e-4); // steradians
    real far = sqrt(angle * angle + least * least);
    return square_degree * real(3.14159265)
        * (real(20.0) * (real(1.0) / least - real(1.0) / far) + real(10.9834496) * log(far / least) - level * angle * angle);
}

// The angle at which the glare has fallen to a level.
FN real glare_end(real level)
{
    real x = pow(real(0.1) * level, real(1.0) / real(3.0)); // its inverse; Newton's method from above
    for (int i = 0; i < 4; ++i)
        x -= (real(10.0) * x * x * x + real(5.4917248) * x * x - level) / (real(30.0) * x * x + real(10.9834496) * x);
    return real(1.0) / x;
}

// The part of glare that is shown at an angle where it fades out up to another one, without a break in its slope.
FN real glare_fade(real angle, real most)
{
    real left = max(real(1.0) - angle * angle / (most * most), real(0.0));
    return left * left;
}
