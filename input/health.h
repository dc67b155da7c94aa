#pragma once
#include <array>
#include <cstdint>

namespace starbow {

/// The health of one axis of a device: it distinguishes a hand's motion from a worn part's.
class AxisHealth {
public:
    /// place: the axis' value as a part of its whole range, 0 to 1. now_ns: steady clock, at the report's arrival.
    void take(double place, std::int64_t now_ns);

    /// The last time when it moved by a hundredth of its range; 0: not since its first report.
    std::int64_t moved_ns() const { return moved_ns_; }
    /// The time of its last motion or of its first report.
    std::int64_t still_since_ns() const { return moved_ns_ > 0 ? moved_ns_ : first_ns_; }
    /// True if it moves to and fro faster than any hand, now or within the last seconds.
    bool noisy(std::int64_t now_ns) const { return now_ns < noisy_until_ns_; }

private:
    std::int64_t first_ns_ = 0, moved_ns_ = 0, noisy_until_ns_ = 0;
    double resting_ = 0; ///< its place when it last moved
    double turning_ = 0; ///< the farthest it has gone in its present direction
    bool rising_ = true;
    std::array<std::int64_t, 24> turns_{}; ///< times of the last reversals, the oldest at next_
    std::size_t next_ = 0;
};

/// The health of a device's buttons and hats: it distinguishes hands from a loose plug or a broken chip, which would stop
/// the ship, send it home and change its mode.
class PressHealth {
public:
    /// started: the presses that began with one report. Returns false if no hands can have made them.
    bool take(int started, std::int64_t now_ns);
    /// True from such a report on until nothing has been pressed for a second.
    bool storms(std::int64_t now_ns) const { return now_ns < until_ns_; }

private:
    double left_ = most_presses_in_a_row; ///< presses that hands may make by now
    std::int64_t last_ns_ = 0, until_ns_ = 0;
    static constexpr double most_presses_in_a_row = 16;
};

/// No hand keeps a stick in one place away from its middle for so long.
constexpr std::int64_t stuck_after_ns = 60'000'000'000;

} // namespace starbow
