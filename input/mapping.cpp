#include "mapping.h"
#include "config/model/angles.h"
#include "rates.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace starbow {
namespace {

// HID Usage Tables 1.4: generic desktop, simulation controls.
constexpr std::uint16_t desktop = 1, simulation = 2;
constexpr std::uint16_t axis_x = 0x30, axis_y = 0x31, axis_z = 0x32, axis_rx = 0x33, axis_ry = 0x34, axis_rz = 0x35,
                        slider = 0x36, dial = 0x37, hat_switch = 0x39;
constexpr double detent_reach = 0.03;

void add_role(AxisRole role, double value, double dt_s, Controls& controls)
{
    switch (role) {
    case AxisRole::none:
    case AxisRole::throttle: // LeverChoice selects one of several
        return;
    case AxisRole::faster:
        controls.throttle_rate += value;
        return;
    case AxisRole::slower:
        controls.throttle_rate -= value;
        return;
    case AxisRole::nose_up:
        controls.turn.x += value;
        return;
    case AxisRole::nose_right:
        controls.turn.y -= value;
        return;
    case AxisRole::roll_right:
        controls.turn.z -= value;
        return;
    case AxisRole::look_right:
        controls.look_rad.x -= value * look_rad_per_s * dt_s;
        return;
    case AxisRole::look_up:
        controls.look_rad.y += value * look_rad_per_s * dt_s;
        return;
    case AxisRole::push_right:
        controls.push.x += value;
        return;
    case AxisRole::push_up:
        controls.push.y += value;
        return;
    case AxisRole::push_back:
        controls.push.z += value;
        return;
    }
}

constexpr std::size_t most_waiting = 255; ///< presses of one button or hat

/// The rate of a button while it is held, in the order of HeldRole.
struct HeldRate {
    double Controls::*value;
    double by;
};
constexpr HeldRate held[]
    = {{&Controls::throttle_rate, 1}, {&Controls::throttle_rate, -1}, {&Controls::exposure, 1}, {&Controls::exposure, -1}};
static_assert(std::size(held) == std::size_t(HeldRole::darker) + 1);

/// waiting: the button's presses; it loses the one that the controls take. A frame's switch holds one press, so that a
/// second one waits for the next frame.
void press(const ButtonRole& role, std::size_t& waiting, bool down, Controls& controls)
{
    const bool pressed = waiting > 0;
    if (const auto* which = std::get_if<Switch>(&role)) {
        if (pressed && !controls[*which])
            controls.set(*which), --waiting;
    } else if (const auto* which_held = std::get_if<HeldRole>(&role)) {
        const HeldRate& one = held[std::size_t(*which_held)];
        if (down || pressed) {
            controls.*one.value += one.by;
            waiting -= pressed;
        }
    }
}

bool is_hat(const Field& field) { return field.usage == Usage{desktop, hat_switch}; }

/// False for other fields.
bool is_down(const Field& field, std::int64_t raw)
{
    return (is_button(field) && raw != 0) || (is_hat(field) && hat_degrees(field, raw));
}

/// Counts a press where a button or a hat leaves its rest. A hat that is pressed to a corner may pass through a side, so
/// that a press has its last value.
void take_press(const Field& field, std::optional<std::int64_t> before, std::int64_t raw, std::vector<std::int64_t>& presses)
{
    if (!is_down(field, raw))
        return;
    if (before && is_down(field, *before)) {
        if (!presses.empty())
            presses.back() = raw;
    } else if (presses.size() < most_waiting) {
        presses.push_back(raw);
    }
}

bool has(const Descriptor& descriptor, std::uint16_t page, std::uint16_t id)
{
    return std::any_of(descriptor.fields.begin(), descriptor.fields.end(), [&](const Field& f) {
        return is_axis(f) && f.usage == Usage{page, id};
    });
}

} // namespace

bool one_sided(AxisRole role) { return role == AxisRole::throttle || role == AxisRole::faster || role == AxisRole::slower; }

bool is_axis(const Field& field)
{
    const Usage u = field.usage;
    if (!field.array.empty() || field.bits < 2)
        return false;
    return (u.page == desktop && u.id >= axis_x && u.id <= dial) || (u.page == simulation && u.id >= 0xb0 && u.id <= 0xd0);
}

bool take_report(const Descriptor& descriptor, std::span<const std::uint8_t> report, std::int64_t now_ns, DeviceState& state)
{
    state.raw.resize(descriptor.fields.size());
    state.presses.resize(descriptor.fields.size());
    state.health.resize(descriptor.fields.size());
    int id = 0;
    if (descriptor.uses_report_ids) {
        if (report.empty())
            return false;
        id = report[0];
        report = report.subspan(1);
    }
    bool any = false;
    int started = 0;
    for (std::size_t i = 0; i < descriptor.fields.size(); ++i) {
        const Field& field = descriptor.fields[i];
        if (field.report_id != id || std::size_t(field.bit_offset + field.bits + 7) / 8 > report.size())
            continue; // fields beyond a short report keep their values
        const std::int64_t raw = raw_value(field, report);
        // Switches may be on from the first report on.
        started += state.raw[i] && is_down(field, raw) && !is_down(field, *state.raw[i]);
        take_press(field, state.raw[i], raw, state.presses[i]);
        state.raw[i] = raw;
        if (is_axis(field))
            state.health[i].take((centred(field, raw) + 1) / 2, now_ns);
        any = true;
    }
    if (!any)
        return false;
    state.report_ns = now_ns;
    if (started > 0)
        state.pressed_ns = now_ns;
    if (!state.hands.take(started, now_ns))
        state.presses.assign(state.presses.size(), {}); // also those that began the burst
    return true;
}

std::string name_of(const Usage& usage)
{
    constexpr std::array<const char*, 9> names{"X", "Y", "Z", "Rx", "Ry", "Rz", "slider", "dial", "wheel"};
    if (usage.page == desktop && usage.id >= axis_x && usage.id < axis_x + names.size())
        return names[usage.id - axis_x];
    for (const auto& [id, name] : {std::pair{0xb0, "aileron"}, {0xb8, "elevator"}, {0xba, "rudder"}, {0xbb, "throttle"},
             {0xc4, "accelerator"}, {0xc5, "brake"}, {0xc6, "clutch"}, {0xc8, "steering wheel"}})
        if (usage.page == simulation && usage.id == id)
            return name;
    std::string text = "usage ";
    text.append(std::to_string(usage.page)).append("/").append(std::to_string(usage.id));
    return text;
}

double shaped(const AxisUse& use, const Field& field, std::int64_t raw)
{
    double value = centred(field, raw);
    if (use.range) {
        const auto [low, middle, high] = *use.range;
        const double from = double(raw) - middle;
        value = std::clamp(
            (from < 0) == (low < middle) ? from / std::abs(low - middle) : from / std::abs(high - middle), -1.0, 1.0);
        if (high < low)
            value = -value;
    }
    if (use.inverted)
        value = -value;
    if (one_sided(use.role)) {
        const double way = std::clamp(((value + 1) / 2 - use.dead_zone) / std::max(1 - 2 * use.dead_zone, 1e-9), 0.0, 1.0);
        for (double detent : use.detents)
            if (std::abs(way - detent) < detent_reach)
                return detent;
        return way;
    }
    const double size = std::abs(value);
    return size <= use.dead_zone ? 0
                                 : std::copysign(std::pow((size - use.dead_zone) / (1 - use.dead_zone), use.curve), value);
}

Profile usual_profile(const Descriptor& descriptor)
{
    Profile profile;
    profile.name = "its usages";
    const bool pad = std::find(descriptor.applications.begin(), descriptor.applications.end(), Usage{desktop, 5})
        != descriptor.applications.end(),
               six_axes = std::find(descriptor.applications.begin(), descriptor.applications.end(), Usage{desktop, 8})
        != descriptor.applications.end();
    auto use = [&](std::uint16_t page, std::uint16_t id, AxisRole role, bool inverted = false, int nth = 0) {
        AxisUse axis{page, id, nth, role, inverted};
        if (one_sided(role))
            axis.dead_zone = 0.02, axis.curve = 1;
        profile.axes.push_back(axis);
    };
    if (six_axes) {
        use(desktop, axis_x, AxisRole::push_right);
        use(desktop, axis_y, AxisRole::push_back);
        use(desktop, axis_z, AxisRole::push_up, true);
        use(desktop, axis_rx, AxisRole::nose_up);
        use(desktop, axis_rz, AxisRole::nose_right);
        use(desktop, axis_ry, AxisRole::roll_right, true);
        profile.buttons = {{1, Switch::stop}, {2, Switch::home}};
        return profile;
    }
    // HID counts an axis' values from the left and from the far end, so forward is less.
    use(desktop, axis_x, AxisRole::nose_right);
    use(desktop, axis_y, AxisRole::nose_up); // pulled back, the nose goes up
    if (pad) {
        const bool second_is_z = has(descriptor, desktop, axis_z) && has(descriptor, desktop, axis_rz);
        use(desktop, second_is_z ? axis_z : axis_rx, AxisRole::look_right);
        use(desktop, second_is_z ? axis_rz : axis_ry, AxisRole::look_up, true);
        if (has(descriptor, simulation, 0xc4)) {
            use(simulation, 0xc4, AxisRole::faster);
            use(simulation, 0xc5, AxisRole::slower);
        } else if (second_is_z) {
            use(desktop, axis_ry, AxisRole::faster);
            use(desktop, axis_rx, AxisRole::slower);
        }
        profile.buttons = {{1, Switch::stop}, {2, Switch::home}, {3, Switch::doppler}, {4, Switch::headlight},
            {5, Switch::look_ahead}, {6, Switch::aberration}, {9, Switch::hud}, {10, Switch::next_mode}};
        profile.mirrored_buttons = {{5, 6}};
        profile.hat.y = AxisRole::faster;
        return profile;
    }
    use(desktop, axis_rz, AxisRole::roll_right); // the twist
    use(simulation, 0xba, AxisRole::nose_right); // rudder
    use(simulation, 0xb0, AxisRole::roll_right); // aileron
    use(simulation, 0xb8, AxisRole::nose_up); // elevator
    use(simulation, 0xbb, AxisRole::throttle);
    use(simulation, 0xc4, AxisRole::throttle); // accelerator
    // One throttle: the slider, else the remaining axis, else the dial.
    if (has(descriptor, desktop, slider))
        use(desktop, slider, AxisRole::throttle, true);
    else if (has(descriptor, desktop, axis_z))
        use(desktop, axis_z, AxisRole::throttle, true);
    else
        use(desktop, dial, AxisRole::throttle, true);
    profile.buttons = {{1, Switch::stop}, {2, Switch::home}, {3, Switch::undo}, {4, Switch::doppler}, {5, Switch::headlight},
        {6, Switch::aberration}, {7, Switch::hud}, {8, Switch::next_mode}, {9, Switch::menu}};
    profile.hat.x = AxisRole::look_right, profile.hat.y = AxisRole::look_up;
    return profile;
}

Profile left_handed(Profile profile)
{
    const auto swap_roles = [&](AxisRole one, AxisRole other) {
        const auto find = [&](AxisRole role) { return std::ranges::find(profile.axes, role, &AxisUse::role); };
        const auto a = find(one), b = find(other);
        if (a == profile.axes.end() || b == profile.axes.end())
            return;
        std::swap(a->role, b->role);
        std::swap(a->inverted, b->inverted);
        std::swap(a->curve, b->curve);
    };
    swap_roles(AxisRole::nose_right, AxisRole::look_right);
    swap_roles(AxisRole::nose_up, AxisRole::look_up);
    swap_roles(AxisRole::faster, AxisRole::slower);
    for (ButtonUse& use : profile.buttons)
        for (const auto& [one, other] : profile.mirrored_buttons)
            if (use.button == one || use.button == other) {
                use.button = one + other - use.button;
                break;
            }
    return profile;
}

Mapping::Mapping(Descriptor descriptor, Profile profile)
    : descriptor_(std::move(descriptor))
    , profile_(std::move(profile))
{
    for (const AxisUse& use : profile_.axes) {
        int nth = 0;
        for (std::size_t i = 0; i < descriptor_.fields.size(); ++i)
            if (is_axis(descriptor_.fields[i])
                && descriptor_.fields[i].usage == Usage{std::uint16_t(use.page), std::uint16_t(use.usage)}
                && nth++ == use.nth)
                axes_.push_back({i, use});
    }
    for (std::size_t i = 0; i < descriptor_.fields.size(); ++i) {
        const Field& field = descriptor_.fields[i];
        if (is_hat(field) && !hat_)
            hat_ = i;
        if (is_button(field))
            for (const ButtonUse& use : profile_.buttons)
                if (use.button == field.usage.id)
                    buttons_.push_back({i, use.role});
    }
}

InputCapabilities Mapping::capabilities() const
{
    InputCapabilities capabilities;
    for (const Axis& axis : axes_) {
        capabilities.stick |= axis.use.role == AxisRole::nose_right;
        capabilities.lever |= axis.use.role == AxisRole::throttle;
        capabilities.trigger |= axis.use.role == AxisRole::faster;
    }
    for (const Button& button : buttons_)
        for (const auto& [role, number] : {std::pair(Switch::stop, &capabilities.stop_button),
                 {Switch::home, &capabilities.home_button}, {Switch::undo, &capabilities.undo_button}})
            if (button.role == ButtonRole(role) && *number == 0)
                *number = descriptor_.fields[button.field].usage.id;
    return capabilities;
}

DeviceState known_since(DeviceState state, std::int64_t came_ns)
{
    if (state.report_ns <= came_ns) {
        state.raw.assign(state.raw.size(), {});
        state.presses.assign(state.presses.size(), {});
    }
    return state;
}

void Mapping::add(const DeviceState& state, std::int64_t now_ns, double dt_s, Controls& controls)
{
    levers_.clear();
    troubles_.clear();
    auto raw = [&](std::size_t field) { return field < state.raw.size() ? state.raw[field] : std::nullopt; };
    auto presses = [&](std::size_t field) {
        return field < state.presses.size() ? std::span(state.presses[field]) : std::span<const std::int64_t>();
    };
    for (const Axis& axis : axes_) {
        const auto value = raw(axis.field);
        if (!value || axis.use.role == AxisRole::none)
            continue;
        const Field& field = descriptor_.fields[axis.field];
        const AxisHealth health = axis.field < state.health.size() ? state.health[axis.field] : AxisHealth();
        const double wanted = shaped(axis.use, field, *value);
        const bool noisy = health.noisy(now_ns),
                   stuck = axis.use.role != AxisRole::throttle && wanted != 0 && health.still_since_ns() > 0
            && now_ns - health.still_since_ns() > stuck_after_ns;
        if (noisy || stuck)
            troubles_.push_back("axis " + name_of(field.usage) + (noisy ? " jitters" : " is stuck") + " and is left out");
        else if (axis.use.role == AxisRole::throttle)
            levers_.push_back({{}, int(axis.field), wanted, health.moved_ns()});
        else
            add_role(axis.use.role, wanted, dt_s, controls);
    }
    if (state.hands.storms(now_ns)) {
        troubles_.emplace_back("presses come in a burst that no hands make and are left out");
        for (Button& button : buttons_)
            button.waiting = 0;
        hat_waiting_.clear();
        return;
    }
    for (const std::vector<std::int64_t>& of_field : state.presses)
        controls.pressed |= !of_field.empty();
    for (std::size_t i = 0; i < descriptor_.fields.size(); ++i)
        controls.held |= raw(i) && is_down(descriptor_.fields[i], *raw(i));
    for (Button& button : buttons_) {
        button.waiting = std::min(button.waiting + presses(button.field).size(), most_waiting);
        press(button.role, button.waiting, raw(button.field).value_or(0) != 0, controls);
    }
    if (hat_) {
        for (std::int64_t value : presses(*hat_))
            if (hat_waiting_.size() < most_waiting)
                hat_waiting_.push_back(value);
        std::optional<std::int64_t> value = raw(*hat_);
        if (!hat_waiting_.empty()) {
            value = hat_waiting_.front();
            hat_waiting_.pop_front();
        }
        point_hat(value, dt_s, controls);
    }
}

void Mapping::point_hat(std::optional<std::int64_t> value, double dt_s, Controls& controls) const
{
    const auto degrees = value ? hat_degrees(descriptor_.fields[*hat_], *value) : std::nullopt;
    if (!degrees)
        return;
    const double a = *degrees * pi / 180;
    add_role(profile_.hat.x.value_or(AxisRole::none), std::round(std::sin(a)), dt_s, controls);
    add_role(profile_.hat.y.value_or(AxisRole::none), std::round(std::cos(a)), dt_s, controls);
}

} // namespace starbow
