#pragma once
#include "config/model/quality.h"

namespace starbow {

/// Holds the time of frames by moving along a ladder of qualities. Pure: told of each frame, it answers with the level for
/// the next one.
///
/// A frame takes its level's part of the ladder times a load that is not known: the scene, the flight, what else the machine
/// does. One late frame may be chance; from the second on the load is believed, and the finest level is taken that holds
/// with room to spare, however far it is. Down at once, up only after a calm while; and who has gone up and had to come down
/// again waits twice as long before the next time, so that a load that comes and goes does not pump the picture.
class Governor {
public:
    /// frame_budget_ms: of a whole frame. ladder: not empty.
    Governor(std::vector<PresetLevel> ladder, double frame_budget_ms);

    /// A frame that was drawn on level() took so long; now_s: any clock that runs on. Returns whether the level changed.
    bool drawn(double now_s, double ms);

    std::size_t level() const { return level_; }
    const std::vector<PresetLevel>& ladder() const { return ladder_; }

private:
    std::size_t finest_within(double ms_per_ms, double part) const;

    std::vector<PresetLevel> ladder_;
    double frame_budget_ms_;
    std::size_t level_;
    double last_[3] = {}; ///< loads of the frames before
    int told_ = 0;
    double moved_s_ = -1e9, up_s_ = -1e9; ///< when
    double calm_since_s_ = -1, wait_s_ = 1;
};

/// What the head-up display says of it.
std::string describe(const Governor& governor);

} // namespace starbow
