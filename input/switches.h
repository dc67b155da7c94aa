#pragma once
#include "controls.h"
#include <array>
#include <concepts>
#include <optional>
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

} // namespace starbow
