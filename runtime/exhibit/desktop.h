#pragma once
#include "runtime/operation/monitors.h"
#include <chrono>
#include <memory>

namespace starbow {

/// The desktop's monitors as they are now. Under X11 a connection of its own reports every change at once, with the
/// monitors' identities. Elsewhere GLFW is read once a second.
class Desktop {
public:
    /// GLFW must be running.
    Desktop();
    ~Desktop();

    const std::vector<Monitor>& monitors() const { return monitors_; }
    /// Reads the monitors again if they may have changed. Returns true if monitors() has changed.
    bool look();

private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
    std::vector<Monitor> monitors_;
    std::chrono::steady_clock::time_point looked_;
};

/// Removes the name of a dead window manager from the X server's root window; does nothing without an X server. A killed
/// window manager leaves its name there, and GLFW crashes when it reads it. Returns a connection that must be kept until
/// GLFW has its own: an X server that loses its last client restarts and is unreachable meanwhile.
std::shared_ptr<void> forget_dead_window_manager();

} // namespace starbow
