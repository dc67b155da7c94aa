#pragma once
#include "config/model/tour_file.h"
#include "flight.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace starbow {

/// A tour with its rules and its units.
struct Show {
    const Tour& tour;
    Flying rules; ///< rules of the visitor's flight
    double seconds_per_time_unit; ///< the scene's
    bool visitors = true; ///< false: nobody flies, and the steps in which the visitor flies are left out
};

/// The state of a tour. The picture is a function of `flight`; the caption depends on all members.
struct Touring {
    /// The state at a step's beginning.
    struct Start {
        Flight flight;
        Ship since; ///< the ship at the tour's last cut: the reference of size measures
    };
    std::vector<Start> starts; ///< starts of all steps up to the present one
    std::int64_t into_ns = 0; ///< time since the present step began
    Flight flight; ///< now
    double brighter_ev = 0; ///< the visitor's change of the exposure
    bool paused = false;
    bool over = false; ///< the tour has ended: the visitor flies
    // The question of the step.
    int chosen = -1; ///< index of the chosen answer; -1: none yet
    double number = 0; ///< the visitor's number
    bool nudged = false; ///< the stick is held to a side
    double nudged_s = 0; ///< for how long
    std::optional<bool> right; ///< the verdict on the answer; nullopt: no answer yet, or none possible
    std::optional<double> measured_answer; ///< the measured value, set while the explanation is shown
    std::int64_t answered_ns = 0; ///< time into the step when the answer came

    std::size_t step() const { return starts.size() - 1; }
};

Touring touring_at(const Show& show);

/// The tour dt_ns nanoseconds of the visitor's time later. A step's picture is a function of the step's beginning and of the
/// time since. Any division of the time gives the same, to rounding where nobody flies and to the tick where the visitor
/// does. The visitor goes on to the next step with `home`, back with `undo`, from the beginning with `reset`. `stop` pauses
/// and resumes where it does not answer a question. Looking around and the exposure always work.
Touring advance(Touring touring, const Show& show, const Controls& controls, std::int64_t dt_ns);

/// True while a question waits for an answer that hands choose, not a flight.
bool asks(const Touring& touring, const Show& show);

/// True while the visitor flies.
bool flies(const Touring& touring, const Show& show);

/// The seconds left of the present step.
double left_s(const Touring& touring, const Show& show);

/// The step's title in the time in which it is shown, its first seconds; otherwise "".
std::string title_of(const Touring& touring, const Show& show);
constexpr double title_s = 5;

/// A tour's length in which nobody flies and nobody answers, seconds.
double length_s(const Tour& tour);

} // namespace starbow
