#pragma once
#include "config/model/quality.h"

namespace starbow {

/// Holds the time of frames by moving along a ladder of qualities. Pure: told of each frame, it answers with the rung for
/// the next one.
///
/// A frame takes its rung's part of the ladder times a load that is not known: the scene, the flight, what else the machine
/// does. One late frame may be chance; from the second on the load is believed, and the finest rung is taken that holds
/// with room to spare, however far it is. Down at once, up only after a calm while; and who has gone up and had to come down
/// again waits twice as long before the next time, so that a load that comes and goes does not pump the picture.
class Governor {
public:
    /// hold_ms: of a whole frame. ladder: not empty.
    Governor(std::vector<Rung> ladder, double hold_ms);

    /// A frame that was drawn on rung() took so long; now_s: any clock that runs on. Returns whether the rung changed.
    bool drawn(double now_s, double ms);

    std::size_t rung() const { return rung_; }
    const std::vector<Rung>& ladder() const { return ladder_; }

private:
    std::size_t finest_within(double ms_per_ms, double part) const;

    std::vector<Rung> ladder_;
    double hold_ms_;
    std::size_t rung_;
    double last_[3] = {}; ///< loads of the frames before
    int told_ = 0;
    double moved_s_ = -1e9, up_s_ = -1e9; ///< when
    double calm_since_s_ = -1, wait_s_ = 1;
};

/// What the head-up display says of it.
std::string told(const Governor& governor);

} // namespace starbow
