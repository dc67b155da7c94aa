#pragma once
#include "runtime/flight/tour.h"
#include "runtime/hud/caption.h"
#include "runtime/light/exposure.h"
#include <optional>
#include <string>

namespace starbow {

/// Runs a tour in an exhibit.
class Guide {
public:
    /// The tour must outlive the guide. seconds_per_time_unit: of its scene.
    Guide(const Tour& tour, const Flying& rules, double seconds_per_time_unit)
        : show_{tour, rules, seconds_per_time_unit, true}
        , touring_(touring_at(show_))
    {
    }

    /// The flight dt_ns nanoseconds later, under the visitor's controls.
    const Flight& flown(const Controls& controls, std::int64_t dt_ns);

    /// The EV: the tour's, or the adapted one where the visitor flies; it fades from one to the other.
    double shown_ev(const Exposure& adapted, const Exposing& rules) const;

    /// The caption; nullopt after the tour's end, while the visitor flies.
    std::optional<Caption> caption(const Words& words, const InputCapabilities& capabilities) const;
    /// The line that the tour has ended, for a while after its end; otherwise "".
    std::string prompt(const Words& words) const;

private:
    Show show_;
    Touring touring_;
    double automatic_ = 0; ///< the automatic exposure's part, from 0 to 1
    double over_s_ = 0;
};

} // namespace starbow
