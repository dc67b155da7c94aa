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
    /// The tour must outlive the guide. seconds_per_time_unit: of its scene. visitors: false where nobody is there to fly
    /// and to answer.
    Guide(const Tour& tour, const Flying& rules, double seconds_per_time_unit, bool visitors = true)
        : show_{tour, rules, seconds_per_time_unit, visitors}
        , touring_(touring_at(show_))
    {
    }

    /// The flight dt_ns nanoseconds later, under the visitor's controls.
    const Flight& flown(const Controls& controls, std::int64_t dt_ns);

    bool flies() const { return starbow::flies(touring_, show_); } ///< the visitor flies
    bool asks() const { return starbow::asks(touring_, show_); } ///< a question waits for an answer
    bool over() const { return touring_.over; }
    bool paused() const { return touring_.paused; }
    bool answered() const { return touring_.measured_answer.has_value(); } ///< the step's question
    const std::string& description() const { return show_.tour.steps[touring_.step()].description; } ///< of the step
    std::size_t step() const { return touring_.step(); } ///< counted from 0
    /// Seconds left of the present step; 0 after the tour's end.
    double left_s() const { return touring_.over ? 0 : starbow::left_s(touring_, show_); }
    /// The tour begins anew.
    void again();
    /// The tour stands still, or goes on.
    void pause(bool on) { touring_.paused = on; }
    /// The visitor's greatest gamma from now on.
    void limit(double max_gamma) { show_.rules.max_gamma = max_gamma; }
    /// The flight, for a docent's switches.
    Flight& flight() { return touring_.flight; }

    /// The EV: the tour's, or the adapted one where the visitor flies; it fades from one to the other.
    double shown_ev(const Exposure& adapted, const Exposing& rules) const;
    double brighter_ev() const { return touring_.brighter_ev; } ///< the visitor's part of it

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
