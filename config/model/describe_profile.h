#pragma once
#include "config/json/describe.h"
#include "profile.h"

namespace starbow {

// Profiles of devices, as config/json/describe.h says.

extern const std::vector<std::pair<std::string_view, AxisRole>> axis_roles;
extern const std::vector<std::pair<std::string_view, ButtonRole>> button_roles;

/// Four hexadecimal digits, as lsusb and `starbow devices` print them.
struct HexId {
    int read(const Place& place, const Folder&) const;
    Json written(int id) const { return hex4(id); }
    Json schema(Json&) const { return {{"type", "string"}, {"pattern", "^[0-9a-fA-F]{4}$"}}; }
};
/// Raw values of an axis at one end, in the middle and at the other.
struct RawRange {
    std::array<double, 3> read(const Place& place, const Folder&) const;
    Json written(const std::array<double, 3>& range) const { return range; }
    Json schema(Json& definitions) const { return Numbers<3>{{-2147483648.0, 4294967295.0}}.schema(definitions); }
};
struct ButtonPair {
    std::array<int, 2> read(const Place& place, const Folder& folder) const;
    Json written(const std::array<int, 2>& pair) const { return pair; }
    Json schema(Json& definitions) const { return WholePair{1, 128}.schema(definitions); }
};

template <>
inline constexpr auto description<AxisUse> = describe<AxisUse>("axis",
    "The role of an axis, and the treatment of its values.",
    field("page", Whole{1, 65535}, "HID usage page: 1 generic desktop, 2 simulation. No unit.", &AxisUse::page),
    needed("usage", Whole{1, 65535}, "HID usage: 48 X, 49 Y, 50 Z, 51 Rx, 52 Ry, 53 Rz, 54 slider, 55 dial. No unit.",
        &AxisUse::usage),
    field("nth", Whole{0, 31}, "The index among several axes with this usage, in the device's order, from 0. No unit.",
        &AxisUse::nth),
    needed("role", Named{&axis_roles}, "The axis' role. throttle: its place sets the speed. faster, slower: triggers.",
        &AxisUse::role),
    field("inverted", Flag{}, "true: its ends are exchanged. Sticks and sliders count from the left and from the far end.",
        &AxisUse::inverted),
    field("dead_zone", Number{{0, 0.5}},
        "Part of the travel around the middle (of a throttle at its ends) that does nothing, 0 to 0.5.",
        &AxisUse::dead_zone),
    field("curve", Number{{0.2, 5}}, "Exponent: above 1 the middle is finer. No unit; throttles and triggers are straight.",
        &AxisUse::curve),
    field("range", RawRange{},
        "Raw values at one end, in the middle and at the other, as calibrated; without it the device's own range.",
        &AxisUse::range),
    field("detents", List{Number{{0, 1}}, 1, 16, "places from 0 to 1"}, "Resting places of a throttle, 0 to 1.",
        &AxisUse::detents));
static_assert(is_complete<AxisUse>());

template <>
inline constexpr auto description<ButtonUse> = describe<ButtonUse>("button", "The role of a button.",
    needed("button", Whole{1, 128}, "The button's number, as the device counts, from 1. No unit.", &ButtonUse::button),
    needed("role", Named{&button_roles}, "The button's role.", &ButtonUse::role));
static_assert(is_complete<ButtonUse>());

template <>
inline constexpr auto description<Hat> = describe<Hat>("hat", "The hat's roles.",
    field("x", Named{&axis_roles}, "To the sides.", &Hat::x), field("y", Named{&axis_roles}, "Up and down.", &Hat::y));
static_assert(is_complete<Hat>());

template <>
inline constexpr auto description<Profile> = describe_file<Profile>("profile",
    "The use of one kind of stick, throttle, pad or space mouse.",
    needed("name", Text{}, "The device's name, for people.", &Profile::name),
    needed(
        "vendor", HexId{}, "USB vendor, four hexadecimal digits, as starbow devices and lsusb print it.", &Profile::vendor),
    needed("product", HexId{}, "USB product, four hexadecimal digits.", &Profile::product),
    field("serial", Text{},
        "Serial number of one device among several of its kind; without it the profile is for all of them.",
        &Profile::serial),
    field("axes", List{Object<AxisUse>{}, 0, 64, "axes"}, "The roles of the axes. Other axes do nothing.", &Profile::axes),
    field("buttons", List{Object<ButtonUse>{}, 0, 128, "buttons"}, "The roles of the buttons. Other buttons do nothing.",
        &Profile::buttons),
    field("mirrored_buttons", List{ButtonPair{}, 0, 64, "pairs of buttons"},
        "Pairs of buttons that change places for a left-handed visitor.", &Profile::mirrored_buttons),
    field("hat", Object<Hat>{}, "", &Profile::hat), not_in_file(&Profile::file));
static_assert(is_complete<Profile>());

} // namespace starbow
