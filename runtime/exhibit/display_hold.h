#pragma once
#include <memory>
#include <span>

struct GLFWwindow;

namespace starbow {

/// The exhibit's hold on the X server's screens and keyboard while it runs; without an X server it does nothing.
class DisplayHold {
public:
    /// Suspends the server's screen saver and the timers of its DPMS, because a stick is no input to the server. A level of
    /// DPMS that somebody sets, as the opening hours do, stays. The server ends the suspension itself with this connection,
    /// also after a crash.
    DisplayHold();
    ~DisplayHold();
    DisplayHold(const DisplayHold&) = delete;

    /// True while another program has grabbed the keyboard, as a window manager's menu or a screen lock does. GLFW does not
    /// report this, nor the keys that are let go meanwhile. windows: all that read keys.
    bool keyboard_grabbed(std::span<GLFWwindow* const> windows);

private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

} // namespace starbow
