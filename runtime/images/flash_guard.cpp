#include "flash_guard.h"
#include "flashes.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// A sample is of a point, and a pixel is the mean around it, so that a smaller change counts, over a smaller area.
constexpr double smallest_change = 0.9 * flash_luminance, most_area_sr = 0.9 * flash_area_sr;
/// At so many changes it dims: some more may come in the frame meanwhile, and the dimming is one.
constexpr int changes_to_dim = 3;
/// The light comes back by this part of white in a second.
constexpr double brighter_per_s = 0.4;

} // namespace

double FlashGuard::area_sr(const Tally& tally, std::span<const LuminanceSample> samples, std::size_t across, int changes)
{
    // Squares as large as a field stand for it. All samples of a view are about as large.
    double all = 0, seen = 0;
    for (const LuminanceSample& sample : samples)
        all += sample.solid_angle_sr, seen += sample.solid_angle_sr > 0;
    if (all == 0)
        return 0;
    constexpr double field_sr = 0.0239; // a circle of flash_field_deg
    const auto side = std::size_t(std::clamp(std::round(std::sqrt(field_sr * seen / all)), 1.0, double(across)));
    const std::size_t rows = samples.size() / across, wide = across + 1;
    sums_.assign(wide * (rows + 1), 0);
    double most = 0;
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < across; ++x) {
            const std::size_t i = y * across + x, at = (y + 1) * wide + x + 1;
            sums_[at] = sums_[at - 1] + sums_[at - wide] - sums_[at - wide - 1]
                + (tally.legs[i].changes >= changes ? samples[i].solid_angle_sr : 0);
            const std::size_t left = std::min(side, x + 1), up = std::min(side, y + 1) * wide;
            most = std::max(most, sums_[at] - sums_[at - left] - sums_[at - up] + sums_[at - left - up]);
        }
    return most;
}

void FlashGuard::count(Tally& tally, std::span<const float> light, double factor, std::size_t old_frames) const
{
    for (; old_frames > 0; --old_frames) {
        for (const std::uint32_t i : tally.changed.front())
            --tally.legs[i].changes;
        tally.changed.pop_front();
    }
    std::vector<std::uint32_t> changed;
    const auto dark = float(flash_dark);
    for (std::size_t i = 0; i < light.size(); ++i) {
        Tally::Leg& leg = tally.legs[i];
        const float value = light[i] * float(factor), least = float(smallest_change);
        bool turns = false;
        if (leg.way == 0) {
            leg.from = std::min(leg.from, value), leg.to = std::max(leg.to, value);
            turns = leg.to - leg.from >= least;
            if (turns && value <= leg.from)
                std::swap(leg.from, leg.to);
            leg.way = std::int8_t(!turns ? 0 : leg.to > leg.from ? 1 : -1);
        } else if (float(leg.way) * (value - leg.to) >= 0) {
            leg.to = value;
        } else if (std::abs(value - leg.to) >= least) {
            leg.from = leg.to, leg.to = value, leg.way = std::int8_t(-leg.way);
            turns = true;
        }
        if (turns && std::min(leg.from, leg.to) < dark && leg.changes < 255)
            ++leg.changes, changed.push_back(std::uint32_t(i));
    }
    tally.changed.push_back(std::move(changed));
}

void FlashGuard::take(
    std::span<const LuminanceSample> samples, std::size_t across, const std::function<double(double)>& shown, double dt_s)
{
    if (samples.empty() || across == 0 || samples.size() % across != 0)
        return;
    lights_.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double light = samples[i].luminance > 0 ? shown(samples[i].luminance) : 0;
        lights_[i] = float(std::isfinite(light) ? std::clamp(light, 0.0, 1.0) : 0);
    }
    if (tallies_[0].legs.size() != samples.size()) {
        frames_s_.clear();
        for (std::size_t k = 0; k < factors.size(); ++k) {
            tallies_[k] = {};
            for (const float light : lights_)
                tallies_[k].legs.push_back({.from = light * float(factors[k]), .to = light * float(factors[k])});
        }
    }
    frames_s_.push_back(dt_s);
    double second_s = 0;
    for (const double frame_s : frames_s_)
        second_s += frame_s;
    std::size_t old_frames = 0;
    for (; frames_s_.size() > 1 && second_s - frames_s_.front() >= 1; ++old_frames)
        second_s -= frames_s_.front(), frames_s_.pop_front();
    for (std::size_t k = 0; k < factors.size(); ++k)
        count(tallies_[k], lights_, factors[k], std::min(old_frames, tallies_[k].changed.size()));

    const auto flickers
        = [&](std::size_t k, int changes) { return area_sr(tallies_[k], samples, across, changes) > most_area_sr; };
    steady_s_ += dt_s;
    const std::size_t before = chosen_;
    while (chosen_ + 1 < factors.size() && flickers(chosen_, changes_to_dim))
        ++chosen_;
    if (chosen_ > before)
        steady_s_ = 0;
    else if (chosen_ > 0 && steady_s_ >= 1 && light_ >= factors[chosen_] && !flickers(chosen_ - 1, changes_to_dim - 1))
        --chosen_, steady_s_ = 0;
    light_ = std::min(factors[chosen_], light_ + brighter_per_s * dt_s);
}

} // namespace starbow
