#pragma once
#include <array>
#include <cstdint>

namespace starbow {

/// How one axis of a device behaves: whether a hand moves it, or a worn part.
class AxisHealth {
public:
    /// place: the axis' value as a part of its whole range, 0 to 1. now_ns: the steady clock's, at the report's arrival.
    void take(double place, std::int64_t now_ns);

    /// When it last went a hundredth of its range; 0: not since it was first heard of.
    std::int64_t moved_ns() const { return moved_ns_; }
    /// When it last moved or was first heard of.
    std::int64_t still_since_ns() const { return moved_ns_ > 0 ? moved_ns_ : first_ns_; }
    /// Goes to and fro faster than any hand, or did within the last seconds.
    bool noisy(std::int64_t now_ns) const { return now_ns < noisy_until_ns_; }

private:
    std::int64_t first_ns_ = 0, moved_ns_ = 0, noisy_until_ns_ = 0;
    double resting_ = 0; ///< where it was when it last moved
    double turning_ = 0; ///< the farthest it has gone the way it goes now
    bool rising_ = true;
    std::array<std::int64_t, 24> turns_{}; ///< times of the last turns back, the oldest at next_
    std::size_t next_ = 0;
};

/// So long no hand keeps a stick in one place away from its middle.
constexpr std::int64_t stuck_after_ns = 60'000'000'000;

} // namespace starbow
