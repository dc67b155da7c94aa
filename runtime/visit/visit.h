#pragma once
#include "config/model/visiting.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace starbow {

enum class VisitPhase {
    attract, ///< nobody is there: an attraction is shown
    changing, ///< the same, on its way to black and to the next attraction
    entering, ///< somebody is there: on its way to black and to the visitor's own flight
    flying, ///< the visitor flies, or watches a tour
    asking, ///< is somebody still there?
    leaving, ///< nobody is: on its way to black and to the first attraction
};

/// In the order of VisitPhase.
inline constexpr std::array visit_phase_names{"attract", "changing", "entering", "flying", "asking", "leaving"};

/// The course of visits to an exhibit, from one visitor to the next.
struct Visit {
    VisitPhase phase = VisitPhase::attract;
    std::int64_t phase_ns = 0; ///< time in the phase
    std::int64_t fade_ns = 0; ///< of half the fade: how much of the way to black
    std::int64_t idle_ns = 0; ///< without a touch, in the phases that know a visitor
    std::int64_t visit_ns = 0, touched_ns = 0; ///< time since the visit began; then, at the last touch
    std::size_t attraction = 0; ///< counted on from 0
};

/// The signs of a frame by which a visit advances.
struct VisitSigns {
    bool somebody = false; ///< a hand has touched a control, or a head has moved
    bool watches = false; ///< a tour runs, in which a visitor has nothing to touch
    bool attraction_over = false;
};

/// The changes that a frame brings; the caller carries them out.
struct VisitEvents {
    bool shows_attraction = false; ///< Visit::attraction, from its beginning
    bool begins = false; ///< the visitor's own flight
    bool ends = false; ///< everything that the visitor has changed is as at the start
    double length_s = 0; ///< of a visit that ends, from its beginning to the last touch
};

/// The visit dt_ns nanoseconds later. events: receives its changes.
Visit advance(Visit visit, const Visiting& rules, const VisitSigns& signs, std::int64_t dt_ns, VisitEvents& events);

/// A visit that a docent begins: without a fade, and without content of its own.
Visit begun(Visit visit);

/// True while a visitor's controls have an effect.
bool in_hand(const Visit& visit);

/// The part of black over the picture, from 0 to 1.
double fade_of(const Visit& visit, const Visiting& rules);

/// Seconds until the visit ends by itself, while the question is shown and shortly before the longest visit's end; otherwise
/// none.
std::optional<double> seconds_left(const Visit& visit, const Visiting& rules);

} // namespace starbow
