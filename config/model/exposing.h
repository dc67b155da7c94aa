#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// How light becomes a picture. eye: with one exposure, as an eye or a camera sees it. range: by a curve that shows
/// everything at once.
enum class ExposureMode { eye, range };
inline const std::vector<std::pair<std::string_view, ExposureMode>> exposure_modes{
    {"eye", ExposureMode::eye}, {"range", ExposureMode::range}};
inline std::string_view name_of(ExposureMode mode) { return exposure_modes[std::size_t(mode)].first; }
inline ExposureMode after(ExposureMode mode) { return mode == ExposureMode::eye ? ExposureMode::range : ExposureMode::eye; }
/// Throws InputError for a name that no mode has.
ExposureMode exposure_mode_named(std::string_view name);

/// An eye of 35 years spreads about a tenth of a bright light farther than 0.1 degrees (CIE 146:2002).
constexpr double glow_on_gpu = 0.1;

/// An exhibit's rules of exposure. EV: powers of two of the light.
struct Exposing {
    ExposureMode mode = ExposureMode::eye; ///< at first
    bool automatic = true; ///< the exposure follows the view, as eyes do; the visitor's change is added
    /// The range of the automatic exposure. The greatest EV shows as mid-grey (0.18) the least light that an eye in the
    /// dark for long just sees, 1e-6 cd/m^2. Luminance 1 is a sunlit white surface's: 1361 W/m^2 of a black body of 5772 K,
    /// times 92.0 lm/W over pi, are 39,900 cd/m^2; log2(0.18 * 39,900 / 1e-6) = 32.7.
    double min_ev = -60, max_ev = 33;
    /// The share of the light brighter than the screen's white that glows around it, as in an eye or a lens. nullopt:
    /// glow_on_gpu on a GPU, none without one.
    std::optional<double> bloom{};
    bool calm = false; ///< whatever the visitor does, switches and exposure make no more than three flashes in a second
};

/// The share that glows on a device.
inline double bloom_of(const Exposing& exposing, bool without_gpu)
{
    return exposing.bloom.value_or(without_gpu ? 0 : glow_on_gpu);
}

} // namespace starbow
