#include "tour_motion.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The part of the ship's time that passes in a part of the step. Its rate rises and falls as 10x^3 - 15x^4 + 6x^5; this
/// is the integral.
double gone(double part, double seconds, const glm::dvec2& ease_s)
{
    const auto ramp = [](double x) { return x * x * x * x * (2.5 + x * (-3 + x)); };
    const double t = part * seconds, all = seconds - 0.5 * (ease_s.x + ease_s.y);
    const double begun = t < ease_s.x ? ease_s.x * ramp(t / ease_s.x) : t - 0.5 * ease_s.x;
    const double left = seconds - t;
    if (t >= ease_s.x && left < ease_s.y)
        return 1 - ease_s.y * ramp(left / ease_s.y) / all;
    return begun / all;
}

/// Proper velocity on the geodesic of velocity space from a to b. part: of the rapidity of b relative to a.
glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double part)
{
    const glm::dvec3 relative = physics::world_place(-a, physics::gamma_of(b), b);
    const double speed = glm::length(relative);
    if (!(speed > 0))
        return a;
    return physics::composed(a, relative / speed * std::sinh(part * std::asinh(speed)));
}

/// The world's time, in units, up to `part` of a glide that takes dtau units of the ship's time. It is the integral of
/// gamma, which is very smooth on a geodesic of eased rapidity: Gauss-Legendre with five points in each of 16 parts is
/// exact to rounding for the speeds of any scene.
double world_time(const glm::dvec3& a, const glm::dvec3& b, double part, double dtau)
{
    constexpr int parts = 16;
    constexpr double at[] = {0, 0.5384693101056831, 0.9061798459386640};
    constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    const auto gamma = [&](double x) { return physics::gamma_of(between(a, b, eased(x))); };
    double sum = 0;
    const double half = 0.5 * part / parts;
    for (int i = 0; i < parts; ++i) {
        const double middle = (2 * i + 1) * half;
        sum += weight[0] * gamma(middle);
        for (int k = 1; k < 3; ++k)
            sum += weight[k] * (gamma(middle - at[k] * half) + gamma(middle + at[k] * half));
    }
    return sum * half * dtau;
}

/// The ship after `part` of a step, from its start.
struct Motion {
    const Step& step;
    double part, run, dtau; ///< run: part of the step's ship's time; dtau: units of the ship's time so far in the step

    Ship operator()(Ship ship, const Cut&) const { return fly(ship, {}, {}, dtau); }
    Ship operator()(Ship ship, const Coast&) const { return fly(ship, {}, {}, dtau); }
    Ship operator()(Ship ship, const Try&) const { return ship; }
    Ship operator()(Ship ship, const Turning& turning) const
    {
        const glm::dquat from = ship.ship_from_cockpit;
        ship = fly(ship, {}, {}, dtau);
        ship.ship_from_cockpit = glm::normalize(glm::slerp(from, turning.ship_from_cockpit, eased(part)));
        return ship;
    }
    Ship operator()(Ship ship, const Thrust& thrust) const
    {
        const glm::dvec3 way
            = thrust.towards ? glm::inverse(ship.ship_from_cockpit) * *thrust.towards : glm::dvec3(0, 0, -1);
        const double gained = thrust.rapidity_per_s * step.seconds * step.ship_s_per_s * run;
        return fly(ship, dtau > 0 ? way * (gained / dtau) : glm::dvec3(0), {}, dtau);
    }
    Ship operator()(Ship ship, const Glide& glide) const
    {
        const double way = eased(part);
        const Ship from = ship;
        const glm::dvec3 u = from.u.total(), place = from.position.total();
        if (glide.position) {
            ship.position.add(way * (*glide.position - place));
            ship.distance.add(way * glm::distance(*glide.position, place));
        }
        if (glide.time)
            ship.time.add(way * (*glide.time - from.time.total()));
        else if (part > 0)
            ship.time.add(world_time(u, glide.u.value_or(u), part, dtau / part));
        if (glide.u)
            ship.u = Sum3(part < 1 ? between(u, *glide.u, way) : *glide.u);
        if (glide.ship_from_cockpit)
            ship.ship_from_cockpit = glm::normalize(glm::slerp(from.ship_from_cockpit, *glide.ship_from_cockpit, way));
        ship.proper_time.add(dtau);
        return ship;
    }
};

} // namespace

double eased(double x)
{
    x = std::clamp(x, 0.0, 1.0);
    return x * x * x * x * (35 + x * (-84 + x * (70 - 20 * x)));
}

Ship along(const Step& step, const Ship& start, double part, double seconds_per_time_unit)
{
    const double run = gone(part, step.seconds, step.ease_s);
    const Motion motion{step, part, run, run * step.seconds * step.ship_s_per_s / seconds_per_time_unit};
    return std::visit([&](const auto& kind) { return motion(start, kind); }, step.motion);
}

} // namespace starbow
