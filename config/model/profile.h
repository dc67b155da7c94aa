#pragma once
#include "switches.h"
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace starbow {

/// The role of a device's axis. Forward, right and up are a visitor's; the throttle runs from idle to full.
enum class AxisRole {
    none,
    throttle,
    faster,
    slower,
    nose_up,
    nose_right,
    roll_right,
    look_right,
    look_up,
    push_right,
    push_up,
    push_back
};
/// The rate that a button gives while it is held.
enum class HeldRole : std::uint8_t { faster, slower, brighter, darker };
/// The role of a button: none, a switch that it presses, or a rate while it is held.
using ButtonRole = std::variant<std::monostate, Switch, HeldRole>;

/// An axis of a device by its HID usage, and the treatment of its values.
struct AxisUse {
    int page = 1, usage = 0;
    int nth = 0; ///< index among several axes with this usage, in the descriptor's order
    AxisRole role = AxisRole::none;
    bool inverted = false;
    double dead_zone = 0.06; ///< around the middle, as a part of the way to an end; at idle for a throttle
    double curve = 1.6; ///< exponent: above 1 the middle is finer; throttles are straight
    std::optional<std::array<double, 3>> range; ///< raw values at one end, in the middle and at the other, as calibrated
    std::vector<double> detents; ///< resting places of a throttle, from 0 to 1
    bool operator==(const AxisUse&) const = default;
};

struct ButtonUse {
    int button = 1; ///< as the device counts, from 1
    ButtonRole role;
    bool operator==(const ButtonUse&) const = default;
};

/// A hat's roles; none: the usual ones.
struct Hat {
    std::optional<AxisRole> x, y; ///< to the sides, and up and down
};

/// The use of one kind of device.
struct Profile {
    std::string name;
    int vendor = 0, product = 0;
    std::string serial; ///< of one device among several of its kind; empty: any
    std::vector<AxisUse> axes;
    std::vector<ButtonUse> buttons;
    std::vector<std::array<int, 2>> mirrored_buttons; ///< pairs that change places for a left-handed visitor
    Hat hat;
    std::filesystem::path file;
};

/// Reads and checks a profile. Throws InputError with file, line, JSON pointer, value and what would be right.
Profile load_profile(const std::filesystem::path& file);

/// The profile as a file's text, an axis and a button a line, without members that have their default.
std::string profile_text(const Profile& profile);

/// Writes the whole file or nothing, so that a reader never sees a part; makes its folder. Throws InputError.
void save_profile(const Profile& profile, const std::filesystem::path& file);

/// Four hexadecimal digits, as a profile names a vendor or a product.
std::string hex4(int number);

/// The role's name in a profile's file: "nose-up", "next-mode".
std::string name_of(AxisRole role);
std::string name_of(ButtonRole role);

} // namespace starbow
