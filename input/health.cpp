#include "health.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr double smallest_move = 0.01;
/// A reversal counts from this part of the range on; good sensors' last digits flicker by less than a thousandth.
constexpr double smallest_turn = 0.03;
/// 24 reversals in a second are twelve swings; a hand that shakes as fast as it can makes six or seven.
constexpr std::int64_t second_ns = 1'000'000'000, forgiven_after_ns = 3 * second_ns;
/// Two hands hold a device by some of their ten fingers. More than four buttons that go down within one report, some
/// milliseconds, are no fingers.
constexpr int most_at_once = 4;
/// A finger taps seven times a second, and trained ones less than twice as often; two of them make this many.
constexpr double most_presses_per_s = 32;

} // namespace

bool PressHealth::take(int started, std::int64_t now_ns)
{
    left_ = std::min(left_ + 1e-9 * double(now_ns - last_ns_) * most_presses_per_s, most_presses_in_a_row);
    last_ns_ = now_ns;
    if (started == 0)
        return !storms(now_ns);
    left_ -= started;
    if (started > most_at_once || left_ < 0 || storms(now_ns)) {
        left_ = std::max(left_, 0.0);
        until_ns_ = now_ns + second_ns;
    }
    return !storms(now_ns);
}

void AxisHealth::take(double place, std::int64_t now_ns)
{
    if (first_ns_ == 0) {
        first_ns_ = now_ns;
        resting_ = turning_ = place;
        return;
    }
    if (std::abs(place - resting_) > smallest_move) {
        resting_ = place;
        moved_ns_ = now_ns;
    }
    if (rising_ ? place > turning_ : place < turning_) {
        turning_ = place;
    } else if (std::abs(place - turning_) > smallest_turn) {
        rising_ = !rising_;
        turning_ = place;
        turns_[next_] = now_ns;
        next_ = (next_ + 1) % turns_.size();
        if (const std::int64_t oldest = turns_[next_]; oldest > 0 && now_ns - oldest < second_ns)
            noisy_until_ns_ = now_ns + forgiven_after_ns;
    }
}

} // namespace starbow
