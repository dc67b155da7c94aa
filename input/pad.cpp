#include "pad.h"
#include "rates.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace starbow {

static_assert(sizeof GLFWgamepadstate::buttons == 15 && sizeof GLFWgamepadstate::axes == 6 * sizeof(float));
static_assert(int(PadButton::a) == GLFW_GAMEPAD_BUTTON_A && int(PadButton::b) == GLFW_GAMEPAD_BUTTON_B
    && int(PadButton::x) == GLFW_GAMEPAD_BUTTON_X && int(PadButton::y) == GLFW_GAMEPAD_BUTTON_Y
    && int(PadButton::left_bumper) == GLFW_GAMEPAD_BUTTON_LEFT_BUMPER
    && int(PadButton::right_bumper) == GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER && int(PadButton::back) == GLFW_GAMEPAD_BUTTON_BACK
    && int(PadButton::start) == GLFW_GAMEPAD_BUTTON_START && int(PadButton::left_stick) == GLFW_GAMEPAD_BUTTON_LEFT_THUMB
    && int(PadButton::right_stick) == GLFW_GAMEPAD_BUTTON_RIGHT_THUMB);
static_assert(GLFW_JOYSTICK_LAST == 15 && GLFW_GAMEPAD_BUTTON_LAST == 14);

namespace {

/// A value outside its dead zone, starting from 0 there: neither sticks nor triggers rest exactly at 0.
double outside(double value, double dead)
{
    const double size = std::abs(value);
    return size < dead ? 0 : std::copysign(std::min(1.0, (size - dead) / (1 - dead)), value);
}

double stick(float value) { return outside(value, 0.15); }
double trigger(float value) { return outside(0.5 * (value + 1), 0.05); } // rests at -1

/// A word of a GUID: two bytes, the low one first.
std::optional<int> word(std::string_view guid, std::size_t byte)
{
    int low = 0, high = 0;
    const char *at = guid.data() + 2 * byte, *middle = at + 2, *end = at + 4;
    if (std::from_chars(at, middle, low, 16).ptr != middle || std::from_chars(middle, end, high, 16).ptr != end)
        return {};
    return low | high << 8;
}

} // namespace

// Words: bus, a check sum of the name in newer versions, vendor, 0, product, 0, version, the driver's own (SDL's
// SDL_joystick.c). Where the device has no numbers its name begins in the third word.
std::optional<UsbId> usb_id(std::string_view guid)
{
    if (guid.size() != 32)
        return {};
    const auto vendor = word(guid, 4), product = word(guid, 8);
    if (!vendor || !product || *vendor == 0 || word(guid, 6) != 0 || word(guid, 10) != 0)
        return {};
    return UsbId{*vendor, *product};
}

GLFWgamepadstate mirrored(GLFWgamepadstate state)
{
    for (const auto& [left, right] : {std::pair(GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_RIGHT_X),
             {GLFW_GAMEPAD_AXIS_LEFT_Y, GLFW_GAMEPAD_AXIS_RIGHT_Y},
             {GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER}})
        std::swap(state.axes[left], state.axes[right]);
    for (const auto& [left, right] : {std::pair(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER),
             {GLFW_GAMEPAD_BUTTON_LEFT_THUMB, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB}})
        std::swap(state.buttons[left], state.buttons[right]);
    return state;
}

void add_pad(const GLFWgamepadstate& state, double dt_s, Controls& controls)
{
    controls.throttle_rate
        += trigger(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]) - trigger(state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]);
    controls.turn.y -= stick(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X]);
    controls.turn.x -= stick(state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]);
    controls.look_rad.x -= look_rad_per_s * dt_s * stick(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X]);
    controls.look_rad.y -= look_rad_per_s * dt_s * stick(state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]);
    controls.exposure
        += double(state.buttons[GLFW_GAMEPAD_BUTTON_DPAD_UP]) - double(state.buttons[GLFW_GAMEPAD_BUTTON_DPAD_DOWN]);
}

bool PadsLeft::counts(std::size_t joystick, const GLFWgamepadstate& state)
{
    std::array<float, numbers> now;
    std::ranges::copy(state.buttons, now.begin());
    std::ranges::copy(state.axes, now.begin() + std::ssize(state.buttons));
    constexpr float noise = 0.02f;
    std::optional<std::array<float, numbers>>& left = left_[joystick];
    if (std::exchange(forgets_[joystick], false))
        left = now;
    else if (left && !std::ranges::equal(now, *left, [](float a, float b) { return std::abs(a - b) <= noise; }))
        left.reset();
    return !left;
}

void PadButtons::take(std::size_t joystick, const GLFWgamepadstate* state)
{
    for (std::size_t button = 0; button < buttons; ++button) {
        const bool down = state && state->buttons[button] == GLFW_PRESS;
        const bool pressed = down && !down_[joystick][button];
        pressed_ |= pressed;
        waiting_[button] += pressed;
        down_[joystick][button] = down;
    }
}

void PadButtons::add(Controls& controls)
{
    controls.pressed |= std::exchange(pressed_, false);
    for (const auto& pad : down_)
        controls.held |= std::ranges::find(pad, true) != pad.end();
    for (const SwitchEntry& one : all_switches) {
        if (one.pad == PadButton::none || controls[one.which])
            continue;
        auto& waiting = waiting_[std::size_t(one.pad)];
        controls.set(one.which, waiting > 0);
        waiting -= waiting > 0;
    }
}

} // namespace starbow
