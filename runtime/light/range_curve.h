#pragma once
#include "exposure.h"
#include "shaders/shared_structs.h"
#include <array>
#include <vector>

namespace starbow {

/// The curve by which everything shows at once: from log2 luminance (scene-linear light at EV 0) to log2 shown luminance
/// (white is 0). One holds for all outputs and eyes. It rises everywhere, so that order stays, and nowhere faster than
/// light itself: no contrast is greater than it is in the scene. Between its knots, one for each stop from RANGE_FIRST on,
/// it is straight.
///
/// It is a histogram adjustment (Ward Larson, Rushmeier and Piatko, "A Visibility Matching Tone Reproduction Operator for
/// High Dynamic Range Scenes", 1997): stops that much of the view has get more of the display's range.
struct RangeCurve {
    std::array<double, RANGE_KNOTS> shown{};
    double low = 0, high = 0; ///< the view's least and greatest log2 luminance, but for a few samples

    double at(double log2_luminance) const; ///< log2 of the shown luminance
    double stops() const { return high - low; } ///< of the view
    double shown_stops() const { return at(high) - at(low); }
    bool operator==(const RangeCurve&) const = default;
};

/// The shown range, log2 of luminance. Its top is tone.glsl's knee, below which light is shown unchanged. Its bottom, 0.0039
/// of white, is 13 of 255 by sRGB's curve: dim, and yet above the black of a projector of 1000:1, which has 0.001 of white.
constexpr double range_top = -0.3959, range_bottom = -8;

/// The numbers of a view's curve, few enough for records: RangeCurve's low and high, the index of the first knot in the
/// range, the shown luminance at the last one, and the slopes between them. From the view's samples; empty for a view
/// without light. ev: the exposure of an eye, EV. The top of the view is no brighter than with that exposure, and a view
/// whose stops all fit below it is shown as with that exposure.
std::vector<double> range_goal(std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars, double ev);

/// The curve of such numbers.
RangeCurve curve_of(std::span<const double> goal);

/// The curve for a view; nullopt for a view without light.
std::optional<RangeCurve> range_curve(
    std::span<const LuminanceSample> view, std::span<const LuminanceSample> stars, double ev);

/// The curve follows the view in two steps, each of which takes this time constant, seconds, and moves by no more than so
/// many stops in a second.
///
/// Then no knot's speed changes faster than 4 * range_stops_per_s / range_settle_s = 32 stops per square second. A change
/// that turns round each 1 / 7 s, seven times a second, moves a knot by no more than 32 (2 / 7)^2 / 16 = 0.163 stops. The
/// light of a general flash changes by a tenth of white from 0.8 or less (docs/safety.md), at least log2(0.9 / 0.8) = 0.170
/// stops. So the curve alone makes no seven such changes in a second, which more than three flashes have.
constexpr double range_settle_s = 0.5, range_stops_per_s = 4;

/// The curve that is shown, and the one that it follows, which follows the view's.
struct RangeFollower {
    std::optional<RangeCurve> shown, followed;
    bool operator==(const RangeFollower&) const = default;
};

/// The follower dt_s seconds later. The first curve is taken at once.
RangeFollower advance(RangeFollower now, const RangeCurve& wanted, double dt_s);

/// Seconds between two goals: a curve that settles slowly needs no more.
constexpr double range_goal_every_s = 0.25;

/// The state of a flight that a curve shows.
struct RangeMode {
    RangeFollower follower;
    std::optional<RangeCurve> wanted;
    double since_goal_s = 0;
    bool follows_at_once = false; ///< the next goal is taken at once, as the view is another one
};

/// True if a goal is due in the frame that is dt_s later.
bool wants_goal(const RangeMode& mode, double dt_s);
/// The state dt_s seconds later. goal: the numbers of range_goal, or empty. locked: the shown curve stays.
RangeMode advance(RangeMode mode, std::span<const double> goal, double dt_s, bool locked);

} // namespace starbow
