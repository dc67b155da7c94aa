#pragma once
#include "runtime/operation/monitors.h"
#include <chrono>
#include <memory>

namespace starbow {

/// The desktop's monitors as they are now. Under X11 over a connection of its own, which tells of every change at once,
/// identities included; elsewhere what GLFW knows, looked at once a second.
class Desktop {
public:
    /// GLFW must be running.
    Desktop();
    ~Desktop();

    const std::vector<Monitor>& monitors() const { return monitors_; }
    /// Looks again if there may be something new. True if monitors() has changed.
    bool look();

private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
    std::vector<Monitor> monitors_;
    std::chrono::steady_clock::time_point looked_;
};

/// A window manager that was killed leaves its name on the X server's root window, and GLFW dies of asking it. Takes a dead
/// one's name away; does nothing without an X server. What it returns holds a connection, to be kept until GLFW has its own:
/// an X server that loses its last client starts anew and answers nobody meanwhile.
std::shared_ptr<void> forget_dead_window_manager();

} // namespace starbow
