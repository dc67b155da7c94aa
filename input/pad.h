#pragma once
#include "controls.h"
#include <array>
#include <optional>
#include <string_view>

struct GLFWgamepadstate;

namespace starbow {

/// A USB or Bluetooth device's kind.
struct UsbId {
    int vendor = 0, product = 0;
    bool operator==(const UsbId&) const = default;
};

/// The kind in a joystick's GUID as GLFW and SDL write it, 32 hexadecimal digits; nothing where the GUID holds a name
/// instead.
std::optional<UsbId> usb_id(std::string_view guid);

/// A gamepad's state for a left-handed visitor: sticks, triggers and bumpers change sides.
GLFWgamepadstate mirrored(GLFWgamepadstate state);

/// Adds the rates of a gamepad's sticks and triggers. dt_s: since the last reading.
void add_pad(const GLFWgamepadstate& state, double dt_s, Controls& controls);

/// Pads that other hands have left tilted or held: each counts once its state has changed. GLFW does not tell when a pad
/// reports.
class PadsLeft {
public:
    void forget() { forgets_.fill(true); }
    /// Returns whether a pad's state counts. Call it for each pad at each reading.
    bool counts(std::size_t joystick, const GLFWgamepadstate& state);

private:
    static constexpr std::size_t joysticks = 16, numbers = 21; ///< buttons and axes of each
    std::array<bool, joysticks> forgets_{};
    std::array<std::optional<std::array<float, numbers>>, joysticks> left_{};
};

/// The switches of all gamepads' buttons. GLFW knows a button's state at a reading alone: a button that is pressed and let
/// go between two readings is not seen.
class PadButtons {
public:
    /// state: null where no gamepad is at this number, from 0 to 15.
    void take(std::size_t joystick, const GLFWgamepadstate* state);
    /// Adds one press of each switch. One that another hand pressed in the same frame waits for the next frame.
    void add(Controls& controls);

private:
    static constexpr std::size_t joysticks = 16, buttons = 15;
    std::array<std::array<bool, buttons>, joysticks> down_{};
    std::array<int, buttons> waiting_{}; ///< presses that no reading has reported yet
    bool pressed_ = false; ///< any, since the last reading
};

} // namespace starbow
