// Gamepads that GLFW reads, and rates of several hands together.
#include "input/held_over.h"
#include "input/mapping.h"
#include "input/pad.h"
#include "input/rates.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <cmath>
#include <gtest/gtest.h>

namespace pad_test {

using namespace starbow;

namespace {

/// A pad whose triggers rest.
GLFWgamepadstate at_rest()
{
    GLFWgamepadstate state{};
    state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = -1;
    return state;
}

/// The look after a second in which a pad is read `hertz` times.
glm::dvec2 looked(const GLFWgamepadstate& pad, int hertz)
{
    glm::dvec2 look{0};
    for (int i = 0; i < hertz; ++i) {
        Controls controls;
        add_pad(pad, 1.0 / hertz, controls);
        look += controls.look_rad;
    }
    return look;
}

} // namespace

TEST(PadTest, TheLookIsAsFastAtAnyFrameRate)
{
    GLFWgamepadstate pad = at_rest();
    pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
    pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = -0.5f;
    const glm::dvec2 slow = looked(pad, 60);
    for (const int hertz : {10, 30, 90, 144, 1000}) {
        EXPECT_NEAR(looked(pad, hertz).x, slow.x, 1e-12) << hertz; // rounding of 1000 sums
        EXPECT_NEAR(looked(pad, hertz).y, slow.y, 1e-12) << hertz;
    }
    EXPECT_NEAR(slow.x, -1.5, 1e-12); // to the right
    EXPECT_GT(slow.y, 0.3); // up
}

// The same full stick looks around as fast as a device that Hid reads.
TEST(PadTest, APadLooksAsFastAsAStick)
{
    const Descriptor stick{.fields = {{.usage = {1, 0x33}, .bits = 8, .logical_max = 255}}, .report_bits = {{0, 8}}};
    Mapping mapping(
        stick, {.name = "", .axes = {{.usage = 0x33, .role = AxisRole::look_right, .dead_zone = 0, .curve = 1}}});
    DeviceState state;
    const std::array<std::uint8_t, 1> right{255};
    ASSERT_TRUE(take_report(stick, right, 1, state));
    Controls by_hid;
    mapping.add(state, 2, 0.25, by_hid);
    GLFWgamepadstate pad = at_rest();
    pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
    Controls by_glfw;
    add_pad(pad, 0.25, by_glfw);
    EXPECT_NEAR(by_glfw.look_rad.x, by_hid.look_rad.x, 1e-12);
}

TEST(PadTest, APadAtRestDoesNothing)
{
    GLFWgamepadstate pad = at_rest();
    // Worn pads rest a little off.
    pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = -0.96f, pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.1f;
    Controls controls;
    add_pad(pad, 0.1, controls);
    EXPECT_EQ(controls.throttle_rate, 0);
    EXPECT_EQ(controls.turn, glm::dvec3(0));
    EXPECT_EQ(controls.look_rad, glm::dvec2(0));
    EXPECT_EQ(controls.exposure, 0);
}

TEST(PadTest, EveryPressOfAnyPadCountsOnce)
{
    PadButtons buttons;
    GLFWgamepadstate held = at_rest();
    held.buttons[GLFW_GAMEPAD_BUTTON_Y] = GLFW_PRESS;
    const auto doppler = [&](const GLFWgamepadstate* first, const GLFWgamepadstate* second, bool by_key = false) {
        buttons.take(0, first);
        buttons.take(15, second);
        Controls controls;
        controls.set(Switch::doppler, by_key);
        buttons.add(controls);
        return controls[Switch::doppler];
    };
    EXPECT_TRUE(doppler(&held, nullptr));
    EXPECT_FALSE(doppler(&held, nullptr));
    EXPECT_TRUE(doppler(&held, &held)); // the second pad's while the first is held
    EXPECT_FALSE(doppler(&held, &held));
    EXPECT_FALSE(doppler(nullptr, nullptr)); // unplugged while held
    EXPECT_TRUE(doppler(&held, nullptr, true)); // a key and a button in one frame
    EXPECT_TRUE(doppler(&held, nullptr));
    EXPECT_FALSE(doppler(&held, nullptr));
}

// Two hands at full rate are as fast as one; against each other they cancel. Only the keyboard's Shift is faster.
TEST(RatesTest, HandsDoNotAddUpBeyondAFullRate)
{
    const double dt_s = 0.1;
    const auto together = [&](const Controls& first, Controls second) {
        Controls others = first;
        add_rates(second, take_rates(others), dt_s);
        EXPECT_EQ(others.turn, glm::dvec3(0));
        return second;
    };
    Controls full;
    full.throttle_rate = 1, full.exposure = -1, full.push = {1, -1, 1}, full.turn = {-1, 1, 1};
    full.look_rad = {look_rad_per_s * dt_s, -look_rad_per_s * dt_s};
    const Controls both = together(full, full);
    EXPECT_EQ(both.throttle_rate, 1);
    EXPECT_EQ(both.exposure, -1);
    EXPECT_EQ(both.push, full.push);
    EXPECT_EQ(both.turn, full.turn);
    EXPECT_EQ(both.look_rad, full.look_rad);
    Controls half;
    half.throttle_rate = -0.5, half.turn.x = 0.25;
    EXPECT_EQ(together(full, half).throttle_rate, 0.5);
    EXPECT_EQ(together(full, half).turn.x, -0.75);
    Controls shift;
    shift.throttle_rate = 4, shift.look_rad.x = 0.8; // and a drag of the mouse
    EXPECT_EQ(together(shift, full).throttle_rate, 4);
    EXPECT_EQ(together(shift, full).look_rad.x, 0.8);
    // One device whose hat and whose axis say the same.
    Controls twice;
    twice.throttle_rate = 2;
    EXPECT_EQ(together({}, twice).throttle_rate, 1);
}

TEST(PadTest, ALeftHandHasTheOtherSideOfThePad)
{
    GLFWgamepadstate pad = at_rest();
    pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
    pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = -1;
    pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = 1;
    Controls controls;
    add_pad(mirrored(pad), 0.1, controls);
    EXPECT_EQ(controls.turn, glm::dvec3(1, -1, 0)) << "the right stick turns";
    EXPECT_EQ(controls.throttle_rate, 1) << "the left trigger makes faster";
    EXPECT_EQ(controls.look_rad, glm::dvec2(0));
    pad = at_rest();
    pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 1;
    controls = {};
    add_pad(mirrored(pad), 0.1, controls);
    EXPECT_LT(controls.look_rad.x, 0) << "the left one looks around";
    PadButtons buttons;
    pad.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = GLFW_PRESS;
    const GLFWgamepadstate seen = mirrored(pad);
    buttons.take(0, &seen);
    controls = {};
    buttons.add(controls);
    EXPECT_TRUE(controls[Switch::headlight]);
    EXPECT_FALSE(controls[Switch::look_ahead]);
    EXPECT_TRUE(controls.held);
    const GLFWgamepadstate rests = at_rest();
    buttons.take(0, &rests);
    controls = {};
    buttons.add(controls);
    EXPECT_FALSE(controls.held);
}

TEST(PadTest, WhatIsOnBothSidesChangesSidesAndNothingElse)
{
    const std::array<std::pair<int, int>, 2> buttons{{{GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER},
        {GLFW_GAMEPAD_BUTTON_LEFT_THUMB, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB}}};
    for (int button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; ++button) {
        int other = button;
        for (const auto& [left, right] : buttons)
            other = button == left ? right : button == right ? left : other;
        GLFWgamepadstate pad = at_rest();
        pad.buttons[button] = GLFW_PRESS;
        const GLFWgamepadstate seen = mirrored(pad);
        for (int i = 0; i <= GLFW_GAMEPAD_BUTTON_LAST; ++i)
            EXPECT_EQ(seen.buttons[i] == GLFW_PRESS, i == other) << button << ' ' << i;
    }
    GLFWgamepadstate pad = at_rest();
    pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = 0.5f, pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 0.25f;
    const GLFWgamepadstate twice = mirrored(mirrored(pad));
    for (int i = 0; i <= GLFW_GAMEPAD_AXIS_LAST; ++i)
        EXPECT_EQ(twice.axes[i], pad.axes[i]) << i;
}

// Lines of SDL's public list of gamepads (gamecontrollerdb.txt, Linux), with the numbers that the USB ID list gives.
TEST(PadTest, GuidsNameTheDevice)
{
    EXPECT_EQ(usb_id("030000005e040000ea02000001030000"), (UsbId{0x045e, 0x02ea})); // Xbox One S
    EXPECT_EQ(usb_id("050000004c050000c405000000810000"), (UsbId{0x054c, 0x05c4})); // DualShock 4 over Bluetooth
    EXPECT_EQ(usb_id("030000006d0400001fc2000005030000"), (UsbId{0x046d, 0xc21f})); // Logitech F710
    EXPECT_EQ(usb_id("05000000476f6f676c65204368726f6d"), std::nullopt); // "Google Chrom...": a name
    EXPECT_EQ(usb_id("030000005e040000ea0200000103000"), std::nullopt);
    EXPECT_EQ(usb_id("03000000zz040000ea02000001030000"), std::nullopt);
    EXPECT_EQ(usb_id(""), std::nullopt);
}

// A visitor goes and leaves a pad tilted, and another one takes up the next pad.
TEST(PadTest, APadThatWasLeftTiltedCountsOnceItMoves)
{
    PadsLeft left;
    GLFWgamepadstate tilted = at_rest(), other = at_rest();
    tilted.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.8f;
    EXPECT_TRUE(left.counts(0, tilted));
    left.forget();
    for (int i = 0; i < 100; ++i) {
        tilted.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = i % 2 == 0 ? 0.8f : 0.805f; // its sensor trembles
        EXPECT_FALSE(left.counts(0, tilted)) << i;
        EXPECT_EQ(left.counts(1, other), i > 50) << i;
        if (i == 50)
            other.buttons[GLFW_GAMEPAD_BUTTON_A] = GLFW_PRESS;
    }
    tilted.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.6f;
    EXPECT_TRUE(left.counts(0, tilted));
    tilted.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.8f;
    EXPECT_TRUE(left.counts(0, tilted)) << "the new hand may go there, too";
}

TEST(HeldOverTest, AKeyThatWasLeftHeldCountsOnceItIsPressedAgain)
{
    HeldOver<3> keys;
    const auto read = [&](bool first, bool second) {
        const std::pair counts(keys.counts(0, first), keys.counts(1, second));
        keys.end();
        return counts;
    };
    EXPECT_EQ(read(true, false), std::pair(true, false));
    keys.forget();
    EXPECT_EQ(read(true, false), std::pair(false, false));
    EXPECT_EQ(read(true, true), std::pair(false, true)) << "another key counts at once";
    EXPECT_EQ(read(false, true), std::pair(false, true));
    EXPECT_EQ(read(true, true), std::pair(true, true));
    keys.forget();
    EXPECT_EQ(read(true, true), std::pair(false, false));
    keys.press(0); // let go and pressed between two readings
    EXPECT_EQ(read(true, true), std::pair(true, false));
}

} // namespace pad_test
