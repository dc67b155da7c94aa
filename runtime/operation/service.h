#pragma once
#include "local_datagrams.h"
#include <chrono>
#include <optional>
#include <string>

namespace starbow {

/// The exhibit's part in sd_notify(3): one datagram a message to the socket that NOTIFY_SOCKET names. Without that variable
/// nothing is sent. Call all of it from the frame loop itself: a thread would go on saying that the exhibit lives.
class Service {
public:
    using Clock = std::chrono::steady_clock;
    Service(); ///< reads NOTIFY_SOCKET, and WATCHDOG_USEC unless WATCHDOG_PID names another process

    /// True if a service manager listens.
    bool supervised() const { return manager_.connected(); }
    /// The time after which the manager takes a silent exhibit for hung.
    std::optional<double> watchdog_s() const { return watchdog_s_; }

    /// Work of up to limit_s begins or goes on, during which no frame is shown.
    void loads(const std::string& status, double limit_s);
    /// A frame was presented: READY=1 after the first one.
    void shows(const std::string& status, Clock::time_point now = Clock::now());
    /// No screen is there to show a frame on.
    void waits(const std::string& status, Clock::time_point now = Clock::now());
    void stops();

private:
    void lives(const std::string& status, Clock::time_point now);

    LocalDatagrams manager_;
    std::optional<double> watchdog_s_;
    bool ready_ = false; ///< READY=1 is sent
    bool extended_ = false; ///< the watchdog's time is that of loading
    std::string status_; ///< the last one sent
    Clock::time_point sent_{}; ///< the last sign of life
};

} // namespace starbow
