#pragma once
#include "config/model/exposing.h"
#include <optional>
#include <span>

namespace starbow {

/// A part of the view, as the device samples it for the exposure.
struct LuminanceSample {
    float luminance; ///< of the scene-linear light, before exposure; white at EV 0 is 1
    float solid_angle_sr; ///< as seen by the visitor; 0: nothing is shown there
};

/// The part of the lit view, from its darkest on, that counts: the brighter half is what eyes adapt to, and its last part,
/// of lamps and glints, may go to white.
constexpr double metered_from = 0.5, metered_to = 0.98;
/// Luminance that the log average of that part is brought to: mid-grey, 18 % of white.
constexpr double metered_to_luminance = 0.18;

/// The brightest of that part is not more than this, though, two stops over white: at great gamma the light ahead is a small
/// disc in the dark, and it is what is looked at.
constexpr double bright_from = 0.98, brightest_luminance = 4;

constexpr double few_stars = 16;

/// The exposure for a view, EV: by the log average of the luminance between two percentiles of its solid angle, and by
/// another percentile. Nothing for a view without light. Darker than 2^-140 is no light.
///
/// stars: each star's spot. They fill too little of a view to tell among its surfaces, and in the dark they are what is
/// looked at: the same average of them is not brought beyond mid-grey, and of stars alone it is brought there. It is one of
/// many, so that a few bright ones which come into view or leave it do not tell; where they are few, `few_stars` more are
/// thought to be there that want what the surfaces want.
std::optional<double> metered_ev(std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars = {});

/// Time constants of the way to a brighter and to a darker view.
constexpr double to_bright_s = 0.5, to_dark_s = 3;

/// One for all outputs and eyes.
struct Exposure {
    std::optional<double> ev; ///< as adapted; nothing before anything was seen
    bool locked = false;
};

/// The exposure dt_s seconds later. The first view is taken at once; a view without light, and a lock, change nothing. Of
/// equal views any cutting of the time into steps leads to the same, but for rounding.
Exposure adapted(Exposure exposure, std::optional<double> metered, double dt_s, const Exposing& rules);

/// What a frame is shown with, EV: what was adapted to (before anything was seen: the start's) and what the visitor has
/// turned it by since the start.
double shown_ev(const Exposure& exposure, const Exposing& rules, double visitors_ev, double start_ev);

/// What the cube map's radiance is stored times: a power of two that puts the brightest light which matters two stops below
/// fp16's greatest number. What lies 28 stops below is still a normal one, 38 stops still a number. Light so bright that it
/// is ten stops over white wherever it is seen does not matter. brightest: of the world; what is made of it where it is
/// looked at is least 1 / most_gain of it.
double pre_exposure(double brightest, double exposure_ev, double most_gain);

} // namespace starbow
