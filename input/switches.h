#pragma once
#include "config/model/angles.h"
#include "controls.h"
#include <array>
#include <concepts>
#include <optional>
#include <span>
#include <utility>

namespace starbow {

/// What a press does to the picture. A calm exhibit holds back every press that changes it at once (calm.h). No value is 0,
/// so that no entry can leave it out.
enum class Leap : std::uint8_t {
    none = 1, ///< nothing at once, or some words: letters alone are too small an area to flash
    press, ///< it changes at once; a second press adds nothing while the first one waits
    toggle, ///< it changes at once; a second press undoes the first
};

struct SwitchEntry {
    const char* name; ///< in records
    bool Controls::*pressed;
    Leap leap;
};

/// Every switch of the controls once, in the order of records. Calm hands, presence and records loop over them.
inline constexpr std::array all_switches{
    SwitchEntry{"look_ahead", &Controls::look_ahead, Leap::press},
    SwitchEntry{"stop", &Controls::stop, Leap::press},
    SwitchEntry{"home", &Controls::home, Leap::press},
    SwitchEntry{"undo", &Controls::undo, Leap::press},
    SwitchEntry{"reset", &Controls::reset, Leap::press},
    SwitchEntry{"next_mode", &Controls::next_mode, Leap::press},
    SwitchEntry{"freeze", &Controls::freeze, Leap::toggle}, // its words are too large an area
    SwitchEntry{"menu", &Controls::menu, Leap::toggle},
    SwitchEntry{"taken", &Controls::taken, Leap::none}, // by the guide, and not pressed
    SwitchEntry{"slow_motion", &Controls::slow_motion, Leap::press}, // its words are too large an area
    SwitchEntry{"aberration", &Controls::aberration, Leap::toggle},
    SwitchEntry{"doppler", &Controls::doppler, Leap::toggle},
    SwitchEntry{"headlight", &Controls::headlight, Leap::toggle},
    SwitchEntry{"false_colours", &Controls::false_colours, Leap::toggle},
    SwitchEntry{"comparison", &Controls::comparison, Leap::press},
    SwitchEntry{"lock_exposure", &Controls::lock_exposure, Leap::none}, // what it lets go is as slow as ever
    SwitchEntry{"range", &Controls::range, Leap::toggle},
    SwitchEntry{"overlay", &Controls::overlay, Leap::press},
    SwitchEntry{"mark", &Controls::mark, Leap::press}, // shows the crosshair and its panel, as `log` does
    SwitchEntry{"log", &Controls::log, Leap::press},
    SwitchEntry{"why", &Controls::why, Leap::press},
    SwitchEntry{"plot", &Controls::plot, Leap::press},
    SwitchEntry{"hud", &Controls::hud, Leap::toggle},
    SwitchEntry{"information", &Controls::information, Leap::press},
    SwitchEntry{"beside", &Controls::beside, Leap::press},
    SwitchEntry{"full_screen", &Controls::full_screen, Leap::toggle},
    SwitchEntry{"quit", &Controls::quit, Leap::none},
    SwitchEntry{"pattern", &Controls::pattern, Leap::press},
    SwitchEntry{"save", &Controls::save, Leap::none},
};

/// How a number of the controls moves the picture.
enum class Way : std::uint8_t {
    rate = 1, ///< from -1 to 1 of the exhibit's limits, at rest at 0
    place, ///< where the hand or the head is now
    change, ///< since the last frame
    light, ///< a rate of the exposure, whose turns are limited where it is shown
};

struct ChannelEntry {
    const char* name;
    std::span<double> (*of)(Controls&); ///< its numbers; none where no device has reported
    Way way;
    double per_s = 0; ///< of a place, and of a place made of changes: a calm exhibit's fastest motion
    double band = 0; ///< of a place: a turn by less is an unsteady hand's
};

/// A calm exhibit's fastest look, and its fastest turn of the ship or of a head.
constexpr double calm_turn_deg_per_s = 20;

/// Every number of the controls once. Calm hands loop over them.
inline constexpr std::array all_channels{
    ChannelEntry{"lever", [](Controls& c) { return c.lever ? std::span(&*c.lever, 1) : std::span<double>(); }, Way::place, 4,
        0.02}, // a hand's, and a worn sensor's
    ChannelEntry{"throttle_rate", [](Controls& c) { return std::span(&c.throttle_rate, 1); }, Way::rate},
    ChannelEntry{"push", [](Controls& c) { return std::span(&c.push[0], 3); }, Way::rate},
    ChannelEntry{"turn", [](Controls& c) { return std::span(&c.turn[0], 3); }, Way::rate},
    ChannelEntry{
        "look_rad", [](Controls& c) { return std::span(&c.look_rad[0], 2); }, Way::change, calm_turn_deg_per_s* degree, 0},
    ChannelEntry{"head_m", [](Controls& c) { return std::span(&c.head.moved_m[0], 3); }, Way::place, 0.3, 0.01},
    ChannelEntry{"head_turned", [](Controls& c) { return std::span(&c.head.turned[0], 4); }, Way::place,
        calm_turn_deg_per_s* degree / 2, 0.005}, // a quaternion's numbers are of half the angle
    ChannelEntry{"exposure", [](Controls& c) { return std::span(&c.exposure, 1); }, Way::light},
};

/// Every whole number of the controls once: steps of a builder's, which change the picture at once.
inline constexpr std::array all_steps{&Controls::choose, &Controls::turn_by};

/// Initializes a member of any type. An optional takes its value from it, so that there is one way to convert.
struct AnyMember {
    template <class T>
    requires(!std::same_as<T, std::optional<double>>) operator T() const;
};
/// Initializes a member of this type alone.
template <class Member> struct OnlyMember {
    template <class T>
    requires std::same_as<T, Member>
    operator T() const;
};

/// The number of an aggregate's members.
template <class Part, class... Before> consteval std::size_t count_members()
{
    if constexpr (requires { Part{Before{}..., AnyMember{}}; })
        return count_members<Part, Before..., AnyMember>();
    else
        return sizeof...(Before);
}
/// The number of an aggregate's members of one type.
template <class Part, class Member, class... Before> consteval std::size_t count_members_of()
{
    if constexpr (!requires { Part{Before{}..., AnyMember{}}; }) {
        return 0;
    } else {
        constexpr bool is = requires { Part{Before{}..., OnlyMember<Member>{}}; };
        return is + count_members_of<Part, Member, Before..., AnyMember>();
    }
}
/// True if the lists above name each member of the parts. A head is two channels.
template <class... Parts> consteval bool each_number_once()
{
    return all_channels.size() + all_steps.size() == ((count_members<Parts>() - count_members_of<Parts, bool>()) + ...) + 1;
}
template <class... Parts> consteval bool each_switch_once()
{
    for (std::size_t i = 0; i < all_switches.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (all_switches[i].pressed == all_switches[j].pressed)
                return false;
    return all_switches.size() == (count_members_of<Parts, bool>() + ...);
}
static_assert(each_switch_once<Steering, Looking, EffectSwitches, LabSwitches, WindowSwitches, AlignmentKeys>(),
    "a new switch belongs in the list above, with what it does to the picture");
static_assert(each_number_once<Steering, Looking, EffectSwitches, LabSwitches, WindowSwitches, AlignmentKeys>(),
    "a new number of the controls belongs in the lists above, with the way in which it moves the picture");

} // namespace starbow
