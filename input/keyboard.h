#pragma once
#include "controls.h"
#include <array>

struct GLFWwindow;

namespace starbow {

/// Keyboard, mouse and any gamepad that GLFW reports, over all windows of the exhibit. Its state is the keys of the last
/// reading.
class Keyboard {
public:
    /// Reads the present keys (after glfwPollEvents). windows: those whose keys and pointer count. pads: true to read
    /// GLFW's gamepads, which may be the ones that Hid reads.
    template <class Windows> Controls read(const Windows& windows, std::int64_t time_ns, bool pads)
    {
        Controls controls;
        controls.time_ns = time_ns;
        begin();
        for (GLFWwindow* window : windows)
            collect(window);
        finish(controls, pads);
        return controls;
    }

private:
    static constexpr int keys = 512, buttons = 32;
    void begin();
    void collect(GLFWwindow* window);
    void finish(Controls& controls, bool pads);
    bool down(int key) const { return now_[key]; }
    bool pressed(int key) const { return pressed_[key]; }

    std::array<bool, keys> now_{}; ///< down at the reading, or for a time since the one before
    std::array<bool, keys> pressed_{}; ///< went down since the reading before
    std::array<bool, buttons> pad_{}, pad_before_{};
    glm::dvec2 pointer_{0}, drag_{0};
    GLFWwindow* dragging_ = nullptr;
    bool held_ = false;
};

/// A line for people on each key and button.
const char* keyboard_help();

} // namespace starbow
