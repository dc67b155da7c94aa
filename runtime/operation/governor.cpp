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

/// True if a picture of quality `a` takes at least as much of the device's memory as one of `b`.
bool needs_at_least(const Quality& a, const Quality& b)
{
    return a.texels_per_pixel >= b.texels_per_pixel && a.max_texels_per_pixel >= b.max_texels_per_pixel
        && a.cube_samples >= b.cube_samples && a.half_floats <= b.half_floats && a.mips >= b.mips
        && a.spectra.value_or(SpectralLevel::fine) >= b.spectra.value_or(SpectralLevel::fine)
        && (a.stereo == b.stereo || a.stereo == StereoMethod::exact);
}

} // namespace

Governor::Governor(std::vector<PresetLevel> ladder, double frame_budget_ms)
    : ladder_(std::move(ladder))
    , refused_(ladder_.size())
    , frame_budget_ms_(frame_budget_ms)
    , level_(ladder_.size() / 2)
    , drawn_(ladder_.size())
{
}

/// The finest level with room whose time under a load is within a part of the budget; else the coarsest with room. load:
/// milliseconds for each one of the ladder's.
std::size_t Governor::finest_within(double load, double part) const
{
    std::size_t finest = std::size_t(std::find(refused_.begin(), refused_.end(), false) - refused_.begin());
    if (finest == ladder_.size())
        return level_; // refuse() has returned false
    for (std::size_t i = finest; i < ladder_.size(); ++i)
        if (has_room(i) && load * ladder_[i].ms <= part * frame_budget_ms_)
            finest = i;
    return finest;
}

bool Governor::refuse(std::size_t level)
{
    for (std::size_t i = 0; i < ladder_.size(); ++i)
        refused_[i] = refused_[i] || i == level || needs_at_least(ladder_[i].quality, ladder_[level].quality);
    if (has_room(level_))
        return true;
    std::size_t next = level_;
    while (next > 0 && refused_[next])
        --next;
    if (drawn_ < level_ && has_room(drawn_))
        next = drawn_;
    while (next < ladder_.size() && refused_[next])
        ++next;
    if (next == ladder_.size())
        return false;
    level_ = next, calm_since_s_ = -1, frames_ = 0;
    return true;
}

bool Governor::drawn(double now_s, double ms)
{
    drawn_ = level_;
    last_[2] = last_[1], last_[1] = last_[0], last_[0] = ms / ladder_[level_].ms;
    frames_ = std::min(frames_ + 1, 3);
    if (frames_ < 2)
        return false;
    const std::size_t before = level_;
    // The load that both of the last two frames reached; for moving up, the load that none of three exceeded.
    const double load = std::min(last_[0], last_[1]), most = *std::max_element(last_, last_ + frames_);
    const bool late = load * ladder_[level_].ms > frame_budget_ms_;
    std::size_t up = finest_within(most, room_up);
    if (up > level_ && std::find(refused_.begin(), refused_.end(), true) != refused_.end())
        up = std::size_t(std::find(refused_.begin() + std::ptrdiff_t(level_) + 1, refused_.end(), false) - refused_.begin());
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
