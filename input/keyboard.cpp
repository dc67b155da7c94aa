#include "keyboard.h"
#include "rates.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace starbow {
namespace {

constexpr double look_rad_per_pixel = 0.003;

static_assert(keys::space == GLFW_KEY_SPACE && keys::escape == GLFW_KEY_ESCAPE && keys::enter == GLFW_KEY_ENTER
    && keys::tab == GLFW_KEY_TAB && keys::backspace == GLFW_KEY_BACKSPACE && keys::f1 == GLFW_KEY_F1
    && keys::f2 == GLFW_KEY_F2 && keys::f5 == GLFW_KEY_F5 && keys::f11 == GLFW_KEY_F11 && 'A' == GLFW_KEY_A
    && '0' == GLFW_KEY_0);

constexpr std::array pad_names{
    "A", "B", "X", "Y", "left bumper", "right bumper", "back", "start", "guide", "left stick", "right stick"};
static_assert(pad_names.size() == std::size_t(PadButton::right_stick) + 1);

bool is_read_elsewhere(int joystick, const std::vector<UsbId>& read_elsewhere)
{
    const char* guid = glfwGetJoystickGUID(joystick);
    const std::optional<UsbId> kind = usb_id(guid ? guid : "");
    return kind && std::find(read_elsewhere.begin(), read_elsewhere.end(), *kind) != read_elsewhere.end();
}

/// The character of a key that writes none by itself; empty for the others.
std::string_view written_character(int key)
{
    switch (key) {
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
        return "\n";
    case GLFW_KEY_BACKSPACE:
        return "\b";
    case GLFW_KEY_ESCAPE:
        return "\x1b";
    default:
        return {};
    }
}

} // namespace

std::string key_text(int key)
{
    constexpr std::pair<int, const char*> names[]{{keys::space, "Space"}, {keys::escape, "Esc"}, {keys::enter, "Enter"},
        {keys::tab, "Tab"}, {keys::backspace, "Backspace"}};
    for (const auto& [number, name] : names)
        if (number == key)
            return name;
    return key >= keys::f1 ? "F" + std::to_string(key - keys::f1 + 1) : std::string(1, char(key));
}

std::string keyboard_help()
{
    const auto line = [](std::string key, std::string_view does) {
        key.resize(std::max<std::size_t>(key.size() + 1, 16), ' ');
        return key.append(does).append("\n");
    };
    std::string help = line("W, S", "faster, slower: equal steps of rapidity (Shift: four times as fast)")
        + line("arrows, A, D", "turn the ship; Q, E roll it") + line("mouse drag", "look around")
        + line("+, -", "brighter, darker")
        + line("left-handed", "W, S, A, D turn the ship; up, down: faster, slower; pads: their two sides change places")
        + line("one button", "any key chooses what the display shows, which acts while the key is held");
    for (const SwitchEntry& one : all_switches)
        if (one.keys[0] != keys::none)
            help += line(key_text(one.keys[0]) + (one.keys[1] != keys::none ? ", " + key_text(one.keys[1]) : ""), one.help);
    help += line("F3, Page Up/Dn",
                "for builders: choose a tilt, rotation, turn or blend of the layout; turn it (Shift: ten times as far)")
        + line("gamepad", "triggers: slower, faster; left stick: turn; right stick: look; cross up, down: brighter, darker");
    for (const SwitchEntry& one : all_switches)
        if (one.pad != PadButton::none)
            help += line(std::string("  ") + pad_names[std::size_t(one.pad)], one.help);
    help.pop_back();
    return help;
}

bool Keyboard::typed(std::string_view code)
{
    if (code.empty() || !typed_.ends_with(code))
        return false;
    typed_.clear();
    return true;
}

void Keyboard::write(bool writes)
{
    if (writes == writes_)
        return;
    // A key that is down at the change, such as the Enter that ends a number, is no switch and steers nothing.
    forget();
    written_.clear(), writes_ = writes;
}

void Keyboard::begin()
{
    now_.fill(false);
    drag_ = {0, 0};
    held_ = mouse_down_ = false;
}

void Keyboard::forget()
{
    keys_left_.forget(), mouse_left_.forget(), pads_left_.forget();
    presses_.fill(0);
}

void Keyboard::collect(GLFWwindow* window)
{
    // States alone would take two taps in two frames for one long press: presses are counted as they come.
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int) {
        if (key < 0 || key >= keys)
            return;
        Keyboard& self = *static_cast<Keyboard*>(glfwGetWindowUserPointer(of));
        // GLFW takes the first press after a grab for a repetition, as it has missed the release.
        const bool anew = std::exchange(self.stale_[std::size_t(key)], false);
        if (self.writes_ && action != GLFW_RELEASE)
            self.written_ += written_character(key);
        if (action != GLFW_PRESS && !(anew && action == GLFW_REPEAT))
            return;
        self.keys_left_.press(std::size_t(key));
        std::uint8_t& presses = self.presses_[std::size_t(key)];
        presses = std::uint8_t(std::min(presses + 1, 255));
    });
    glfwSetCharCallback(window, [](GLFWwindow* of, unsigned int code) {
        constexpr std::size_t most = 64;
        Keyboard& self = *static_cast<Keyboard*>(glfwGetWindowUserPointer(of));
        self.typed_ += code < 128 ? char(code) : '?';
        if (self.writes_ && code < 128)
            self.written_ += char(code);
        if (self.typed_.size() > most)
            self.typed_.erase(0, 1);
    });
    for (int key = GLFW_KEY_SPACE; key < keys && key <= GLFW_KEY_LAST; ++key)
        now_[key] = now_[key] || glfwGetKey(window, key) == GLFW_PRESS;
    if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
        mouse_down_ = true;
        glm::dvec2 at;
        glfwGetCursorPos(window, &at.x, &at.y);
        if (dragging_ == window)
            drag_ += at - pointer_;
        dragging_ = window;
        pointer_ = at;
        held_ = true;
    }
}

void Keyboard::let_go(bool grabbed)
{
    for (std::size_t key = 0; key < keys; ++key) {
        stale_[key] = now_[key] && (grabbed || stale_[key]);
        now_[key] = keys_left_.counts(key, now_[key]) && !stale_[key];
    }
}

void Keyboard::finish(Controls& controls, bool left_handed)
{
    if (!mouse_left_.counts(0, mouse_down_))
        held_ = false, drag_ = {0, 0};
    keys_left_.end(), mouse_left_.end();
    if (!held_)
        dragging_ = nullptr;
    auto axis = [&](int less, int more) { return double(down(more)) - double(down(less)); };
    const double by_letters = axis(GLFW_KEY_S, GLFW_KEY_W), by_arrows = axis(GLFW_KEY_DOWN, GLFW_KEY_UP);
    controls.throttle_rate = left_handed ? by_arrows : by_letters;
    if (down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT))
        controls.throttle_rate *= 4;
    controls.turn = {left_handed ? by_letters : by_arrows,
        axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT) + axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q)};
    controls.look_rad = look_rad_per_pixel * drag_; // the pointer drags the world: dragging right looks left
    controls.exposure = std::max(double(down(GLFW_KEY_EQUAL)), double(down(GLFW_KEY_KP_ADD)))
        - std::max(double(down(GLFW_KEY_MINUS)), double(down(GLFW_KEY_KP_SUBTRACT)));
    for (const SwitchEntry& one : all_switches)
        for (const int key : one.keys)
            controls.set(one.which, controls[one.which] || (key != keys::none && pressed(key)));
    const bool shift = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
    controls.choose = pressed(GLFW_KEY_F3) ? (shift ? -1 : 1) : 0;
    controls.turn_by = (shift ? 10 : 1) * (pressed(GLFW_KEY_PAGE_UP) - pressed(GLFW_KEY_PAGE_DOWN));
    for (std::uint8_t& presses : presses_) {
        controls.pressed |= presses > 0;
        presses -= presses > 0;
    }
    controls.pressed |= held_ && !was_held_;
    controls.held |= held_ || std::ranges::find(now_, true) != now_.end();
    was_held_ = held_;
    controls.turn = glm::clamp(controls.turn, -1.0, 1.0);
}

void Keyboard::finish_writing(Controls& controls)
{
    keys_left_.end(), mouse_left_.end();
    controls.held |= std::ranges::find(now_, true) != now_.end();
    controls.pressed |= std::ranges::any_of(presses_, [](std::uint8_t presses) { return presses > 0; });
    presses_.fill(0);
    dragging_ = nullptr, was_held_ = false;
}

void Keyboard::read_pads(Controls& controls, double dt_s, const std::vector<UsbId>& read_elsewhere, bool left_handed)
{
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state;
        const bool read_here = glfwJoystickIsGamepad(joystick) && glfwGetGamepadState(joystick, &state)
            && !is_read_elsewhere(joystick, read_elsewhere);
        const GLFWgamepadstate seen = read_here && left_handed ? mirrored(state) : state;
        pads_.take(std::size_t(joystick), read_here ? &seen : nullptr);
        if (!read_here)
            continue;
        if (!pads_left_.counts(std::size_t(joystick), seen))
            continue;
        const Rates others = take_rates(controls);
        add_pad(seen, dt_s, controls);
        add_rates(controls, others, dt_s);
    }
    pads_.add(controls);
}

} // namespace starbow
