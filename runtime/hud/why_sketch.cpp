#include "why_sketch.h"
#include "hud.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace starbow {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rays = 24;
constexpr double from_radius = 1, to_radius = 0.2; ///< of the light's rays, around the ship
constexpr double light_per_s = 0.35; ///< of the square's half side: light's speed in the sketch

double part_of(double x) { return x - std::floor(x); }

/// A direction at an angle from straight up, to the right.
glm::dvec2 at_angle(double angle) { return {std::sin(angle), std::cos(angle)}; }

void add_ship(std::vector<Stroke>& strokes)
{
    const glm::dvec2 nose(0, 0.13), left(-0.08, -0.1), right(0.08, -0.1), tail(0, -0.05);
    for (const auto& [a, b] : {std::pair(nose, left), {nose, right}, {left, tail}, {right, tail}})
        strokes.push_back({a, b, 0.03, 1});
}

void add_circle(std::vector<Stroke>& strokes, const glm::dvec2& middle, double radius, double width, double strength)
{
    constexpr int sides = 20;
    for (int i = 0; i < sides; ++i)
        strokes.push_back({middle + radius * at_angle(2 * pi * i / sides),
            middle + radius * at_angle(2 * pi * (i + 1) / sides), width, strength});
}

/// Light from a world direction, as it reaches the ship.
struct Arriving {
    double angle; ///< from the motion, as seen
    double D;
};
Arriving arriving(double world_angle, double E)
{
    const physics::AberratedRay ray
        = physics::camera_from_world({std::sin(world_angle), 0, std::cos(world_angle)}, E, 1 / E);
    return {std::atan2(ray.n.x, ray.n.z), ray.D};
}

std::vector<Stroke> light_around(Why why, double E, double t_s)
{
    std::vector<Stroke> strokes;
    for (int i = 0; i < rays; ++i) {
        const Arriving light = arriving(2 * pi * (i + 0.5) / rays, E);
        const glm::dvec2 way = at_angle(light.angle), across(way.y, -way.x);
        if (why == Why::headlight) {
            // All light together goes with D^4 for each part of the sky.
            const double bright = std::pow(light.D, 4);
            strokes.push_back({from_radius * way, to_radius * way, std::clamp(0.02 * std::sqrt(bright), 0.006, 0.12),
                std::clamp(bright, 0.12, 1.0)});
            continue;
        }
        strokes.push_back({from_radius * way, to_radius * way, 0.012, why == Why::doppler ? 0.25 : 0.5});
        // Crests come in; the aberration page has one pulse for every three crests.
        const double apart = (why == Why::doppler ? 0.16 : 0.48) / (why == Why::doppler ? light.D : 1);
        const double first = apart * part_of(-light_per_s * t_s / apart);
        for (double r = to_radius + first; r < from_radius && apart > 0.02; r += apart) {
            const double half = why == Why::doppler ? 0.05 : 0.02;
            strokes.push_back({r * way - half * across, r * way + half * across, why == Why::doppler ? 0.014 : 0.035, 1});
        }
        if (why == Why::doppler && apart <= 0.02) // too close to be distinguished
            strokes.push_back({from_radius * way, to_radius * way, 0.09, 0.9});
    }
    add_ship(strokes);
    return strokes;
}

/// In the ship's frame a thing flies past, down on the right. Its light needs its time to the ship.
std::vector<Stroke> late_light(double beta, double t_s)
{
    std::vector<Stroke> strokes;
    constexpr double aside = 0.55, top = 1.6;
    const double speed = beta * light_per_s;
    const double now_y = speed > 1e-3 ? top - part_of(speed * t_s / (2 * top)) * 2 * top : 0.4;
    const auto thing = [&](double before_s) { return glm::dvec2(aside, now_y + speed * before_s); };
    // The retarded position: light that left it `age` ago reaches the ship now.
    double age = 0;
    for (int i = 0; i < 60; ++i)
        age = glm::length(thing(age)) / light_per_s;
    const glm::dvec2 seen = thing(age), now = thing(0);
    add_circle(strokes, seen, 0.1, 0.03, 1);
    for (double r = 0.02; r < 0.1; r += 0.03)
        add_circle(strokes, now, r, 0.035, 0.55);
    strokes.push_back({now, seen, 0.01, 0.35});
    const double way = glm::length(seen);
    for (double r = part_of(-light_per_s * t_s / 0.2) * 0.2; r < way; r += 0.2)
        if (r > to_radius)
            strokes.push_back({seen * (r / way), seen * ((r - 0.06) / way), 0.03, 1});
    add_ship(strokes);
    std::erase_if(strokes, [](const Stroke& s) { return std::max(std::abs(s.from.y), std::abs(s.to.y)) > 1.05; });
    return strokes;
}

/// Left: on board the light goes up and down. Right: from outside its way is slanted, so that it needs gamma times as long.
std::vector<Stroke> light_clocks(double gamma, double beta, double t_s)
{
    std::vector<Stroke> strokes;
    constexpr double low = -0.6, high = 0.6, mirror = 0.16;
    const double one_way_s = (high - low) / light_per_s;
    const auto bounce = [&](double s) {
        const double p = part_of(s / (2 * one_way_s)) * 2;
        return p < 1 ? low + p * (high - low) : high - (p - 1) * (high - low);
    };
    const auto clock = [&](double x) {
        for (const double y : {low, high})
            strokes.push_back({{x - mirror, y}, {x + mirror, y}, 0.03, 0.8});
    };
    const auto pulse = [&](const glm::dvec2& at) {
        for (double r = 0.02; r < 0.07; r += 0.025)
            add_circle(strokes, at, r, 0.03, 1);
    };
    constexpr double left = -0.72;
    clock(left);
    strokes.push_back({{left, low}, {left, high}, 0.01, 0.35});
    pulse({left, bounce(t_s)});
    // From -0.35 to 0.95, and from the beginning again. Outside the clock's own time goes 1 / gamma as fast.
    constexpr double begin = -0.35, end = 0.95;
    const double speed = beta * light_per_s, own_start = 0;
    const double trip_s = speed > 1e-3 ? (end - begin) / speed : 1e9;
    const double into_s = part_of(t_s / trip_s) * trip_s;
    const double x = speed > 1e-3 ? begin + speed * into_s : 0.3;
    clock(x);
    glm::dvec2 before(speed > 1e-3 ? begin : x, bounce(own_start));
    for (double s = 0.1; s < into_s && speed > 1e-3; s += 0.1) { // the way so far
        const glm::dvec2 at(begin + speed * s, bounce(own_start + s / gamma));
        strokes.push_back({before, at, 0.012, 0.5});
        before = at;
    }
    pulse({x, bounce(own_start + into_s / gamma)});
    return strokes;
}

/// The rod at rest, and as it is where it flies past.
std::vector<Stroke> rods(double gamma, double beta, double t_s)
{
    std::vector<Stroke> strokes;
    const auto rod = [&](double x, double middle, double length, double strength) {
        const double a = middle - 0.5 * length, b = middle + 0.5 * length;
        strokes.push_back({{x, a}, {x, b}, 0.05, strength});
        for (const double y : {a, b})
            strokes.push_back({{x - 0.09, y}, {x + 0.09, y}, 0.03, strength});
    };
    constexpr double length = 1.2;
    rod(-0.6, 0, length, 0.5);
    const double speed = beta * light_per_s;
    rod(0.6, speed > 1e-3 ? 0.5 - part_of(speed * t_s / 1.0) : 0, length / gamma, 1);
    add_ship(strokes);
    return strokes;
}

} // namespace

std::vector<Stroke> why_sketch(Why why, double gamma_beta, double t_s)
{
    const double gamma = std::sqrt(1 + gamma_beta * gamma_beta), beta = gamma_beta / gamma;
    switch (why) {
    case Why::none:
        return {};
    case Why::aberration:
    case Why::doppler:
    case Why::headlight:
        return light_around(why, physics::exp_rapidity(gamma_beta), t_s);
    case Why::delay:
        return late_light(beta, t_s);
    case Why::dilation:
        return light_clocks(gamma, beta, t_s);
    case Why::length:
        break;
    }
    return rods(gamma, beta, t_s);
}

void draw_strokes(Panel& panel, const std::vector<Stroke>& strokes, const glm::dvec2& middle, double unit)
{
    for (const Stroke& stroke : strokes) {
        const glm::dvec2 a = middle + unit * glm::dvec2(stroke.from.x, -stroke.from.y),
                         b = middle + unit * glm::dvec2(stroke.to.x, -stroke.to.y), way = b - a;
        const double half = std::max(0.5, 0.5 * unit * stroke.width), length2 = glm::dot(way, way);
        const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::min(a, b) - half - 1.0)), 0),
                         high = glm::min(glm::ivec2(glm::ceil(glm::max(a, b) + half + 1.0)), panel.size);
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x) {
                const glm::dvec2 at = glm::dvec2(x, y) + 0.5 - a;
                const double along = length2 > 0 ? std::clamp(glm::dot(at, way) / length2, 0.0, 1.0) : 0;
                const double cover = std::clamp(half - glm::length(at - along * way) + 0.5, 0.0, 1.0);
                std::uint8_t& letter = panel.texels[2 * (std::size_t(y) * panel.size.x + x)];
                letter = std::max(letter, std::uint8_t(255 * stroke.strength * cover));
            }
    }
}

} // namespace starbow
