#include "profile.h"
#include "reader.h"
#include <charconv>

namespace starbow {
namespace {

const std::vector<std::pair<std::string_view, AxisRole>> axis_roles{{"none", AxisRole::none},
    {"throttle", AxisRole::throttle}, {"faster", AxisRole::faster}, {"slower", AxisRole::slower},
    {"nose-up", AxisRole::nose_up}, {"nose-right", AxisRole::nose_right}, {"roll-right", AxisRole::roll_right},
    {"look-right", AxisRole::look_right}, {"look-up", AxisRole::look_up}, {"push-right", AxisRole::push_right},
    {"push-up", AxisRole::push_up}, {"push-back", AxisRole::push_back}};
const std::vector<std::pair<std::string_view, ButtonRole>> button_roles{{"none", ButtonRole::none},
    {"stop", ButtonRole::stop}, {"home", ButtonRole::home}, {"undo", ButtonRole::undo}, {"next-mode", ButtonRole::next_mode},
    {"look-ahead", ButtonRole::look_ahead}, {"aberration", ButtonRole::aberration}, {"doppler", ButtonRole::doppler},
    {"headlight", ButtonRole::headlight}, {"hud", ButtonRole::hud}, {"faster", ButtonRole::faster},
    {"slower", ButtonRole::slower}, {"brighter", ButtonRole::brighter}, {"darker", ButtonRole::darker}};

/// Four hexadecimal digits, as lsusb and `starbow devices` print them.
int hex_id(const Place& place)
{
    const std::string digits = text(place);
    int value = 0;
    const auto end = digits.data() + digits.size();
    if (digits.size() != 4 || std::from_chars(digits.data(), end, value, 16).ptr != end)
        complain(place, "is no USB number; four hexadecimal digits such as \"044f\" are right");
    return value;
}

AxisUse read_axis(const Place& place)
{
    only(place, {"page", "usage", "nth", "role", "inverted", "dead_zone", "curve", "range", "detents"});
    AxisUse use;
    if (auto p = find(place, "page"))
        use.page = integer(*p, 1, 65535);
    use.usage = integer(member(place, "usage"), 1, 65535);
    if (auto p = find(place, "nth"))
        use.nth = integer(*p, 0, 31);
    use.role = chosen(member(place, "role"), axis_roles);
    take(place, "inverted", use.inverted);
    take(place, "dead_zone", use.dead_zone, {0, 0.5});
    take(place, "curve", use.curve, {0.2, 5});
    if (auto p = find(place, "range")) {
        const glm::dvec3 range = vec3(*p, {-2147483648.0, 4294967295.0});
        if (!((range.x < range.y && range.y < range.z) || (range.x > range.y && range.y > range.z)))
            complain(
                *p, "has its middle not between its ends; raw values at one end, in the middle and at the other are right");
        use.range = {range.x, range.y, range.z};
    }
    if (auto p = find(place, "detents"))
        for (const Place& at : items(*p, 1, 16, "places from 0 to 1"))
            use.detents.push_back(number(at, {0, 1}));
    return use;
}

} // namespace

Profile load_profile(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    only(top, {"$schema", "name", "vendor", "product", "serial", "axes", "buttons", "hat"});
    Profile profile;
    profile.file = file;
    profile.name = text(member(top, "name"));
    profile.vendor = hex_id(member(top, "vendor"));
    profile.product = hex_id(member(top, "product"));
    if (auto p = find(top, "serial"))
        profile.serial = text(*p);
    if (auto p = find(top, "axes"))
        for (const Place& at : items(*p, 0, 64, "axes"))
            profile.axes.push_back(read_axis(at));
    if (auto p = find(top, "buttons"))
        for (const Place& at : items(*p, 0, 128, "buttons")) {
            only(at, {"button", "role"});
            profile.buttons.push_back({integer(member(at, "button"), 1, 128), chosen(member(at, "role"), button_roles)});
        }
    if (auto p = find(top, "hat")) {
        only(*p, {"x", "y"});
        if (auto x = find(*p, "x"))
            profile.hat_x = chosen(*x, axis_roles);
        if (auto y = find(*p, "y"))
            profile.hat_y = chosen(*y, axis_roles);
    }
    return profile;
}

} // namespace starbow
