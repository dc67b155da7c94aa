#include "globe_view.h"
#include "config/model/angles.h"
#include "displays/compile/rows.h"
#include "point_glare.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double largest_spot = 0.8, smallest_disc = 1.6; // radii in pixels
constexpr int sun_parts = 96;

/// Directions at an angle around an axis.
glm::dvec3 around(const glm::dvec3& axis, double angle, double turn)
{
    const glm::dvec3 right
        = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(axis, right);
    return glm::normalize(axis * std::cos(angle) + (right * std::cos(turn) + up * std::sin(turn)) * std::sin(angle));
}

struct OnShip {
    glm::dvec3 way; ///< towards the middle
    double mean = 0, most = 0; ///< angular radius of a ball's outline
};

OnShip on_ship(const TracingEye& eye, const std::function<glm::dvec3(const glm::dvec3& way)>& beside,
    const glm::dvec3& from_ship_m, double radius_m)
{
    const glm::dvec3 middle_m = from_ship_m - eye.among_globes_m(beside(eye.towards(from_ship_m)));
    OnShip out{eye.towards(middle_m)};
    const double angle = std::asin(std::min(radius_m / glm::length(middle_m), 1.0));
    constexpr int count = 32;
    for (int i = 0; i < count; ++i) {
        const double off = angle_between(out.way, eye.towards(around(glm::normalize(middle_m), angle, 2 * pi * i / count)));
        out.mean += off / count, out.most = std::max(out.most, off);
    }
    return out;
}

/// A body's light in `count` evenly spread directions of the cone around what belongs to it, each times its solid angle on
/// the ship.
std::vector<std::pair<glm::dvec3, glm::dvec3>> lights(const TracingEye& eye, std::size_t body, const OnShip& outline,
    const std::function<glm::dvec3(const glm::dvec3& way)>& beside, int count)
{
    const double half = std::sin(0.5 * std::min(outline.most * 1.0001, pi));
    std::vector<std::pair<glm::dvec3, glm::dvec3>> all{std::size_t(count)};
    by_rows(count, [&](int first, int end) {
        for (int i = first; i < end; ++i) {
            const glm::dvec3 way
                = around(outline.way, 2 * std::asin(half * std::sqrt((i + 0.5) / count)), 2 * pi * 0.6180339887498949 * i);
            all[std::size_t(i)] = {way, eye.globe_light(body, way, beside(way)) * (4 * pi * half * half / count)};
        }
    });
    return all;
}

glm::dvec3 sum(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& all)
{
    glm::dvec3 light(0);
    for (const auto& one : all)
        light += one.second;
    return light;
}

} // namespace

GlobeView::GlobeView(const TracingEye& eye, const ViewRays& rays, const glm::ivec2& size,
    const std::function<glm::dvec3(const glm::dvec3& way)>& beside)
{
    if (!eye.globes())
        return;
    const std::vector<GlobeSight::Body>& bodies = eye.globes()->bodies();
    struct Near {
        OnShip outline;
        double off = INFINITY;
        glm::ivec2 pixel{-1};
    };
    std::vector<Near> all;
    std::size_t most = 0;
    for (const GlobeSight::Body& body : bodies) {
        all.push_back({on_ship(eye, beside, body.middle_m, body.globe->radius_m)});
        most = std::max(most, body.index);
    }
    const int channel = rays.channels() == 3 ? int(Channel::green) : 0;
    for (int y = 0; y < size.y; ++y) {
        const ViewRays::Row row = rays.row(y);
        for (int x = 0; x < size.x; ++x)
            if (const auto way = row.centre(x, channel))
                for (Near& near : all)
                    if (const double off = glm::length(*way - near.outline.way); off < near.off)
                        near.off = off, near.pixel = {x, y};
    }
    parts_.assign(most + 1, 1);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Near& near = all[i];
        const bool sun = bodies[i].index == 0;
        double& part = parts_[bodies[i].index];
        if (near.pixel.x >= 0) {
            const double pixel = rays.pixel_rad(near.pixel, channel);
            if (pixel > 0)
                part = std::clamp((near.outline.mean / pixel - largest_spot) / (smallest_disc - largest_spot), 0.0, 1.0);
        }
        const bool reaches = near.off < 0.2; // a spot far beyond the picture brings no light
        if (!sun && (part >= 1 || !reaches))
            continue;
        const OnShip outline = on_ship(eye, beside, bodies[i].middle_m, bodies[i].outer_m());
        const glm::dvec3 light = sum(lights(eye, i, outline, beside, bodies[i].globe->air ? 4000 : 16000));
        if (light == glm::dvec3(0))
            continue;
        std::optional<double> glared;
        if (sun) {
            sun_ = SunGlare{lights(eye, i, outline, beside, sun_parts),
                2 * std::sin(0.5 * outline.most) * std::sqrt(pi / sun_parts) / degree};
            const glm::dvec3 part_of_light = light / glm::max(sum(sun_->lights), glm::dvec3(1e-300));
            for (auto& one : sun_->lights)
                one.second *= part_of_light;
            glared = light_of_sun_glare(nearest_glare_deg);
        }
        if (part < 1)
            spots_.push_back({near.outline.way, light * (1 - part), glared});
    }
}

glm::dvec3 GlobeView::glare(const ViewRays& rays, const glm::ivec2& pixel, int channel, const glm::dvec3& sun) const
{
    if (!sun_)
        return glm::dvec3(0);
    const glm::dvec2 at = glm::dvec2(pixel) + 0.5;
    const auto here = rays.direction(at, channel);
    if (!here)
        return glm::dvec3(0);
    const auto step = [&](const glm::dvec2& half) {
        const auto low = rays.direction(at - half, channel), high = rays.direction(at + half, channel);
        return low && high ? *high - *low : low ? 2.0 * (*here - *low) : high ? 2.0 * (*high - *here) : glm::dvec3(0);
    };
    const double pixel_deg = std::sqrt(glm::length(glm::cross(step({0.5, 0}), step({0, 0.5})))) / degree;
    const double nearest = std::max({nearest_glare_deg, pixel_deg, sun_->part_deg});
    glm::dvec3 change(0);
    for (const auto& [way, light] : sun_->lights)
        change += light * sun_glare_per_sr(angle_between(*here, way) / degree, nearest);
    if (sun != glm::dvec3(0))
        change -= sun * light_of_sun_glare(nearest);
    return change;
}

} // namespace starbow
