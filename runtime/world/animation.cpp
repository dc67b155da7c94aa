#include "animation.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The time within one period.
double within(const Track& track, double time_s)
{
    if (track.length_s <= 0)
        return 0;
    const double part = std::fmod(time_s, track.length_s); // exact
    return part < 0 ? part + track.length_s : part;
}

/// The last key at or before a time inside the range of keys.
std::size_t key_at(const Track& track, double part)
{
    return std::size_t(std::upper_bound(track.times_s.begin(), track.times_s.end(), part) - track.times_s.begin()) - 1;
}

glm::dvec4 value(const Track& track, std::size_t key)
{
    return track.values[track.interpolation == Interpolation::cubic ? 3 * key + 1 : key];
}

/// Spherical interpolation along the shorter way.
glm::dvec4 slerp(const glm::dvec4& a, glm::dvec4 b, double part)
{
    double cosine = glm::dot(a, b);
    if (cosine < 0)
        b = -b, cosine = -cosine;
    const double angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b)); // accurate for small ones too
    if (angle < 1e-9)
        return glm::normalize(a + part * (b - a));
    return (std::sin((1 - part) * angle) * a + std::sin(part * angle) * b) / std::sin(angle);
}

} // namespace

glm::dvec4 value_at(const Track& track, double time_s)
{
    const double time = within(track, time_s);
    if (time <= track.times_s.front())
        return value(track, 0);
    if (time >= track.times_s.back())
        return value(track, track.times_s.size() - 1);
    const std::size_t i = key_at(track, time);
    const double step = track.times_s[i + 1] - track.times_s[i], s = (time - track.times_s[i]) / step;
    if (track.interpolation == Interpolation::step)
        return track.values[i];
    if (track.interpolation == Interpolation::linear)
        return track.rotation ? slerp(track.values[i], track.values[i + 1], s)
                              : track.values[i] + s * (track.values[i + 1] - track.values[i]);
    // Hermite's cubic in a form without cancellation at either key.
    const glm::dvec4 &a = track.values[3 * i + 1], &b = track.values[3 * i + 4];
    const glm::dvec4 out = step * track.values[3 * i + 2], in = step * track.values[3 * i + 3];
    const double r = 1 - s;
    const glm::dvec4 at = r * r * (1 + 2 * s) * a + s * s * (1 + 2 * r) * b + s * r * (r * out - s * in);
    if (!track.rotation)
        return at;
    const double length = glm::length(at);
    return length > 0 ? at / length : a;
}

Unbroken unbroken(const Track& track, double time_s)
{
    if (track.length_s <= 0)
        return {-for_ever, for_ever};
    const double time = within(track, time_s), began = time_s - time;
    Unbroken out{-for_ever, for_ever};
    const bool rounds = value(track, 0) != value(track, track.times_s.size() - 1);
    if (rounds)
        out = {began, began + track.length_s};
    if (track.interpolation != Interpolation::step || track.times_s.size() < 2)
        return out;
    const double first = track.times_s[1], last = track.times_s.back();
    if (time < first) {
        out.end_s = began + first;
        if (!rounds)
            out.begin_s = began - track.length_s + last;
    } else if (time >= last) {
        out.begin_s = began + last;
        if (!rounds)
            out.end_s = began + track.length_s + first;
    } else {
        const std::size_t i = key_at(track, time);
        out = {began + track.times_s[i], began + track.times_s[i + 1]};
    }
    return out;
}

double nearest_key(const Track& track, double time_s)
{
    if (track.length_s <= 0)
        return time_s;
    const double time = within(track, time_s), began = time_s - time;
    double nearest = track.times_s.front();
    auto offer = [&](double key) { nearest = std::abs(key - time) < std::abs(nearest - time) ? key : nearest; };
    offer(track.times_s.front() + track.length_s), offer(track.times_s.back()), offer(track.times_s.back() - track.length_s);
    if (time >= track.times_s.front() && time < track.times_s.back()) {
        const std::size_t i = key_at(track, time);
        offer(track.times_s[i]), offer(track.times_s[i + 1]);
    }
    return began + nearest;
}

} // namespace starbow
