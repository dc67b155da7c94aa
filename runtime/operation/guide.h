#pragma once
#include "runtime/flight/tour.h"
#include "runtime/hud/caption.h"
#include "runtime/light/exposure.h"
#include <optional>
#include <string>

namespace starbow {

/// A tour in a running exhibit.
class Guide {
public:
    /// The tour must outlive it. seconds_per_time_unit: of its scene.
    Guide(const Tour& tour, const Flying& rules, double seconds_per_time_unit)
        : show_{tour, rules, seconds_per_time_unit, true}
        , touring_(touring_at(show_))
    {
    }

    /// The flight dt_ns nanoseconds later, with what the visitor does.
    const Flight& flown(const Controls& controls, std::int64_t dt_ns);

    /// The exposure: as the tour has it, or where the visitor flies after what is seen; from one to the other it fades.
    double shown_ev(const Exposure& adapted, const Exposing& rules) const;

    /// Nothing where the visitor flies at the tour's end.
    std::optional<Caption> caption(const Words& words, const InputCapabilities& capabilities) const;
    /// That it has ended, for a while.
    std::string prompt(const Words& words) const;

private:
    Show show_;
    Touring touring_;
    double automatic_ = 0; ///< of the exposure, from 0 to 1
    double over_s_ = 0;
};

} // namespace starbow
