#pragma once
#include "config/model/angles.h"
#include "controls.h"
#include <array>
#include <concepts>
#include <optional>
#include <span>

namespace starbow {

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
/// The number of an aggregate's members.
template <class Part, class... Before> consteval std::size_t count_members()
{
    if constexpr (requires { Part{Before{}..., AnyMember{}}; })
        return count_members<Part, Before..., AnyMember>();
    else
        return sizeof...(Before);
}
/// True if the lists above name each member of the parts. A head is two channels, and `taken` is no number.
template <class... Parts> consteval bool each_number_once()
{
    return all_channels.size() + all_steps.size() == (count_members<Parts>() + ...);
}
static_assert(each_number_once<Steering, Looking, AlignmentSteps>(),
    "a new number of the controls belongs in the lists above, with the way in which it moves the picture");

} // namespace starbow
