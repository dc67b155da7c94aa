#include "profile.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <span>

namespace starbow {
namespace {

const std::vector<std::pair<std::string_view, AxisRole>> axis_roles{{"none", AxisRole::none},
    {"throttle", AxisRole::throttle}, {"faster", AxisRole::faster}, {"slower", AxisRole::slower},
    {"nose-up", AxisRole::nose_up}, {"nose-right", AxisRole::nose_right}, {"roll-right", AxisRole::roll_right},
    {"look-right", AxisRole::look_right}, {"look-up", AxisRole::look_up}, {"push-right", AxisRole::push_right},
    {"push-up", AxisRole::push_up}, {"push-back", AxisRole::push_back}};
const std::vector<std::pair<std::string_view, ButtonRole>> button_roles{{"none", ButtonRole::none},
    {"stop", ButtonRole::stop}, {"home", ButtonRole::home}, {"undo", ButtonRole::undo}, {"next-mode", ButtonRole::next_mode},
    {"freeze", ButtonRole::freeze}, {"menu", ButtonRole::menu}, {"slow-motion", ButtonRole::slow_motion},
    {"look-ahead", ButtonRole::look_ahead}, {"aberration", ButtonRole::aberration}, {"doppler", ButtonRole::doppler},
    {"headlight", ButtonRole::headlight}, {"false-colours", ButtonRole::false_colours},
    {"comparison", ButtonRole::comparison}, {"range", ButtonRole::range}, {"hud", ButtonRole::hud},
    {"information", ButtonRole::information}, {"beside", ButtonRole::beside}, {"plot", ButtonRole::plot},
    {"overlay", ButtonRole::overlay}, {"mark", ButtonRole::mark}, {"log", ButtonRole::log}, {"why", ButtonRole::why},
    {"faster", ButtonRole::faster}, {"slower", ButtonRole::slower}, {"brighter", ButtonRole::brighter},
    {"darker", ButtonRole::darker}};

/// Four hexadecimal digits, as lsusb and `starbow devices` print them.
int hex_id(const Place& place)
{
    const std::string digits = text(place);
    int value = 0;
    const auto end = digits.data() + digits.size();
    if (digits.size() != 4 || std::from_chars(digits.data(), end, value, 16).ptr != end)
        complain(place, "is not a USB number; four hexadecimal digits such as \"044f\" are right");
    return value;
}

AxisUse read_axis(const Place& place)
{
    reject_unknown_members(place, {"page", "usage", "nth", "role", "inverted", "dead_zone", "curve", "range", "detents"});
    AxisUse use;
    if (auto p = find_member(place, "page"))
        use.page = integer(*p, 1, 65535);
    use.usage = integer(member(place, "usage"), 1, 65535);
    if (auto p = find_member(place, "nth"))
        use.nth = integer(*p, 0, 31);
    use.role = chosen(member(place, "role"), axis_roles);
    take(place, "inverted", use.inverted);
    take(place, "dead_zone", use.dead_zone, {0, 0.5});
    take(place, "curve", use.curve, {0.2, 5});
    if (auto p = find_member(place, "range")) {
        const glm::dvec3 range = vec3(*p, {-2147483648.0, 4294967295.0});
        if (!((range.x < range.y && range.y < range.z) || (range.x > range.y && range.y > range.z)))
            complain(*p, "has its middle outside its ends; raw values at one end, in the middle and at the other are right");
        use.range = {range.x, range.y, range.z};
    }
    if (auto p = find_member(place, "detents"))
        for (const Place& at : items(*p, 1, 16, "places from 0 to 1"))
            use.detents.push_back(number(at, {0, 1}));
    return use;
}

template <class Role> std::string name_in(const std::vector<std::pair<std::string_view, Role>>& all, Role role)
{
    for (const auto& [name, which] : all)
        if (which == role)
            return std::string(name);
    return "none";
}

/// A text in double quotes. Bytes that are no UTF-8 are replaced: a JSON file needs UTF-8.
std::string quoted(const std::string& text)
{
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The shortest text that reads back as the same number.
std::string exact(double number)
{
    return std::abs(number) < 1e15 && number == std::trunc(number) ? std::to_string(std::int64_t(number))
                                                                   : nlohmann::json(number).dump();
}

std::string listed(std::span<const double> numbers)
{
    std::string text;
    for (double number : numbers)
        text += (text.empty() ? "[" : ", ") + exact(number);
    return text + "]";
}

std::string line_of(const AxisUse& use)
{
    const AxisUse usual;
    std::string line = "{ ";
    if (use.page != usual.page)
        line += "\"page\": " + std::to_string(use.page) + ", ";
    line += "\"usage\": " + std::to_string(use.usage);
    if (use.nth != usual.nth)
        line += ", \"nth\": " + std::to_string(use.nth);
    line += ", \"role\": " + quoted(name_of(use.role));
    if (use.inverted)
        line += ", \"inverted\": true";
    if (use.dead_zone != usual.dead_zone)
        line += ", \"dead_zone\": " + exact(use.dead_zone);
    if (use.curve != usual.curve)
        line += ", \"curve\": " + exact(use.curve);
    if (use.range)
        line += ", \"range\": " + listed(*use.range);
    if (!use.detents.empty())
        line += ", \"detents\": " + listed(use.detents);
    return line + " }";
}

template <class Use, class Line> std::string block(const std::vector<Use>& uses, Line line)
{
    std::string text;
    for (const Use& use : uses)
        text += (text.empty() ? "[\n        " : ",\n        ") + line(use);
    return text.empty() ? "[]" : text + "\n    ]";
}

} // namespace

std::string hex4(int number)
{
    std::array<char, 8> text;
    std::snprintf(text.data(), text.size(), "%04x", unsigned(number) & 0xffff);
    return text.data();
}

std::string name_of(AxisRole role) { return name_in(axis_roles, role); }

std::string name_of(ButtonRole role) { return name_in(button_roles, role); }

Profile load_profile(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(
        top, {"$schema", "name", "vendor", "product", "serial", "axes", "buttons", "mirrored_buttons", "hat"});
    Profile profile;
    profile.file = file;
    profile.name = text(member(top, "name"));
    profile.vendor = hex_id(member(top, "vendor"));
    profile.product = hex_id(member(top, "product"));
    if (auto p = find_member(top, "serial"))
        profile.serial = text(*p);
    if (auto p = find_member(top, "axes"))
        for (const Place& at : items(*p, 0, 64, "axes"))
            profile.axes.push_back(read_axis(at));
    if (auto p = find_member(top, "buttons"))
        for (const Place& at : items(*p, 0, 128, "buttons")) {
            reject_unknown_members(at, {"button", "role"});
            profile.buttons.push_back({integer(member(at, "button"), 1, 128), chosen(member(at, "role"), button_roles)});
        }
    if (auto p = find_member(top, "mirrored_buttons"))
        for (const Place& pair : items(*p, 0, 64, "pairs of buttons")) {
            const std::vector<Place> two = items(pair, 2, 2, "buttons");
            profile.mirrored_buttons.push_back({integer(two[0], 1, 128), integer(two[1], 1, 128)});
        }
    if (auto p = find_member(top, "hat")) {
        reject_unknown_members(*p, {"x", "y"});
        if (auto x = find_member(*p, "x"))
            profile.hat_x = chosen(*x, axis_roles);
        if (auto y = find_member(*p, "y"))
            profile.hat_y = chosen(*y, axis_roles);
    }
    return profile;
}

std::string profile_text(const Profile& profile)
{
    std::vector<std::string> members{"\"name\": " + quoted(profile.name), "\"vendor\": " + quoted(hex4(profile.vendor)),
        "\"product\": " + quoted(hex4(profile.product))};
    if (!profile.serial.empty())
        members.push_back("\"serial\": " + quoted(profile.serial));
    if (!profile.axes.empty())
        members.push_back("\"axes\": " + block(profile.axes, line_of));
    if (!profile.buttons.empty())
        members.push_back("\"buttons\": " + block(profile.buttons, [](const ButtonUse& use) {
            return "{ \"button\": " + std::to_string(use.button) + ", \"role\": " + quoted(name_of(use.role)) + " }";
        }));
    if (!profile.mirrored_buttons.empty()) {
        std::string pairs;
        for (const auto& [one, other] : profile.mirrored_buttons)
            pairs += (pairs.empty() ? "[" : ", [") + std::to_string(one) + ", " + std::to_string(other) + "]";
        members.push_back("\"mirrored_buttons\": [" + pairs + "]");
    }
    std::string hat;
    if (profile.hat_x)
        hat += "\"x\": " + quoted(name_of(*profile.hat_x));
    if (profile.hat_y)
        hat += (hat.empty() ? "" : ", ") + ("\"y\": " + quoted(name_of(*profile.hat_y)));
    if (!hat.empty())
        members.push_back("\"hat\": { " + hat + " }");
    std::string text;
    for (const std::string& member : members)
        text += (text.empty() ? "{\n    " : ",\n    ") + member;
    return text + "\n}\n";
}

void save_profile(const Profile& profile, const std::filesystem::path& file)
{
    const std::string text = profile_text(profile);
    std::error_code problem; // write_whole reports it
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path(), problem);
    // Exhibits are switched off by their mains switch.
    write_whole(file, text, Lasting::power_cut);
}

} // namespace starbow
