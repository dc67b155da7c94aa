#include "exposure.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

/// The range from the least positive float to the greatest, with sixteen bins to the power of two.
constexpr int low_ev = -140, high_ev = 129, bins_per_ev = 16;

struct Bin {
    double weight = 0, sum = 0; ///< sum: of weight times log2 luminance
};

/// Statistics of a view, in log2 luminance.
struct Levels {
    double average; ///< between metered_from and metered_to
    double bright; ///< level at bright_from
    double count; ///< number of lit samples
};

/// NaN luminances and luminances without light do not count. log: of the sample's luminance, to base 2.
bool counts(const LuminanceSample& sample, double log)
{
    return log >= low_ev && log < high_ev && sample.solid_angle_sr > 0 && std::isfinite(sample.solid_angle_sr);
}

std::optional<Levels> levels(std::span<const LuminanceSample> view, bool in_space = false)
{
    std::array<Bin, (high_ev - low_ev) * bins_per_ev> bins{};
    double all = 0, count = 0;
    for (const LuminanceSample& part : view) {
        const double log = std::log2(double(part.luminance));
        if (!counts(part, log))
            continue;
        Bin& bin = bins[std::size_t((log - low_ev) * bins_per_ev)];
        bin.weight += part.solid_angle_sr, bin.sum += part.solid_angle_sr * log;
        all += part.solid_angle_sr, ++count;
    }
    if (all == 0)
        return {};
    if (in_space) {
        double seen = 0;
        std::size_t bright = bins.size();
        while (bright > 0 && seen <= (1 - bright_in_space) * all)
            seen += bins[--bright].weight;
        for (std::size_t i = 0; i + std::size_t(dark_in_space) * bins_per_ev < bright; ++i) {
            all -= bins[i].weight;
            bins[i] = {};
        }
    }
    double below = 0, weight = 0, sum = 0, bright = 0;
    for (const Bin& bin : bins) {
        if (bin.weight == 0)
            continue;
        const double from = std::max(below, metered_from * all), to = std::min(below + bin.weight, metered_to * all);
        if (to > from) {
            weight += to - from;
            sum += (to - from) * bin.sum / bin.weight;
        }
        if (below <= bright_from * all)
            bright = bin.sum / bin.weight;
        below += bin.weight;
    }
    return Levels{sum / weight, bright, count};
}

} // namespace

std::optional<double> metered_ev(
    std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars, bool in_space)
{
    const double grey = std::log2(metered_to_luminance);
    const std::optional<Levels> surfaces = levels(view, in_space), points = levels(stars);
    std::optional<double> ev;
    if (surfaces)
        ev = std::min(grey - surfaces->average, std::log2(brightest_luminance) - surfaces->bright);
    if (points) {
        const double wanted = grey - points->average, without = std::max(ev.value_or(wanted), wanted);
        const double mixed = std::lerp(without, wanted, points->count / (points->count + few_stars));
        ev = std::min(ev.value_or(mixed), mixed);
    }
    return ev;
}

std::optional<double> filtered_ev(std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars)
{
    double brightest = -INFINITY;
    for (const std::span<const LuminanceSample> samples : {view, stars})
        for (const LuminanceSample& one : samples)
            if (const double log = std::log2(double(one.luminance)); counts(one, log))
                brightest = std::max(brightest, log);
    return std::isfinite(brightest) ? std::optional(std::log2(filtered_to_luminance) - brightest) : std::nullopt;
}

Exposure adapted_to(Exposure exposure, std::optional<double> ev, const Exposing& rules, double start_ev)
{
    if (ev && !exposure.ev && *ev > rules.min_ev && *ev < rules.max_ev)
        exposure.offset_ev = start_ev - *ev;
    exposure.ev = ev;
    return exposure;
}

Exposure adapted(Exposure exposure, std::optional<double> metered, double dt_s, const Exposing& rules, double start_ev)
{
    if (!metered || exposure.locked)
        return exposure;
    const double wanted = std::clamp(*metered, rules.min_ev, rules.max_ev);
    if (!exposure.ev)
        return adapted_to(exposure, wanted, rules, start_ev);
    if (std::exchange(exposure.leapt, false))
        return adapted_to(exposure, wanted, rules, start_ev);
    const double time_s = wanted < *exposure.ev ? to_bright_s : to_dark_s; // a brighter view needs a lower EV
    *exposure.ev = wanted + (*exposure.ev - wanted) * std::exp(-std::max(dt_s, 0.0) / time_s);
    return exposure;
}

double shown_ev(const Exposure& exposure, const Exposing& rules, double visitors_ev, double start_ev)
{
    if (!rules.automatic || !exposure.ev)
        return visitors_ev;
    return std::clamp(*exposure.ev + exposure.offset_ev + visitors_ev - start_ev, -60.0, 60.0);
}

double pre_exposure(double brightest, double exposure_ev, double most_gain)
{
    const double white_ev = 10 - exposure_ev + std::log2(most_gain);
    const double brightest_ev = std::min(std::log2(std::max(brightest, 1e-30)), white_ev);
    return std::exp2(std::clamp(std::floor(14 - brightest_ev), -100.0, 100.0));
}

} // namespace starbow
