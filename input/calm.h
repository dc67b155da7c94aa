#pragma once
#include "channels.h"
#include "config/model/flying.h"
#include <optional>

namespace starbow {

// What keeps a calm exhibit below three flashes in a second by WCAG 2.3.1, however its controls are pressed. In any second
// one switch changes the picture at once; exposure and black over the picture turn round once each; and of all that hands
// and heads move, one number turns round once. A leap between two ways of changing slowly makes two turns of the light, so
// that it turns at most 2 + 1 + 1 + 1 = 5 times: that is six changes, or three pairs. Between its turns the view goes no
// faster than calm_turn_deg_per_s, so that what is bright and what is dark in it take their time to change places. What the
// world itself does, as its things pass by, is not limited.

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

/// Holds back the presses that change the picture at once, and the turns of all that hands and heads move. The first press
/// acts at once; those within calm_every_s after it act together when that time is over. Two presses of one switch are then
/// none. A number that would turn round within calm_every_s after another one did rests until then.
class FlashLimiter {
public:
    /// by_steps: the ship turns by steps, each of which is a leap.
    Controls let_through(Controls controls, double dt_s, bool by_steps = false);

private:
    /// A place that is followed, or the way of a rate.
    struct Kept {
        std::optional<double> value, wanted;
        int way = 0;
    };
    void hold_leaps(Controls& controls, bool by_steps);
    bool turns(Kept& kept, int way);
    void follow(Kept& kept, double per_s, double band, double dt_s);

    Controls waiting_{}; ///< its switches and steps alone
    glm::dquat turned_{1, 0, 0, 0}; ///< the head, as last let through
    double since_leap_s_ = calm_every_s, since_turn_s_ = calm_every_s;
    std::array<std::array<Kept, 4>, all_channels.size()> kept_{}; ///< of each channel's numbers
};

/// The rules of a calm exhibit's flight: its turns are no faster than calm_turn_deg_per_s.
Flying calm_rules(Flying rules);

} // namespace starbow
