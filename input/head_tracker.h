#pragma once
#include "config/model/awaited.h"
#include "config/model/layout.h"
#include "controls.h"
#include <chrono>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// Parses one packet of opentrack's "UDP over network" output, which many trackers speak. It has six little-endian doubles:
/// x, y and z in centimetres, then yaw to the left, pitch up and roll to the left in degrees. nullopt for any other length,
/// for values that are not finite, and for a head more than 10 m away.
std::optional<Head> parse_head(std::span<const std::byte> packet);

/// The head of a tracker that has been silent for silent_s seconds. It is held for one second and returns to the layout's
/// place within two more, so that a visitor who leaves the tracker's sight does not leave distorted walls.
Head held(const Head& last, double silent_s);

/// Receives a head's packets, from the first reading on. Never waits: an address or a port that this machine does not have
/// is taken up once it is there.
class HeadTracker {
public:
    /// log: receives a line for the log when the first packet is no head, when the first head is outside the room, and
    /// while the port can't be had.
    HeadTracker(const HeadTracking& tracking, LogTo log);
    HeadTracker(const HeadTracker&) = delete;
    ~HeadTracker();

    /// The head at `now`, from the last packet that has arrived; never outside the room of the layout.
    Head read(std::chrono::steady_clock::time_point now);
    /// True if a packet has arrived within the last three seconds.
    bool heard(std::chrono::steady_clock::time_point now) const;
    const HeadTracking& tracking() const { return tracking_; }
    /// A sentence about a port that is missing; empty: none is.
    const std::string& lack() const { return awaited_.lack(); }

private:
    void open(std::chrono::steady_clock::time_point now);

    HeadTracking tracking_;
    LogTo log_;
    bool said_wrong_ = false, said_outside_ = false;
    Awaited awaited_;
    int socket_ = -1;
    Head last_;
    std::optional<std::chrono::steady_clock::time_point> heard_;
};

} // namespace starbow
