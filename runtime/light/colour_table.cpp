#include "colour_table.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Steps of the grid that are about as fine as the observer's samples: 1 nm at 555 nm for the eye.
int least_steps_per_octave(const StandardObserver& observer)
{
    double finest = INFINITY;
    for (const StandardObserver::Sample& s : observer.samples)
        finest = std::min(finest, s.width_nm / s.nm);
    return std::clamp(int(std::log(2) / finest), 1, 384);
}

/// The observer's samples, each shared by the two grid points beside it.
struct Weights {
    int first = 0; ///< grid point of the first; 0 is 1 nm
    std::vector<glm::dvec3> at;
};

Weights weights_of(const StandardObserver& observer, double steps_per_octave)
{
    auto point_of = [&](double nm) { return std::log2(nm) * steps_per_octave; };
    double low = INFINITY, high = -INFINITY;
    for (const StandardObserver::Sample& s : observer.samples)
        low = std::min(low, s.nm), high = std::max(high, s.nm);
    Weights weights{int(std::floor(point_of(low))), {}};
    weights.at.assign(std::size_t(std::floor(point_of(high))) + 2 - std::size_t(weights.first), glm::dvec3(0));
    for (const StandardObserver::Sample& s : observer.samples) {
        const double at = point_of(s.nm) - weights.first;
        const std::size_t i = std::size_t(at);
        const glm::dvec3 weight = s.response * (s.width_nm / (s.nm * s.nm));
        weights.at[i] += weight * (1 - (at - double(i)));
        weights.at[i + 1] += weight * (at - double(i));
    }
    return weights;
}

} // namespace

ColourTable colour_table(
    std::span<const Spectrum> spectra, const StandardObserver& observer, double first_log2_D, int per_octave, int rows)
{
    const int least = least_steps_per_octave(observer);
    const int per_row = (least + per_octave - 1) / per_octave, steps_per_octave = per_row * per_octave;
    const Weights weights = weights_of(observer, steps_per_octave);
    const std::size_t n = spectra.size(), window = weights.at.size();
    std::vector<double> samples((std::size_t(rows - 1) * std::size_t(per_row) + window) * n); // [grid point][spectrum]
    for (std::size_t i = 0; i < samples.size() / std::max<std::size_t>(n, 1); ++i) {
        const double nm = std::exp2(first_log2_D + (weights.first + double(i)) / steps_per_octave);
        for (std::size_t j = 0; j < n; ++j)
            samples[i * n + j] = spectra[j](nm);
    }
    ColourTable table{int(n), first_log2_D, per_octave, {}};
    table.seen.reserve(std::size_t(rows) * n);
    std::vector<double> sums(3 * n);
    for (int row = 0; row < rows; ++row) {
        std::fill(sums.begin(), sums.end(), 0.0);
        const double* sample = &samples[std::size_t(row) * std::size_t(per_row) * n];
        for (std::size_t i = 0; i < window; ++i, sample += n)
            for (std::size_t c = 0; c < 3; ++c) {
                const double weight = weights.at[i][int(c)];
                for (std::size_t j = 0; j < n; ++j)
                    sums[c * n + j] += weight * sample[j];
            }
        for (std::size_t j = 0; j < n; ++j)
            table.seen.push_back({sums[j], sums[n + j], sums[2 * n + j]});
    }
    return table;
}

} // namespace starbow
