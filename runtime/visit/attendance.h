#pragma once
#include "flight_source.h"
#include "input/requests.h"
#include "visit.h"
#include <utility>

namespace starbow {

/// Attends to the visitors of an exhibit: who is there, when a visit begins and ends, and how a visitor comes home.
class Attendance {
public:
    /// attends: the exhibit does so itself; else somebody else does, and visits are only counted.
    Attendance(const Visiting& rules, bool attends)
        : rules_(rules)
        , attends_(attends)
        , visit_(attends ? Visit{} : begun({}))
    {
    }

    /// The frame's signs and time. The caller carries the events out.
    VisitEvents advance(const VisitSigns& signs, std::int64_t dt_ns);
    /// Brings a visitor home who asks for it, wherever the ship is: a long way leads through black. rests: the start is one
    /// at rest, and its flight the visitor's own.
    Requests lead_home(const FlightSource& source, const Controls& hands, bool rests, double dt_s);
    /// A throttle that is open at a start at rest has no effect before it was at 0.
    static void wait_for_throttle(const Controls& hands, bool rests, Requests& requests);
    /// A visit begins without a fade, as a docent or somebody else wants it.
    void begin() { visit_ = begun(visit_); }
    /// Sets the rules by which visits are counted, in an exhibit that somebody else attends to.
    void count_by(const Visiting& rules) { rules_ = attends_ ? rules_ : rules; }

    bool attends() const { return attends_; }
    const Visit& visit() const { return visit_; }
    /// True while a visitor's controls have an effect.
    bool in_hand() const { return starbow::in_hand(visit_); }
    /// True while somebody's visit goes on.
    bool knows_visitor() const { return in_hand() && (attends_ || visit_.touched_ns > 0); }
    /// The part of black over the picture.
    double fade() const { return std::max(home_fade_, fade_of(visit_, rules_)); }
    /// Seconds until the visit ends by itself, where that is said; otherwise none.
    std::optional<double> seconds_left() const { return starbow::seconds_left(visit_, rules_); }
    /// The time with a visitor since the last call, s.
    double take_visited_s() { return std::exchange(visited_s_, 0); }

private:
    Visiting rules_;
    bool attends_;
    Visit visit_;
    bool goes_home_ = false; ///< through black, as the way is too long to be flown
    double home_fade_ = 0; ///< the part of black on that way
    double visited_s_ = 0;
};

} // namespace starbow
