#include "star_spots.h"
#include "config/model/angles.h"
#include "displays/compile/rows.h"
#include "point_glare.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double radius = 2; // of a spot, pixels

constexpr double farthest_glare_deg = 3, farthest_of_disc_deg = 6, farthest_glare_pixels = 96;

/// The Sun's disc: unit directions of the world, evenly spread.
std::vector<glm::dvec3> disc_around(const glm::dvec3& way, double radius_rad)
{
    const glm::dvec3 right
        = glm::normalize(glm::cross(way, std::abs(way.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(way, right);
    constexpr int rings = 6;
    std::vector<glm::dvec3> all;
    for (int ring = 0; ring < rings; ++ring)
        for (int i = 0, count = 6 * ring + 3; i < count; ++i) {
            const double off = radius_rad * (ring + 0.5) / rings, turn = 2 * pi * i / count;
            all.push_back(glm::normalize(way + off * (std::cos(turn) * right + std::sin(turn) * up)));
        }
    return all;
}

/// The part of a spot's light that falls on a pixel so far from its middle.
double profile(double square)
{
    const double inside = std::max(1 - square / (radius * radius), 0.0);
    return std::pow(inside, 4) * 5 / (pi * radius * radius);
}

} // namespace

StarSpots::StarSpots(const std::vector<Star>& stars, const StarSky& sky, double unit_m, const TracingEye& eye,
    const Colours& colours, const std::function<glm::dvec3(const glm::dvec3& way)>& beside, double exposure,
    std::span<const double> parts, std::span<const GlobeSpot> globes)
{
    const glm::dmat3 world_from_sky = world_from_equatorial(sky.ahead_deg);
    const double magnitude_0 = sky.brightness_arcmin2 * std::pow(pi / 180 / 60, 2);
    const glm::dvec3 eye_m = eye.observer_of().shot.position * unit_m;
    constexpr double astronomical_unit_m = 149597870700; // nobody is nearer to a star
    const Effects& effects = eye.observer_of().shot.effects;
    std::vector<Spot> all(stars.size());
    by_rows(int(stars.size()), [&](int first, int end) {
        for (int i = first; i < end; ++i) {
            const Star& star = stars[std::size_t(i)];
            const glm::dvec3 way = world_from_sky * star.direction * star.distance_m - eye_m;
            const double nearer = star.distance_m / std::max(glm::length(way), astronomical_unit_m);
            const physics::AberratedRay seen = eye.from_world(glm::normalize(way));
            const double radius_rad = std::asin(std::min(star.radius_m / glm::length(way), 1.0));
            double shown = 0;
            const std::vector<glm::dvec3> points
                = star.radius_m > 0 ? disc_around(glm::normalize(way), radius_rad) : std::vector{glm::normalize(way)};
            for (const glm::dvec3& point : points) {
                const glm::dvec3 at = eye.from_world(point).n;
                // A ball of its own hides nothing of the Sun.
                const double distance = 0.98 * glm::length(way) / unit_m;
                shown += eye.part_left(at, distance, beside(at), parts) / double(points.size());
            }
            if (shown == 0)
                continue;
            glm::dvec3 light = colours.star(star.temperature_K, effects[Effect::doppler] ? seen.D : 1)
                * (magnitude_0 * std::pow(10, -0.4 * star.magnitude) * nearer * nearer * shown);
            if (effects[Effect::headlight])
                light *= seen.D * seen.D * seen.D;
            light *= eye.solid_angle(seen); // a star is a surface too small to have a visible extent
            all[std::size_t(i)] = {seen.n, light,
                glare_radius(light, exposure, star.radius_m > 0 ? farthest_of_disc_deg : farthest_glare_deg), 0,
                radius_rad * std::sqrt(eye.solid_angle(seen)) / degree};
        }
    });
    for (const GlobeSpot& globe : globes)
        all.push_back({globe.way, globe.light, globe.glared ? 0 : glare_radius(globe.light, exposure, farthest_glare_deg),
            globe.glared.value_or(0)});
    std::copy_if(all.begin(), all.end(), std::back_inserter(spots_), [](const Spot& s) { return s.light != glm::dvec3(0); });
    sort(0, spots_.size(), 0);
    for (std::size_t i = 0; i < spots_.size(); ++i)
        if (spots_[i].glare_deg > nearest_glare_deg || spots_[i].glared > 0)
            glaring_.push_back({i, std::cos(1.5 * spots_[i].glare_deg * degree)});
}

void StarSpots::sort(std::size_t first, std::size_t end, int axis)
{
    if (end - first < 2)
        return;
    const std::size_t middle = (first + end) / 2;
    auto at = [&](std::size_t i) { return spots_.begin() + std::ptrdiff_t(i); };
    std::nth_element(
        at(first), at(middle), at(end), [&](const Spot& a, const Spot& b) { return a.way[axis] < b.way[axis]; });
    sort(first, middle, (axis + 1) % 3);
    sort(middle + 1, end, (axis + 1) % 3);
}

void StarSpots::near(
    std::size_t first, std::size_t end, int axis, const glm::dvec3& way, double reach, std::vector<std::size_t>& found) const
{
    if (first >= end)
        return;
    const std::size_t middle = (first + end) / 2;
    const double apart = spots_[middle].way[axis] - way[axis];
    if (glm::length(spots_[middle].way - way) <= reach)
        found.push_back(middle);
    if (apart >= -reach)
        near(first, middle, (axis + 1) % 3, way, reach, found);
    if (apart <= reach)
        near(middle + 1, end, (axis + 1) % 3, way, reach, found);
}

template <class Candidates>
std::vector<StarSpots::Seen> StarSpots::seen_near(
    const ViewRays& rays, const glm::ivec2& pixel, int channel, double reach, const Candidates& candidates) const
{
    const glm::dvec2 centre = glm::dvec2(pixel) + 0.5;
    const auto here = rays.direction(centre, channel);
    if (!here || spots_.empty())
        return {};
    /// The steps of a pixel about a point, each from the directions on either side.
    auto steps = [&](const glm::dvec2& at, glm::dvec3& right, glm::dvec3& down) {
        for (int axis = 0; axis < 2; ++axis) {
            glm::dvec2 half(0);
            half[axis] = 0.5;
            auto low = rays.direction(at - half, channel), high = rays.direction(at + half, channel);
            auto middle = rays.direction(at, channel);
            glm::dvec3& step = axis == 0 ? right : down;
            step = low && high   ? *high - *low
                : low && middle  ? 2.0 * (*middle - *low)
                : high && middle ? 2.0 * (*high - *middle)
                                 : glm::dvec3(0);
        }
        return glm::length(glm::cross(right, down)) > 0;
    };
    glm::dvec3 right, down;
    if (!steps(centre, right, down))
        return {};
    std::vector<Seen> all;
    for (std::size_t i : candidates(*here, glm::length(right) + glm::length(down))) {
        // Newton's method from this pixel finds the point that shows the star.
        glm::dvec2 at = centre;
        glm::dvec3 shown = *here, r = right, d = down;
        bool lost = false;
        for (int round = 0; round < 4 && !lost; ++round) {
            const glm::dvec3 across = glm::cross(r, d), off = spots_[i].way - shown;
            const double area_square = glm::dot(across, across);
            const glm::dvec2 move
                = glm::dvec2(glm::dot(glm::cross(off, d), across), glm::dot(glm::cross(r, off), across)) / area_square;
            lost = !(glm::length(at + move - centre) < 3 * reach);
            if (lost)
                break;
            at += move;
            const auto next = rays.direction(at, channel);
            if (!next || glm::length(move) < 1e-7)
                break; // beyond the picture: extrapolated as a plane
            glm::dvec3 right_there, down_there;
            if (!steps(at, right_there, down_there))
                break;
            shown = *next, r = right_there, d = down_there;
        }
        if (const double off = glm::dot(at - centre, at - centre); !lost && off < reach * reach)
            all.push_back({&spots_[i], off, glm::length(glm::cross(r, d))});
    }
    return all;
}

glm::dvec3 StarSpots::light(const ViewRays& rays, const glm::ivec2& pixel, int channel) const
{
    glm::dvec3 all(0);
    const auto candidates = [&](const glm::dvec3& way, double step) {
        std::vector<std::size_t> found;
        near(0, spots_.size(), 0, way, 1.5 * radius * step, found);
        return found;
    };
    for (const Seen& seen : seen_near(rays, pixel, channel, radius, candidates))
        all += seen.spot->light * (profile(seen.off_square) / seen.solid_angle_sr);
    return all;
}

glm::dvec3 StarSpots::glare(const ViewRays& rays, const glm::ivec2& pixel, int channel) const
{
    if (glaring_.empty())
        return glm::dvec3(0);
    const auto candidates = [&](const glm::dvec3& way, double step) {
        std::vector<std::size_t> found;
        for (const auto& [spot, least_cosine] : glaring_)
            if (glm::dot(way, spots_[spot].way) > least_cosine || glm::length(way - spots_[spot].way) < 3 * radius * step)
                found.push_back(spot);
        return found;
    };
    glm::dvec3 all(0);
    for (const Seen& seen : seen_near(rays, pixel, channel, farthest_glare_pixels, candidates)) {
        if (seen.spot->glared > 0) {
            all -= seen.spot->light * (seen.spot->glared * profile(seen.off_square) / seen.solid_angle_sr);
            continue;
        }
        const double pixel_deg = std::sqrt(seen.solid_angle_sr) / degree;
        const double nearest = std::max({nearest_glare_deg, pixel_deg, seen.spot->disc_deg});
        const double end = std::min(seen.spot->glare_deg, farthest_glare_pixels * pixel_deg);
        if (end <= std::max(radius * pixel_deg, nearest))
            continue;
        const double level = glare_per_sr(end, nearest);
        double change = std::max(glare_per_sr(std::sqrt(seen.off_square) * pixel_deg, nearest) - level, 0.0);
        if (const double spot = profile(seen.off_square) / seen.solid_angle_sr; spot > 0)
            change -= spot * light_of_glare(end, nearest);
        all += seen.spot->light * change;
    }
    return all;
}

} // namespace starbow
