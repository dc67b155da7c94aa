#pragma once
#include "runtime/flight/flight.h"
#include "runtime/light/exposure.h"

namespace starbow {

class TourPlayer;

/// A source of the shown flight: the visitor's hands, a tour, or a flight that was recorded. The exhibit asks it the same
/// questions whatever it is.
class FlightSource {
public:
    FlightSource() = default;
    FlightSource(const FlightSource&) = delete;
    virtual ~FlightSource() = default;

    virtual const Flight& flight() const = 0;
    /// The flight dt_ns nanoseconds later under the visitor's controls.
    virtual const Flight& advance(const Controls& controls, std::int64_t dt_ns) = 0;

    /// True where hands steer it, now or when it was recorded; false in a tour's own motion.
    virtual bool by_hand() const { return true; }
    /// True at its end: a tour's last step, a record's last frame.
    virtual bool over() const { return false; }
    /// True while its time stands still.
    virtual bool paused() const { return flight().frozen; }

    /// The exposure with which the present view began, and the visitor's change of it since then, EV.
    virtual double begun_ev() const = 0;
    virtual double visitors_ev() const { return flight().exposure_ev - begun_ev(); }
    /// The shown exposure, EV, where the eye has adapted as `adapted`.
    virtual double shown_ev(const Exposure& adapted, const Exposing& rules) const
    {
        return starbow::shown_ev(adapted, rules, flight().exposure_ev, begun_ev());
    }

    /// The flight whose effects a docent may switch; null where a tour shows its own.
    virtual Flight* switched() = 0;
    /// The visitors' greatest gamma from now on.
    virtual void limit(double) { }
    /// True if a flight home ends within so many seconds.
    virtual bool is_near_home(double) const { return true; }
    /// The tour, with all that only tours have: steps, captions, questions; null for any other source.
    virtual const TourPlayer* tour() const { return nullptr; }
    virtual TourPlayer* tour() { return nullptr; }
};

} // namespace starbow
