#pragma once
#include "config/model/tour_file.h"
#include "flight.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace starbow {

/// What a tour is shown with.
struct Show {
    const Tour& tour;
    Flying rules; ///< of who flies in it
    double seconds_per_time_unit; ///< of the scene
    bool visitors = true; ///< false: nobody flies, and steps in which a visitor would are left out
};

/// How far a tour has come. The picture is a function of `flight`, the caption of all of it.
struct Touring {
    /// As a step began.
    struct Start {
        Flight flight;
        Ship since; ///< that sizes are compared with: as the tour last cut
    };
    std::vector<Start> starts; ///< of each step up to the one that is shown
    std::int64_t into_ns = 0; ///< of that one
    Flight flight; ///< now
    double brighter_ev = 0; ///< that the visitor has turned the exposure by
    bool paused = false;
    bool over = false; ///< the visitor flies, until nobody touches anything
    double idle_s = 0; ///< since anything was touched, where the visitor flies
    // The question of the step.
    int chosen = -1; ///< of its choices; -1: none yet
    double number = 0; ///< as it is set
    bool nudged = false; ///< the stick stands aside
    double nudged_s = 0; ///< for so long
    std::optional<bool> right; ///< what was answered; none: nothing yet, or nothing at all
    std::optional<double> measured_answer; ///< the measured number, while the explanation is shown
    std::int64_t asked_ns = 0; ///< into the step when the answer came

    std::size_t step() const { return starts.size() - 1; }
};

Touring touring_at(const Show& show);

/// dt_ns nanoseconds of the visitor's time later. What is shown of a step is a function of how it began and of how far into
/// it the time is: any cutting of the time gives the same, to rounding where nobody flies and to the tick where somebody
/// does. The visitor goes on to the next step with `home`, back with `undo`, from the beginning with `reset`, and stands
/// still and goes on with `stop` where it does not answer a question; looks around and changes the exposure at any time.
Touring advance(Touring touring, const Show& show, const Controls& controls, std::int64_t dt_ns);

/// Whether the visitor flies now.
bool flies(const Touring& touring, const Show& show);

/// Of the step that is shown, seconds left.
double left_s(const Touring& touring, const Show& show);

/// How long a tour takes that nobody flies in and nobody answers, seconds.
double length_s(const Tour& tour);

} // namespace starbow
