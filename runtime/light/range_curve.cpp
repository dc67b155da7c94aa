#include "range_curve.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

constexpr int knots = RANGE_KNOTS, cells = knots - 1;

/// A view's parts that may lie beyond RangeCurve::low and RangeCurve::high, and beyond the ends of the shown range.
constexpr double below_low = 0.002, above_high = 0.001;
/// The part above the range's top: glints, and at great gamma the small disc ahead.
constexpr double above_top = 0.005;
/// Slope above the range's top and below its bottom.
constexpr double slope_beyond = 0.125;
/// Each stop's share of the range rises with its part of the view to this power. At 1 a small bright disc would be flat, at
/// 0 a large dark field.
constexpr double share_power = 0.5;
/// The part of the range that all stops from the view's lowest to its highest share alike, so that order stays strict.
constexpr double even_share = 0.1;
/// Stops of the shown range, at least, however dark an eye's exposure is.
constexpr double least_range = 5;
/// The stars' part of all weight: they fill too little of a view to count, and are looked at.
constexpr double stars_share = 0.1;

constexpr int fine_per_stop = 16;
using Histogram = std::array<double, cells>; ///< by stops, [k, k + 1) from RANGE_FIRST on

struct Histograms {
    Histogram stops{}; ///< each sample is shared out between the two nearest stops' middles, so that none leaps
    std::array<double, cells * fine_per_stop> fine{}; ///< of parts of a stop
};

/// Adds the samples, in sum `whole`. Returns the number of those with light.
double add(std::span<const LuminanceSample> samples, double whole, Histograms& histograms)
{
    Histograms own;
    double all = 0, count = 0;
    for (const LuminanceSample& sample : samples) {
        const double log = std::log2(double(sample.luminance));
        if (!(log >= RANGE_FIRST && sample.solid_angle_sr > 0 && std::isfinite(log) && std::isfinite(sample.solid_angle_sr)))
            continue;
        const double at = std::clamp(log - RANGE_FIRST - 0.5, 0.0, cells - 1.0);
        const std::size_t cell = std::min(std::size_t(at), std::size_t(cells - 2));
        own.stops[cell] += sample.solid_angle_sr * (double(cell) + 1 - at);
        own.stops[cell + 1] += sample.solid_angle_sr * (at - double(cell));
        own.fine[std::min(std::size_t((log - RANGE_FIRST) * fine_per_stop), own.fine.size() - 1)] += sample.solid_angle_sr;
        all += sample.solid_angle_sr, ++count;
    }
    for (std::size_t k = 0; all > 0 && k < own.stops.size(); ++k)
        histograms.stops[k] += own.stops[k] * whole / all;
    for (std::size_t k = 0; all > 0 && k < own.fine.size(); ++k)
        histograms.fine[k] += own.fine[k] * whole / all;
    return count;
}

/// The luminance, in stops from RANGE_FIRST, below which a part of the whole lies.
double level(const Histograms& histograms, double whole, double part)
{
    double below = 0;
    for (std::size_t k = 0; k < histograms.fine.size(); ++k) {
        const double own = histograms.fine[k];
        if (own > 0 && below + own >= part * whole)
            return (double(k) + std::clamp((part * whole - below) / own, 0.0, 1.0)) / fine_per_stop;
        below += own;
    }
    return cells;
}

/// Shares a range of so many stops out among the cells from `first` to `last`: slopes of at most 1, in the weights'
/// proportion below.
std::array<double, cells> slopes(const Histogram& weights, int first, int last, double range)
{
    std::array<double, cells> slope{};
    double least = 0, most = 1e9; // the factor of the weights
    for (int step = 0; step < 100; ++step) {
        const double factor = 0.5 * (least + most);
        double sum = 0;
        for (int k = first; k <= last; ++k)
            sum += slope[std::size_t(k)] = std::min(1.0, factor * weights[std::size_t(k)]);
        (sum > range ? most : least) = factor;
    }
    return slope;
}

} // namespace

double RangeCurve::at(double log2_luminance) const
{
    const double place = std::clamp(log2_luminance - RANGE_FIRST, 0.0, double(cells));
    const std::size_t k = std::min(std::size_t(place), std::size_t(cells - 1));
    return std::lerp(shown[k], shown[k + 1], place - double(k));
}

std::vector<double> range_goal(std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars, double ev)
{
    Histograms histograms;
    const Histogram& histogram = histograms.stops;
    const bool any = add(view, 1, histograms) > 0;
    const double count = add(stars, 0, histograms);
    const double share = any ? stars_share * count / (count + few_stars) : 1;
    add(stars, share, histograms);
    const double whole = (any ? 1 : 0) + (count > 0 ? share : 0);
    if (whole == 0)
        return {};
    const double low = level(histograms, whole, below_low), high = level(histograms, whole, 1 - above_high),
                 top = level(histograms, whole, 1 - above_top);
    const int first = std::min(int(low), cells - 1), last = std::clamp(int(std::ceil(top)) - 1, first, cells - 1);

    // Smoothed over the neighbours, so that the slope has no steps that show in a smooth sky.
    Histogram weights{};
    double sum = 0;
    for (int k = first; k <= last; ++k) {
        double smooth = 0;
        constexpr double kernel[] = {1 / 16., 4 / 16., 6 / 16., 4 / 16., 1 / 16.};
        for (int i = -2; i <= 2; ++i)
            smooth += kernel[i + 2] * histogram[std::size_t(std::clamp(k + i, 0, cells - 1))];
        sum += weights[std::size_t(k)] = std::pow(smooth / whole, share_power);
    }
    for (int k = first; k <= last; ++k) {
        double& weight = weights[std::size_t(k)];
        weight = even_share / (last - first + 1) + (1 - even_share) * weight / sum;
    }
    // An eye's exposure may show the view's top darker than the range allows, as a tour's author wanted it.
    const double shown_end = std::clamp(last + 1 + RANGE_FIRST + ev, range_bottom + least_range, range_top);
    const std::array<double, cells> slope = slopes(weights, first, last, shown_end - range_bottom);

    // Few digits, for records.
    const auto rounded = [](double x) { return std::round(x * 1000) / 1000; };
    std::vector<double> goal{rounded(low + RANGE_FIRST), rounded(high + RANGE_FIRST), double(first), rounded(shown_end)};
    for (int k = first; k <= last; ++k)
        goal.push_back(std::max(std::floor(slope[std::size_t(k)] * 1000) / 1000, 0.001));
    return goal;
}

RangeCurve curve_of(std::span<const double> goal)
{
    constexpr std::size_t before = 4; // the slopes
    RangeCurve curve{.low = goal[0], .high = goal[1]};
    const std::size_t first = std::size_t(goal[2]), end = first + goal.size() - before;
    curve.shown[end] = goal[3];
    for (std::size_t k = end; k-- > 0;)
        curve.shown[k] = curve.shown[k + 1] - (k < first ? slope_beyond : goal[before + k - first]);
    for (std::size_t k = end; k + 1 < curve.shown.size(); ++k)
        curve.shown[k + 1] = curve.shown[k] + slope_beyond;
    return curve;
}

std::optional<RangeCurve> range_curve(
    std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars, double ev)
{
    const std::vector<double> goal = range_goal(view, stars, ev);
    return goal.empty() ? std::nullopt : std::optional(curve_of(goal));
}

/// A curve that moves towards another, by one part of the way at every luminance: so it stays in order, and no steeper than
/// light itself.
static RangeCurve moved(const RangeCurve& from, const RangeCurve& to, double dt_s)
{
    double most = 0;
    for (std::size_t k = 0; k < from.shown.size(); ++k)
        most = std::max(most, std::abs(to.shown[k] - from.shown[k]));
    if (most == 0 && from == to)
        return from;
    const double part = std::min(1 - std::exp(-dt_s / range_settle_s), range_stops_per_s * dt_s / std::max(most, 1e-9));
    RangeCurve curve;
    for (std::size_t k = 0; k < from.shown.size(); ++k)
        curve.shown[k] = std::lerp(from.shown[k], to.shown[k], part);
    curve.low = std::lerp(from.low, to.low, part);
    curve.high = std::lerp(from.high, to.high, part);
    return curve;
}

RangeFollower advance(RangeFollower now, const RangeCurve& wanted, double dt_s)
{
    if (!now.shown || !now.followed)
        return {wanted, wanted};
    dt_s = std::max(dt_s, 0.0);
    now.followed = moved(*now.followed, wanted, dt_s);
    now.shown = moved(*now.shown, *now.followed, dt_s);
    return now;
}

bool wants_goal(const RangeMode& mode, double dt_s)
{
    return !mode.wanted || mode.follows_at_once || mode.since_goal_s + dt_s >= range_goal_every_s;
}

RangeMode advance(RangeMode mode, std::span<const double> goal, double dt_s, bool locked)
{
    mode.since_goal_s += dt_s;
    if (!goal.empty()) {
        mode.wanted = curve_of(goal);
        mode.since_goal_s = 0;
        if (std::exchange(mode.follows_at_once, false))
            mode.follower = {};
    }
    if (mode.wanted && (!locked || !mode.follower.shown))
        mode.follower = advance(std::move(mode.follower), *mode.wanted, dt_s);
    return mode;
}

} // namespace starbow
