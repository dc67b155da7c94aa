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

bool is_read_elsewhere(int joystick, const std::vector<UsbId>& read_elsewhere)
{
    const char* guid = glfwGetJoystickGUID(joystick);
    const std::optional<UsbId> kind = usb_id(guid ? guid : "");
    return kind && std::find(read_elsewhere.begin(), read_elsewhere.end(), *kind) != read_elsewhere.end();
}

} // namespace

const char* keyboard_help()
{
    return "W, S            faster, slower: equal steps of rapidity (Shift: four times as fast)\n"
           "arrows, A, D    turn the ship; Q, E roll it\n"
           "mouse drag      look around; C looks ahead again\n"
           "Space           stop at once, relative to the world\n"
           "R               fly back to the start; Backspace ten seconds back\n"
           "P               freeze the world, to look around in it; P again: go on\n"
           "left-handed     W, S, A, D turn the ship; up, down: faster, slower; pads: their two sides change places\n"
           "one button      any key chooses what the display shows, which acts while the key is held\n"
           "M               the next mode of flight: guided, free, newtonian\n"
           "1, 2, 3         aberration, Doppler effect, headlight effect on and off\n"
           "4               for guides: infrared and ultraviolet in false colours, on and off\n"
           "5               to compare: velocities that simply add, no light delay, and back to what is seen\n"
           "+, -            brighter, darker; L locks the automatic exposure, or releases it\n"
           "V               everything visible at once, with brightness compressed, on and off\n"
           "O               instruments: crosshair, grid, ring of D = 1, distance, time of emission, off\n"
           "X, K            mark what is at the crosshair (the first thing, the second); write a line of the log\n"
           "G               plots of the log against theory: D, length, clock, off\n"
           "F1              why? the next page, with the formula and its numbers\n"
           "H, I            head-up display on and off; the next one: for visitors, guides, the laboratory\n"
           "N               beside the picture: the same instant at rest, or with one effect alone, or none\n"
           "F11, Esc        full screen; leave\n"
           "F2              for builders: the next test pattern\n"
           "F3, Page Up/Dn  choose a tilt, rotation, turn or blend of the layout; turn it (Shift: ten times as far)\n"
           "F5              save those changes in the layout's file\n"
           "gamepad         triggers: slower, faster; left stick: turn; right stick: look; A stop; B fly back to the "
           "start;\n"
           "                X, Y, right bumper: the effects; left bumper: look ahead;\n"
           "                start: instruments; right stick pressed: mark";
}

bool Keyboard::typed(std::string_view code)
{
    if (code.empty() || !typed_.ends_with(code))
        return false;
    typed_.clear();
    return true;
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
    controls.look_ahead = pressed(GLFW_KEY_C);
    controls.stop = pressed(GLFW_KEY_SPACE);
    controls.home = pressed(GLFW_KEY_R);
    controls.undo = pressed(GLFW_KEY_BACKSPACE);
    controls.next_mode = pressed(GLFW_KEY_M);
    controls.freeze = pressed(GLFW_KEY_P);
    controls.menu = pressed(GLFW_KEY_TAB) || pressed(GLFW_KEY_ENTER);
    controls.slow_motion = pressed(GLFW_KEY_T);
    controls.aberration = pressed(GLFW_KEY_1);
    controls.doppler = pressed(GLFW_KEY_2);
    controls.headlight = pressed(GLFW_KEY_3);
    controls.lock_exposure = pressed(GLFW_KEY_L);
    controls.range = pressed(GLFW_KEY_V);
    controls.false_colours = pressed(GLFW_KEY_4);
    controls.comparison = pressed(GLFW_KEY_5);
    controls.overlay = pressed(GLFW_KEY_O);
    controls.mark = pressed(GLFW_KEY_X);
    controls.log = pressed(GLFW_KEY_K);
    controls.why = pressed(GLFW_KEY_F1);
    controls.plot = pressed(GLFW_KEY_G);
    controls.hud = pressed(GLFW_KEY_H);
    controls.information = pressed(GLFW_KEY_I);
    controls.beside = pressed(GLFW_KEY_N);
    controls.full_screen = pressed(GLFW_KEY_F11);
    controls.quit = pressed(GLFW_KEY_ESCAPE);
    const bool shift = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
    controls.pattern = pressed(GLFW_KEY_F2);
    controls.choose = pressed(GLFW_KEY_F3) ? (shift ? -1 : 1) : 0;
    controls.turn_by = (shift ? 10 : 1) * (pressed(GLFW_KEY_PAGE_UP) - pressed(GLFW_KEY_PAGE_DOWN));
    controls.save = pressed(GLFW_KEY_F5);
    for (std::uint8_t& presses : presses_) {
        controls.pressed |= presses > 0;
        presses -= presses > 0;
    }
    controls.pressed |= held_ && !was_held_;
    controls.held |= held_ || std::ranges::find(now_, true) != now_.end();
    was_held_ = held_;
    controls.turn = glm::clamp(controls.turn, -1.0, 1.0);
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
