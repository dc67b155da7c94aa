#include "flight.h"
#include "physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double half_pi = 1.57079632679489662;

double rapidity(const Ship& ship) { return std::asinh(glm::length(ship.u.total())); }

/// Rapidity that may still be gained along the nose before the limit; turning at the limit stays possible.
double room(const Ship& ship, const glm::dvec3& nose)
{
    glm::dvec3 u = ship.u.total();
    return glm::dot(u, nose) > 0 ? std::max(0.0, greatest_rapidity - rapidity(ship)) : greatest_rapidity;
}

} // namespace

Flight flight_at(const Shot& start)
{
    Flight flight;
    flight.ship = ship_at(start);
    flight.effects = start.effects;
    flight.exposure_ev = start.exposure_ev;
    return flight;
}

Flight step(Flight flight, const Controls& controls, double dt_s, double seconds_per_time_unit, const Shot& start)
{
    if (controls.reset) {
        bool hud = flight.hud;
        flight = flight_at(start);
        flight.hud = hud;
        return flight;
    }
    flight.effects.aberration ^= controls.aberration;
    flight.effects.doppler ^= controls.doppler;
    flight.effects.headlight ^= controls.headlight;
    flight.hud ^= controls.hud;
    flight.exposure_ev = std::clamp(flight.exposure_ev + controls.exposure * exposure_ev_per_s * dt_s, -60.0, 60.0);
    flight.look_rad = controls.look_ahead ? glm::dvec2(0) : flight.look_rad + controls.look_rad;
    flight.look_rad.y = std::clamp(flight.look_rad.y, -half_pi, half_pi);
    if (controls.stop) {
        flight.ship = stopped(flight.ship);
        flight.faster = 0;
        flight.held_back = true;
    }
    flight.held_back = flight.held_back && controls.faster != 0;

    double follow = 1 - std::exp(-dt_s / ease_s);
    double wanted = flight.held_back ? 0 : controls.faster * rapidity_per_s;
    flight.faster += follow * (wanted - flight.faster);
    if (wanted == 0 && std::abs(flight.faster) < 1e-3)
        flight.faster = 0;
    flight.turn_rad_s += follow * (controls.turn * turn_rad_per_s - flight.turn_rad_s);

    double gain = flight.faster * dt_s; // of rapidity
    glm::dvec3 way(0, 0, -1); // cockpit axes
    if (gain > 0) {
        gain = std::min(gain, room(flight.ship, flight.ship.ship_from_cockpit * way));
    } else if (gain < 0) {
        double left = rapidity(flight.ship);
        if (left <= -gain) {
            flight.ship = stopped(flight.ship);
            gain = 0;
        } else {
            way = glm::inverse(flight.ship.ship_from_cockpit) * glm::normalize(flight.ship.u.total());
        }
    }
    double dtau = dt_s / seconds_per_time_unit;
    if (dtau > 0)
        flight.ship = fly(flight.ship, way * (gain / dtau), flight.turn_rad_s * dt_s, dtau);
    return flight;
}

Shot shot_of(const Flight& flight, const std::string& scene)
{
    Shot shot = shot_of(flight.ship);
    shot.scene = scene;
    shot.effects = flight.effects;
    shot.exposure_ev = flight.exposure_ev;
    shot.ship_from_cockpit = flight.ship.ship_from_cockpit * glm::angleAxis(flight.look_rad.x, glm::dvec3(0, 1, 0))
        * glm::angleAxis(flight.look_rad.y, glm::dvec3(1, 0, 0));
    return shot;
}

} // namespace starbow
