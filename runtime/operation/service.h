#pragma once
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
    ~Service();
    Service(const Service&) = delete;

    /// True if a service manager listens.
    bool supervised() const { return socket_ >= 0; }
    /// The time after which the manager takes a silent exhibit for hung.
    std::optional<double> watchdog_s() const { return watchdog_s_; }

    /// Work of up to limit_s begins or goes on, during which no frame is shown.
    void loads(const std::string& status, double limit_s);
    /// A frame was presented: READY=1 after the first one.
    void shows(const std::string& status);
    /// No screen is there to show a frame on.
    void waits(const std::string& status);
    void stops();

private:
    bool send(const std::string& message);
    void lives(const std::string& status);

    int socket_ = -1;
    std::optional<double> watchdog_s_;
    bool ready_ = false; ///< READY=1 is sent
    bool extended_ = false; ///< the watchdog's time is that of loading
    std::string status_; ///< the last one sent
    Clock::time_point sent_{}; ///< the last sign of life
};

} // namespace starbow
