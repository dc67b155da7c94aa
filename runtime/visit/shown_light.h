#pragma once
#include "flight_source.h"
#include "input/calm.h"
#include "runtime/flight/record.h"
#include "runtime/images/flash_guard.h"
#include "runtime/light/range_curve.h"
#include <span>

namespace starbow {

/// The luminance of the frame before.
struct Metered {
    std::optional<double> ev; ///< the exposure for it
    std::span<const LuminanceSample> surfaces, stars;
    std::size_t across = 0; ///< the surfaces' samples lie in rows of so many
};

/// Everything that a frame's light depends on beside the frames before.
struct LightInputs {
    const FlightSource& source; ///< after its step
    Metered metered;
    bool range = false; ///< a curve shows everything at once
    bool filter = false; ///< where hands fly, the exposure is for the brightest thing, and no curve
    bool locks = false; ///< the exposure's lock is turned
    bool replays = false; ///< the entry holds the measurements of the recorded flight
    double fade = 0; ///< the wanted part of black over the picture
    double directed_ev = 0; ///< a docent's change of the exposure
    double dt_s = 0;
};

/// The light of the picture between the flight and the screen: the exposure or the curve, black, and a calm exhibit's
/// limits.
class ShownLight {
public:
    explicit ShownLight(const Exposing& rules)
        : rules_(rules)
    {
    }

    /// Follows a frame. entry: receives the measurements that a replay reads.
    void advance(RecordEntry& entry, const LightInputs& now);
    /// Other content: the exposure begins with its first view.
    void begin() { leaps_.reset(); }
    /// Another visitor: no lock holds the exposure, and a curve begins with the next view.
    void forget_visitor() { range_ = {}, exposure_.locked = false; }

    /// The exposure of the picture, EV. With a curve: the change by the visitor and the docent.
    double ev() const { return ev_; }
    /// The curve by which the picture shows everything at once; none: the exposure alone does.
    const std::optional<RangeCurve>& curve() const { return range_.follower.shown; }
    bool locked() const { return exposure_.locked; } ///< the automatic exposure
    bool filtered() const { return filtered_; } ///< by a dark filter
    /// The part of black, smoothed, with the part of the light that a calm exhibit takes away.
    double fade() const { return 1 - (1 - glm::smoothstep(0.0, 1.0, fade_)) * light_; }
    /// True where the picture has nothing to do with the one before.
    bool leapt() const { return leapt_; }

private:
    void guard(RecordEntry& entry, const LightInputs& now);
    bool follow_leap(const FlightSource& source);
    void follow_range(RecordEntry& entry, const LightInputs& now, const Metered& metered);
    double wanted_ev(const LightInputs& now) const;
    void keep_calm(const LightInputs& now);

    Exposing rules_;
    Exposure exposure_{};
    double begun_ev_ = 0; ///< the exposure with which the present view began
    bool filtered_ = false;
    RangeMode range_{};
    std::optional<Leaps> leaps_{}; ///< of the last picture; none before the first one of new content
    bool leapt_ = false;
    double ev_ = 0, fade_ = 0;
    // The limits of a calm exhibit:
    SlowTurns calm_ev_{}, calm_fade_{};
    bool calm_range_ = false; ///< calm_ev_ is that of a curve
    FlashGuard flash_guard_{};
    double light_ = 1; ///< the part of the picture's light that it keeps
};

} // namespace starbow
