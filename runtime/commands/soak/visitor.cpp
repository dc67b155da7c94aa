#include "visitor.h"
#include "config/model/shot.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// The switches that a visitor can press. Not among them: the end of the exhibit, the full screen, which a window of a test
/// has no use for, and the key that writes into a file.
constexpr Switches pressed = switches_where([](const SwitchEntry& one) {
    return one.which != Switch::quit && one.which != Switch::full_screen && one.which != Switch::save;
});

/// On average. A switch costs a driver in software some tenths of a second for new pipelines, a world as much.
constexpr double held_key_s = 0.5, switch_every_s = 1.5, direction_every_s = 1.5;

/// Frames of a visit where all visitors do the same.
constexpr int like_frames = 50, reload_frames = 10;

} // namespace

SeededVisitor::SeededVisitor(Use use, std::uint64_t seed, long visit, const SoakNames& choices)
    : random_(seed * 0x9e3779b97f4a7c15u + std::uint64_t(visit))
    , choices_(choices)
    , kind_(Kind(std::discrete_distribution<int>({4, 4, 1, 3})(random_)))
    , frames_(std::uniform_int_distribution<int>(8, 42)(random_))
    , lever_(uniform(0, 1))
{
    if (use == Use::visitors)
        return;
    kind_ = use == Use::flight ? Kind::stick : Kind::watcher;
    frames_ = use == Use::reloads ? reload_frames : like_frames;
}

void SeededVisitor::act(RecordEntry& entry, double dt_s)
{
    Controls& controls = entry.controls;
    switch (kind_) {
    case Kind::keys:
        return press_keys(controls, dt_s);
    case Kind::stick:
        return move_stick(controls, dt_s);
    case Kind::watcher:
        return;
    case Kind::docent:
        move_stick(controls, dt_s);
        if (chance(dt_s / direction_every_s))
            entry.commands.push_back(direction());
    }
}

void SeededVisitor::press_keys(Controls& controls, double dt_s)
{
    for (const SwitchEntry& one : all_switches)
        if (pressed[one.which] && chance(dt_s / switch_every_s / double(all_switches.size())))
            controls.set(one.which);
    // Held keys: full rates, or none.
    const auto held = [&](double now) {
        return chance(dt_s / held_key_s) ? double(std::uniform_int_distribution<int>(-1, 1)(random_)) : now;
    };
    for (int axis = 0; axis < 3; ++axis)
        turn_[axis] = held(turn_[axis]), push_[axis] = held(push_[axis]);
    lever_ = held(lever_);
    controls.turn = turn_, controls.push = push_;
    controls.throttle_rate = std::clamp(lever_, -1.0, 1.0);
    controls.look_rad = glm::dvec2(uniform(-0.05, 0.05), uniform(-0.05, 0.05));
    controls.pressed = controls.held = chance(dt_s / held_key_s);
    controls.exposure = chance(0.1) ? uniform(-1, 1) : 0;
}

void SeededVisitor::move_stick(Controls& controls, double dt_s)
{
    for (int axis = 0; axis < 3; ++axis)
        turn_[axis] = std::clamp(turn_[axis] + uniform(-4, 4) * dt_s, -1.0, 1.0);
    lever_ = std::clamp(lever_ + uniform(-1.5, 1.5) * dt_s, 0.0, 1.0);
    controls.turn = turn_, controls.lever = lever_;
    for (const auto button :
        std::initializer_list<Switch>{Switch::stop, Switch::home, Switch::next_mode, Switch::overlay, Switch::comparison})
        if (chance(dt_s / switch_every_s / 10))
            controls.set(button);
}

Command SeededVisitor::direction()
{
    if (chance(0.3)) { // a world takes the longest
        switch (std::uniform_int_distribution<int>(0, 2)(random_)) {
        case 0:
            return {.kind = CommandKind::scene, .text = any(choices_.scenes)};
        case 1:
            return {.kind = CommandKind::shot, .text = any(choices_.shots)};
        default:
            return {.kind = CommandKind::tour, .text = any(choices_.tours)};
        }
    }
    const std::span<const CommandRule> rules = command_rules();
    for (;;) {
        Command command{.kind = rules[std::uniform_int_distribution<std::size_t>(0, rules.size() - 1)(random_)].kind};
        command.on = chance(0.5);
        switch (command.kind) {
        case CommandKind::scene:
        case CommandKind::shot:
        case CommandKind::tour:
        case CommandKind::layout: // the soak saves layouts in its own file
        case CommandKind::restart:
        case CommandKind::keep:
            continue;
        case CommandKind::speed_limit:
            command.number = std::exp2(uniform(0.1, 20));
            break;
        case CommandKind::exposure:
            command.number = uniform(-2, 2);
            break;
        case CommandKind::comparison:
            command.text = comparison_names[std::uniform_int_distribution<std::size_t>(0, 2)(random_)];
            break;
        case CommandKind::language:
            command.text = any(choices_.languages);
            break;
        case CommandKind::caption:
            command.text = "Nothing is faster than light: " + std::to_string(std::uniform_int_distribution<int>()(random_));
            break;
        case CommandKind::pattern:
            command.text = chance(0.5) ? "none" : "grid";
            break;
        case CommandKind::quality:
            command.text = any(choices_.qualities);
            break;
        case CommandKind::grip: // most layouts lack it, and refuse it
            command.text = "desk, yaw";
            break;
        case CommandKind::move:
            command.number = uniform(-20, 20), command.second = uniform(-20, 20);
            break;
        default:
            break;
        }
        return command;
    }
}

} // namespace starbow
