#include "fisheye.h"
#include "config/model/angles.h"
#include "config/model/turn.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Slack beyond the rim, so that a direction computed for a point on the rim is found again.
constexpr double rim_slack = 1e-12;

double g(FisheyeMapping mapping, double angle)
{
    switch (mapping) {
    case FisheyeMapping::equidistant:
        return angle;
    case FisheyeMapping::equisolid:
        return 2 * std::sin(angle / 2);
    case FisheyeMapping::stereographic:
        return 2 * std::tan(angle / 2);
    default:
        return std::sin(angle);
    }
}

} // namespace

FisheyeRays::FisheyeRays(const Fisheye& fisheye, glm::ivec2 size)
    : mapping_(fisheye.mapping)
    , zenith_(dome_zenith(fisheye.tilt_deg))
    , centre_(fisheye.centre * glm::dvec2(size))
    , radius_(fisheye.diameter * std::min(size.x, size.y) / 2)
    , rim_(glm::radians(fisheye.aperture_deg) / 2)
    , scale_(g(mapping_, rim_) / radius_)
{
    const glm::dvec3 right(1, 0, 0), front = glm::cross(zenith_, right);
    const double turn = glm::radians(fisheye.rotation_deg), c = std::cos(turn), s = std::sin(turn);
    right_ = right * c + front * s;
    down_ = front * c - right * s;
}

std::optional<glm::dvec3> FisheyeRays::direction(glm::dvec2 pixel) const
{
    const glm::dvec2 offset = pixel - centre_;
    const double r = glm::length(offset);
    if (r > radius_ * (1 + rim_slack))
        return {};
    // The cosine of the angle from the zenith, and its sine over g.
    double along, across;
    const double value = r * scale_;
    switch (mapping_) {
    case FisheyeMapping::equidistant:
        along = std::cos(value);
        across = value > 0 ? std::sin(value) / value : 1;
        break;
    case FisheyeMapping::equisolid: {
        const double half = std::min(value / 2, 1.0); // sin(a/2)
        along = 1 - 2 * half * half;
        across = std::sqrt(1 - half * half);
        break;
    }
    case FisheyeMapping::stereographic: {
        const double half = value / 2; // tan(a/2)
        across = 1 / (1 + half * half);
        along = (1 - half * half) * across;
        break;
    }
    default: {
        const double sine = std::min(value, 1.0);
        along = std::sqrt(1 - sine * sine);
        across = 1;
    }
    }
    across *= scale_;
    return glm::normalize(zenith_ * along + right_ * (offset.x * across) + down_ * (offset.y * across));
}

std::optional<glm::dvec2> FisheyeRays::pixel(const glm::dvec3& direction) const
{
    const glm::dvec2 side(glm::dot(direction, right_), glm::dot(direction, down_));
    const double across = glm::length(side), angle = std::atan2(across, glm::dot(direction, zenith_));
    if (!(angle <= rim_ * (1 + rim_slack)))
        return {};
    const double r = g(mapping_, angle) / scale_;
    // Straight below the zenith every rim point of a whole sphere shows the direction; the front one is returned.
    const glm::dvec2 way = across > 0 ? side / across : glm::dvec2(0, 1);
    return centre_ + way * r;
}

double FisheyeRays::pixel_angle(glm::dvec2 pixel) const
{
    const double r = glm::distance(pixel, centre_);
    if (r > radius_ * (1 + rim_slack))
        return 0;
    // Solid angle / area in units of g = sin(a) / (g g').
    switch (mapping_) {
    case FisheyeMapping::equidistant: {
        // In a whole sphere the sine vanishes at the rim, though its pixels still show something. There its mean over the
        // last half pixel replaces it.
        const double angle = std::min(r * scale_, pi - scale_ / 4);
        const double shrink = angle > 1e-4 ? std::sin(angle) / angle : 1 - angle * angle / 6;
        return scale_ * std::sqrt(std::max(shrink, 0.0));
    }
    case FisheyeMapping::equisolid:
        return scale_;
    case FisheyeMapping::stereographic:
        return scale_ / (1 + r * scale_ * r * scale_ / 4);
    default: {
        // 1 / cos(a) grows without bound towards a rim at 90 degrees. Its mean over the pixel's part of the radius does not:
        // the ring from a to b holds 2 pi (cos a - cos b).
        const auto cosine = [&](double radius) {
            const double sine = std::min(radius * scale_, 1.0);
            return std::sqrt(1 - sine * sine);
        };
        return scale_ * std::sqrt(2 / (cosine(std::abs(r - 0.5)) + cosine(r + 0.5)));
    }
    }
}

} // namespace starbow
