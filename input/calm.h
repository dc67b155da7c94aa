#pragma once
#include "controls.h"
#include <optional>

namespace starbow {

// What keeps a calm exhibit below three flashes in a second by WCAG 2.3.1, however its controls are pressed. In any second
// one switch changes the picture at once, and exposure, throttle and black over the picture turn round once each. A leap
// between two ways of changing slowly makes two turns of the light, so that it turns at most 2 + 1 + 1 + 1 = 5 times: that
// is six changes, or three pairs. What the world itself does, as its things pass by, is not limited.

/// Seconds from one leap or turn to the next.
constexpr double calm_every_s = 1;

/// A number that follows a wanted one, and turns round at most once in calm_every_s.
struct SlowTurns {
    std::optional<double> value{}; ///< none before the first wanted one, which is taken at once
    int way = 0; ///< 1 grows, -1 falls, 0: neither so far
    double since_turn_s = calm_every_s;
};

/// The number dt_s seconds later. per_s: its fastest change. It rests where the wanted one lies beyond it by no more than
/// `band` on the other way: an unsteady hand, or a trembling light, is no turn.
SlowTurns followed(SlowTurns now, double wanted, double dt_s, double per_s, double band);

/// The same for a shown exposure, EV.
SlowTurns calmed_ev(const SlowTurns& now, double wanted_ev, double dt_s);

/// Holds back the presses that change the picture at once, and turns of the throttle. The first press acts at once; those
/// within calm_every_s after it act together when that time is over. Two presses of one switch are then none.
class CalmHands {
public:
    Controls let_through(Controls controls, double dt_s);

private:
    Controls waiting_{}; ///< its switches alone
    double since_leap_s_ = calm_every_s;
    SlowTurns lever_{};
    int throttle_way_ = 0; ///< of the keys that move it
    double since_throttle_s_ = calm_every_s;
};

} // namespace starbow
