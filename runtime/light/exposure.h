#pragma once
#include "config/model/exposing.h"
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace starbow {

/// A sample of the view's luminance, as the device takes it for the exposure.
struct LuminanceSample {
    float luminance; ///< scene-linear, before exposure; white at EV 0 is 1
    float solid_angle_sr; ///< as the visitor sees it; 0: no picture there
};

/// The samples of one view of a layout, of surfaces and of stars.
struct ViewSamples {
    std::int32_t view = 0; ///< index into ViewSet::all
    std::vector<LuminanceSample> surfaces, stars;
};

/// The exposure considers the lit view between these two parts of its solid angle, sorted from the darkest. Eyes adapt to
/// the brighter half. The brightest part, of lamps and glints, may turn white.
constexpr double metered_from = 0.5, metered_to = 0.98;
/// The exposure brings the log average of that part to this luminance: mid-grey, 18 % of white.
constexpr double metered_to_luminance = 0.18;

/// The bright end of that part never exceeds this, two stops over white. At great gamma the light ahead is a small disc
/// in the dark, and visitors look at the disc.
constexpr double bright_from = 0.98, brightest_luminance = 4;

constexpr double few_stars = 16;

/// The exposure for a view, EV, from the log average of the luminance between two percentiles of its solid angle and from
/// a third percentile. nullopt for a view without light; below 2^-140 counts as no light.
///
/// stars: each star's spot. Stars fill too little of a view to count among its surfaces, and in the dark visitors look at
/// them. Their own log average therefore never exceeds mid-grey, and it is mid-grey in a view of stars alone. An average
/// over many stars stays steady when a few bright ones enter or leave the view. Where stars are few, `few_stars` more are
/// added with the surfaces' exposure.
///
/// in_space: a lit globe before the black sky. The bright end is then at bright_in_space, and parts that are darker than it
/// by more than dark_in_space do not count: an eye that looks at the Earth adapts to the Earth.
std::optional<double> metered_ev(
    std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars = {}, bool in_space = false);
constexpr double bright_in_space = 0.995, dark_in_space = 10; ///< a part of the view; EV

/// The exposure through a dark filter, EV: the brightest sample is at filtered_to_luminance. nullopt for a view without
/// light, as above.
std::optional<double> filtered_ev(std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars = {});
constexpr double filtered_to_luminance = 0.8;

/// Time constants of the adaptation to a brighter and to a darker view.
constexpr double to_bright_s = 0.5, to_dark_s = 3;

/// One exposure holds for all outputs and eyes. The start's EV belongs to the first view, so that a shot has one brightness,
/// live and as a still, and light that its author made dark or coloured stays so. From there the exposure follows the
/// changes of the metered light.
struct Exposure {
    std::optional<double> ev; ///< adapted; nullopt before anything was seen
    double offset_ev = 0; ///< of the start's EV from the first view's
    bool locked = false;
    bool leapt = false; ///< the next view is taken at once, as the picture has leapt to it
};

/// The exposure after a view to which it has adapted as `ev`. The first view sets the offset, unless the rules limit it: an
/// eye has not adapted to a view that is too dark.
Exposure adapted_to(Exposure exposure, std::optional<double> ev, const Exposing& rules, double start_ev);

/// The exposure dt_s seconds later. The first view, and the one after a leap, are taken at once; a view without light, and a
/// lock, change nothing. For a constant view, any division of the time into steps leads to the same result, to rounding.
Exposure adapted(Exposure exposure, std::optional<double> metered, double dt_s, const Exposing& rules, double start_ev);

/// The EV of a frame: the adapted EV with its offset (the start's before the first view) plus the visitor's own change since
/// the start.
double shown_ev(const Exposure& exposure, const Exposing& rules, double visitors_ev, double start_ev);

/// The factor of the cube map's stored radiance: a power of two that puts the brightest relevant light two stops below
/// fp16's greatest number. Light 28 stops below that is still a normal number, light 38 stops below a subnormal one.
/// Light ten stops over white from every direction is not relevant. brightest: of the world; a viewer multiplies it by at
/// least 1 / most_gain.
double pre_exposure(double brightest, double exposure_ev, double most_gain);

} // namespace starbow
