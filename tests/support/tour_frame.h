#pragma once
// What is seen during a tour, by formulas that share no code with the program's measures.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/flight/tour.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace starbow::testing {

using glm::dvec3;

inline constexpr double light_year_s = 365.25 * 86400;

/// The seconds in which light flies a scene unit of a shipped tour: a light-year in the voyage, a metre at 5 m/s in the
/// street.
inline double unit_s_of(const std::filesystem::path& tour)
{
    return tour.stem() == "voyage" ? light_year_s : tour.stem() == "street" ? 0.2 : 1;
}

/// A shipped tour as it is shown.
struct ShownTour {
    std::filesystem::path file;
    Tour tour;
    double half_view_deg; ///< from the middle of the view to its edge: of a desk's picture upwards, or of a dome all around
};
/// Every tour on a desk; a tour with other places on a surrounding display there, too.
inline std::vector<ShownTour> shown_tours()
{
    std::vector<ShownTour> all;
    for (const std::filesystem::path& file : shipped("config/tours")) {
        const Tour tour = tour_in(file.string(), words());
        all.push_back({file, tour, 30});
        if (std::ranges::any_of(tour.steps, [](const Step& step) { return step.around.has_value(); }))
            all.push_back({file, seen_on(tour, true), 60});
    }
    return all;
}

/// The state while a caption is shown.
struct Frame {
    double time = 0, own = 0, trip = 0; ///< world's time, ship's own time and that since the last cut, scene units
    dvec3 at{0}, u{0};
    glm::dquat cockpit{1, 0, 0, 0};
    bool aberration = true;
    double half_view_deg = 30; ///< ShownTour's

    double gamma() const { return std::sqrt(1 + glm::dot(u, u)); }
    double beta() const { return glm::length(u) / gamma(); }
    double away(const dvec3& place) const { return glm::distance(at, place); }
    /// When light that arrives now has left a place.
    double left(const dvec3& place) const { return time - away(place); }

    /// The unit direction in the cockpit in which a place is seen: a light's way, (1, -n), in the ship's frame.
    dvec3 seen(const dvec3& place) const
    {
        dvec3 n = (place - at) / away(place);
        if (aberration) {
            const double g = gamma(), along = glm::dot(u, n);
            n = (n + u * (1 + along / (1 + g))) / (g + along);
        }
        return glm::normalize(glm::conjugate(cockpit) * n);
    }
    /// True in a view of 4 to 3.
    bool sees(const dvec3& place) const
    {
        const dvec3 n = seen(place);
        const double half = std::tan(half_view_deg * degree);
        const bool in_view = n.z < 0 && std::abs(n.y / n.z) < half && std::abs(n.x / n.z) < half * 4 / 3;
        if (in_view && when_seen)
            when_seen(*this, place);
        return in_view;
    }
    /// Learns of every place that is in view; none: nobody asks.
    static inline std::function<void(const Frame&, const dvec3&)> when_seen;
    /// How large a thing is seen, degrees: between the directions of its ends, which are `across` apart in the world.
    double size_deg(const dvec3& place, const dvec3& across) const
    {
        const dvec3 a = seen(place + 0.5 * across), b = seen(place - 0.5 * across);
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
    }
    /// The same of a ball: aberration shows it as a circle, the extent of which along the motion is that of its edges.
    double ball_deg(const dvec3& place, double radius) const
    {
        const double half = std::asin(radius / away(place)), E = std::exp(aberration ? std::asinh(glm::length(u)) : 0);
        const double angle = glm::length(u) > 0 ? std::acos(std::clamp(cosine(place), -1., 1.)) : 0;
        const auto shown = [&](double theta) { return 2 * std::atan(std::tan(theta / 2) / E); };
        return (shown(angle + half) - shown(angle - half)) / degree;
    }
    /// Of the angle in the world between the motion and a place; 1 at rest.
    double cosine(const dvec3& place) const
    {
        return glm::length(u) > 0 ? glm::dot(u, place - at) / (glm::length(u) * away(place)) : 1;
    }
    /// The shift of light from a resting place.
    double D(const dvec3& place) const { return gamma() + glm::length(u) * cosine(place) * (glm::length(u) > 0); }
    /// Where it is in the picture: to the right and up, in half heights of a picture of 60 degrees; NaN behind.
    glm::dvec2 in_picture(const dvec3& place) const
    {
        const dvec3 n = seen(place);
        return n.z < 0 ? glm::dvec2(n.x, n.y) / (-n.z * std::tan(30 * degree))
                       : glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    }
    double off_middle_deg(const dvec3& place) const { return std::acos(std::clamp(-seen(place).z, -1., 1.)) / degree; }
};

/// What the clock on the twins' traveller shows when it is seen: on the side astern of it, 0.05 from its middle.
inline double travellers_clock(const Frame& frame)
{
    constexpr double g = 5. / 3, v = 0.8, astern = 0.08 * 0.62;
    double shown = std::nan("");
    for (double own = 0; own <= 12; own += 2e-4) {
        const double way = own < 6 ? v : -v, since = own < 6 ? own : own - 6;
        const dvec3 place(1.3, 0, (own < 6 ? 0 : -8) + g * (astern - way * since));
        const double left = (own < 6 ? 0 : 10) + g * (since - way * astern);
        if (std::abs(left + frame.away(place) - frame.time) < 1e-3)
            shown = own;
    }
    const double since_home = frame.left({1.3, 0, astern}); // at rest, before and after
    return since_home <= 0 ? since_home : since_home >= 20 ? since_home - 8 : shown;
}
/// The place of the traveller's dial at the moment at which its light left, on the way out, at the turn and back.
inline dvec3 travellers_dial(const Frame& frame)
{
    constexpr double g = 5. / 3, v = 0.8, astern = 0.08 * 0.62;
    const double clock = travellers_clock(frame), own = std::isnan(clock) ? 6 : std::clamp(clock, 0., 12.);
    return {1.3, 0, own < 6 ? g * (astern - v * own) : -8 + g * (astern + v * (own - 6))};
}
inline double home_clock(const Frame& frame) { return frame.left({-1.3, 0, 0.08 * 0.62}); }
/// Home's present for the ship.
inline double now_at_home(const Frame& frame)
{
    const dvec3 home(-1.3, 0, 0);
    return frame.time + glm::dot(frame.u / frame.gamma(), home - frame.at);
}

/// When the light left the traveller's clock that is seen of it on its way out.
inline double travellers_light(const Frame& frame)
{
    constexpr double g = 5. / 3, v = 0.8, astern = 0.08 * 0.62;
    return g * (travellers_clock(frame) - v * astern);
}

inline Frame frame_of(const Touring& touring, double half_view_deg = 30)
{
    const Ship& ship = touring.flight.ship;
    return {.time = ship.time.total(),
        .own = ship.proper_time.total(),
        .trip = ship.proper_time.total() - touring.starts.back().since.proper_time.total(),
        .at = ship.position.total(),
        .u = ship.u.total(),
        .cockpit = ship.ship_from_cockpit,
        .aberration = touring.flight.effects[Effect::aberration],
        .half_view_deg = half_view_deg};
}

} // namespace starbow::testing
