#pragma once
#include "config/model/quality.h"

namespace starbow {

/// Holds the frame time by moving along a ladder of qualities. Pure: it receives each frame's time and chooses the next
/// frame's level.
///
/// A frame's time is its level's time on the ladder times an unknown load: the scene, the flight, other programs. One
/// late frame may be chance. After a second one the governor trusts the load and chooses the finest level with room to
/// spare, however far away. It moves down at once, and up only after a calm while. After a vain move up it waits twice as
/// long before the next, so that an intermittent load does not make the picture pump. A level for which the device's
/// memory has no room is not tried again until conditions change, and no level that needs at least as much.
class Governor {
public:
    /// frame_budget_ms: of a whole frame. ladder: not empty.
    Governor(std::vector<PresetLevel> ladder, double frame_budget_ms);

    /// Takes the time of a frame drawn on level(); now_s: any clock that runs on. Returns true if the level changed.
    bool drawn(double now_s, double ms);

    /// The device has no memory for this level. The governor leaves it for the last one that was drawn, else for the finest
    /// coarser one that is left, else for a finer one. From then on it goes up by single levels. Returns false where none is
    /// left; then the level stays.
    bool refuse(std::size_t level);
    bool has_room(std::size_t level) const { return !refused_[level]; }
    /// Conditions have changed, such as a window's size: every level may have room again.
    void forget_refusals() { refused_.assign(ladder_.size(), false); }

    std::size_t level() const { return level_; }
    const std::vector<PresetLevel>& ladder() const { return ladder_; }

private:
    std::size_t finest_within(double ms_per_ms, double part) const;

    std::vector<PresetLevel> ladder_;
    std::vector<bool> refused_; ///< by level
    double frame_budget_ms_;
    std::size_t level_;
    std::size_t drawn_; ///< the last level that was drawn
    double last_[3] = {}; ///< loads of the last frames, newest first
    int frames_ = 0; ///< loads in last_
    double moved_s_ = -1e9, up_s_ = -1e9; ///< times of the last change and of the last way up
    double calm_since_s_ = -1, wait_s_ = 1;
};

/// The governor's line of the head-up display.
std::string describe(const Governor& governor);

} // namespace starbow
