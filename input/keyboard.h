#pragma once
#include "held_over.h"
#include "pad.h"
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace starbow {

/// Keyboard, mouse and any gamepad that GLFW reports, over all windows of the exhibit. Its state is the keys of the last
/// reading.
class Keyboard {
public:
    /// Reads the present keys (after glfwPollEvents). windows: those whose keys and pointer count. grabbed: another program
    /// has the keyboard; keys that are down then are let go, and stay so until they are pressed again. dt_s: since the last
    /// reading, for looking around. read_elsewhere: the kinds of devices that Hid reads, which are left out here.
    /// left_handed: the hands change places (docs/flying.md).
    template <class Windows>
    Controls read(const Windows& windows, bool grabbed, std::int64_t time_ns, double dt_s,
        const std::vector<UsbId>& read_elsewhere, bool left_handed)
    {
        Controls controls;
        controls.time_ns = time_ns;
        begin();
        for (GLFWwindow* window : windows)
            collect(window);
        let_go(grabbed);
        if (writes_)
            finish_writing(controls);
        else
            finish(controls, left_handed);
        read_pads(controls, dt_s, read_elsewhere, left_handed);
        return controls;
    }

    /// Other hands come: keys, mouse buttons and pads that are held count once they have been let go.
    void forget();

    /// True once after these characters were typed in a row.
    bool typed(std::string_view code);

    /// From now on keys are text (true), and then neither steer nor press switches, or controls again (false).
    void write(bool writes);
    /// The keys since the last call, while they are text: characters of ASCII, '\b', '\n' for Enter, '\x1b' for Esc.
    std::string take_written() { return std::exchange(written_, {}); }

private:
    static constexpr int keys = 512;
    void begin();
    void collect(GLFWwindow* window);
    void let_go(bool grabbed);
    void finish(Controls& controls, bool left_handed);
    void finish_writing(Controls& controls);
    void read_pads(Controls& controls, double dt_s, const std::vector<UsbId>& read_elsewhere, bool left_handed);
    bool down(int key) const { return now_[key]; }
    bool pressed(int key) const { return presses_[key] > 0; }

    std::array<bool, keys> stale_{}; ///< let go during a grab, of which GLFW does not know
    std::array<bool, keys> now_{}; ///< down at the reading, or for a time since the one before
    /// Presses of each key that no reading has reported yet. Each reading reports one, so that quick taps in one slow frame
    /// all count, one frame after another.
    std::array<std::uint8_t, keys> presses_{};
    std::string typed_; ///< the last characters
    std::string written_; ///< not taken yet
    bool writes_ = false;
    PadButtons pads_;
    PadsLeft pads_left_;
    HeldOver<keys> keys_left_; ///< left behind, and so is the mouse button
    HeldOver<1> mouse_left_;
    glm::dvec2 pointer_{0}, drag_{0};
    GLFWwindow* dragging_ = nullptr;
    bool mouse_down_ = false; ///< in one of the windows
    bool held_ = false, was_held_ = false; ///< the mouse button, now and at the reading before
};

/// A key as people read it: C, F1, Tab.
std::string key_text(int key);
/// A line for people on each key and each button of a gamepad.
std::string keyboard_help();

} // namespace starbow
