#include "governor.h"
#include <algorithm>
#include <array>
#include <cstdio>

namespace starbow {
namespace {

constexpr double moves_apart_s = 0.5; // at least
constexpr double room_down = 0.85, room_up = 0.75; // of the frame budget
constexpr double longest_wait_s = 64;
constexpr double up_in_vain_s = 12; // a move down so soon after a move up shows that the move up was in vain

} // namespace

Governor::Governor(std::vector<PresetLevel> ladder, double frame_budget_ms)
    : ladder_(std::move(ladder))
    , frame_budget_ms_(frame_budget_ms)
    , level_(ladder_.size() / 2)
{
}

/// The finest level whose time under a load is within a part of the budget. load: milliseconds for each one of the
/// ladder's.
std::size_t Governor::finest_within(double load, double part) const
{
    std::size_t finest = 0;
    for (std::size_t i = 0; i < ladder_.size(); ++i)
        if (load * ladder_[i].ms <= part * frame_budget_ms_)
            finest = i;
    return finest;
}

bool Governor::drawn(double now_s, double ms)
{
    last_[2] = last_[1], last_[1] = last_[0], last_[0] = ms / ladder_[level_].ms;
    frames_ = std::min(frames_ + 1, 3);
    if (frames_ < 2)
        return false;
    const std::size_t before = level_;
    // The load that both of the last two frames reached; for moving up, the load that none of three exceeded.
    const double load = std::min(last_[0], last_[1]), most = *std::max_element(last_, last_ + frames_);
    const bool late = load * ladder_[level_].ms > frame_budget_ms_;
    const std::size_t up = finest_within(most, room_up);
    if (up <= level_)
        calm_since_s_ = -1;
    else if (calm_since_s_ < 0)
        calm_since_s_ = now_s;
    if (now_s - moved_s_ < moves_apart_s)
        return false;
    if (late && level_ > 0) {
        level_ = std::min(level_, finest_within(load, room_down));
        if (level_ < before && now_s - up_s_ < up_in_vain_s)
            wait_s_ = std::min(2 * wait_s_, longest_wait_s);
    } else if (calm_since_s_ >= 0 && frames_ == 3 && now_s - calm_since_s_ > wait_s_) {
        level_ = up;
        up_s_ = now_s;
    }
    // A long calm resets the waiting time.
    if (now_s - moved_s_ > 4 * longest_wait_s)
        wait_s_ = 1;
    if (level_ == before)
        return false;
    moved_s_ = now_s, calm_since_s_ = -1, frames_ = 0;
    return true;
}

std::string describe(const Governor& governor)
{
    const PresetLevel& level = governor.ladder()[governor.level()];
    std::array<char, 96> text;
    std::snprintf(text.data(), text.size(), "quality %zu of %zu: FLIP %.3f, edges within %.2f px", governor.level() + 1,
        governor.ladder().size(), level.flip, level.edges_px);
    return text.data();
}

} // namespace starbow
