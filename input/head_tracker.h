#pragma once
#include "config/model/layout.h"
#include "controls.h"
#include <chrono>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// One packet of opentrack's "UDP over network" output, which many trackers speak: six little-endian doubles, x, y and z in
/// centimetres, then yaw to the left, pitch up and roll to the left in degrees. Nothing for any other length, for what is
/// not finite, and for a head more than 10 m away.
std::optional<Head> parse_head(std::span<const std::byte> packet);

/// The head of a tracker that has told nothing for silent_s seconds: held for one, then brought back to where the layout has
/// it within two more, so that a visitor who leaves the tracker's sight does not leave the walls askew.
Head held(const Head& last, double silent_s);

/// Listens for a head. Never waits.
class HeadTracker {
public:
    /// Throws InputError where the address or the port can't be had.
    explicit HeadTracker(const HeadTracking& tracking);
    HeadTracker(const HeadTracker&) = delete;
    ~HeadTracker();

    /// Where the head is at `now`: of all packets that have come, the last.
    Head read(std::chrono::steady_clock::time_point now);
    /// Whether the head was told of within the last three seconds.
    bool heard(std::chrono::steady_clock::time_point now) const;
    const HeadTracking& tracking() const { return tracking_; }

private:
    HeadTracking tracking_;
    int socket_;
    Head last_;
    std::optional<std::chrono::steady_clock::time_point> heard_;
};

} // namespace starbow
