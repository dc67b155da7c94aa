#pragma once
#include "controls.h"
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

/// Adds the rates of a gamepad's sticks and triggers; its buttons are the caller's. dt_s: since the last reading.
void add_pad(const GLFWgamepadstate& state, double dt_s, Controls& controls);

} // namespace starbow
