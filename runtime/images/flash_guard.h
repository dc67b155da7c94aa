#pragma once
#include "runtime/light/exposure.h"
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

namespace starbow {

/// Keeps a picture below three flashes in a second (flashes.h), whatever flickers in it: it watches samples of the shown
/// light, and dims the picture before the light has changed too often. A dimmed picture's changes are smaller, and those by
/// less than a tenth of white are no flashes.
///
/// It dims at once, and brightens again slowly, after a second in which the brighter picture would have been steady. The
/// samples are of the frame before, and three changes are left: for what comes meanwhile, and for the dimming.
class FlashGuard {
public:
    /// The factors of light between which it chooses. With the last one no change can be a flash.
    static constexpr std::array factors{1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.095};

    /// Takes a frame's samples, which lie in rows of `across`. shown: the shown luminance of a sample's without dimming,
    /// white is 1; it must rise. Another number of samples is another view, which begins.
    void take(std::span<const LuminanceSample> samples, std::size_t across, const std::function<double(double)>& shown,
        double dt_s);

    /// The part of the light that the next picture keeps.
    double light() const { return light_; }

private:
    /// The changes of all samples, were they dimmed by one of the factors.
    struct Tally {
        struct Leg {
            float from = 0, to = 0; ///< the extremes, as far as they are known; then the last extreme and the farthest value
            std::int8_t way = 0;
            std::uint8_t changes = 0; ///< in the last second
        };
        std::vector<Leg> legs;
        std::deque<std::vector<std::uint32_t>> changed; ///< in each frame of the last second
    };
    /// The greatest area in any field of those samples that have so many changes or more.
    double area_sr(const Tally& tally, std::span<const LuminanceSample> samples, std::size_t across, int changes);
    void count(Tally& tally, std::span<const float> light, double factor, std::size_t old_frames) const;

    std::array<Tally, factors.size()> tallies_;
    std::deque<double> frames_s_; ///< lengths of the frames in `changed`
    std::vector<float> lights_;
    std::vector<double> sums_; ///< of the areas above and to the left
    std::size_t chosen_ = 0; ///< a factor
    double light_ = 1, steady_s_ = 0;
};

} // namespace starbow
