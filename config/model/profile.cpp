#include "config/json/whole_file.h"
#include "describe_profile.h"
#include <charconv>
#include <cstdio>

namespace starbow {

extern const std::vector<std::pair<std::string_view, AxisRole>> axis_roles{{"none", AxisRole::none},
    {"throttle", AxisRole::throttle}, {"faster", AxisRole::faster}, {"slower", AxisRole::slower},
    {"nose-up", AxisRole::nose_up}, {"nose-right", AxisRole::nose_right}, {"roll-right", AxisRole::roll_right},
    {"look-right", AxisRole::look_right}, {"look-up", AxisRole::look_up}, {"push-right", AxisRole::push_right},
    {"push-up", AxisRole::push_up}, {"push-back", AxisRole::push_back}};
extern const std::vector<std::pair<std::string_view, ButtonRole>> button_roles = [] {
    static std::array<std::string, all_switches.size()> names;
    std::vector<std::pair<std::string_view, ButtonRole>> roles{{"none", {}}};
    for (const SwitchEntry& one : all_switches)
        if (button_switches[one.which])
            roles.emplace_back(names[std::size_t(one.which)] = dashed(one.name), one.which);
    roles.insert(roles.end(),
        {{"faster", HeldRole::faster}, {"slower", HeldRole::slower}, {"brighter", HeldRole::brighter},
            {"darker", HeldRole::darker}});
    return roles;
}();

int HexId::read(const Place& place, const Folder&) const
{
    const std::string digits = text(place);
    int value = 0;
    const auto end = digits.data() + digits.size();
    if (digits.size() != 4 || std::from_chars(digits.data(), end, value, 16).ptr != end)
        fail_at(place, "is not a USB number; four hexadecimal digits such as \"044f\" are right");
    return value;
}

std::array<double, 3> RawRange::read(const Place& place, const Folder&) const
{
    const glm::dvec3 range = vec3(place, {-2147483648.0, 4294967295.0});
    if (!((range.x < range.y && range.y < range.z) || (range.x > range.y && range.y > range.z)))
        fail_at(place, "has its middle outside its ends; raw values at one end, in the middle and at the other are right");
    return {range.x, range.y, range.z};
}

std::array<int, 2> ButtonPair::read(const Place& place, const Folder&) const
{
    const std::vector<Place> two = items(place, 2, 2, "buttons");
    return {integer(two[0], 1, 128), integer(two[1], 1, 128)};
}

std::string hex4(int number)
{
    std::array<char, 8> text;
    std::snprintf(text.data(), text.size(), "%04x", unsigned(number) & 0xffff);
    return text.data();
}

std::string name_of(AxisRole role) { return std::string(Named{&axis_roles}.name_of(role)); }

std::string name_of(ButtonRole role) { return std::string(Named{&button_roles}.name_of(role)); }

Profile load_profile(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    Profile profile = read<Profile>(root(document));
    profile.file = file;
    return profile;
}

std::string profile_text(const Profile& profile)
{
    const auto lines_of = [](const auto& uses) {
        std::string lines;
        for (const auto& use : uses)
            lines += (lines.empty() ? "[\n        " : ",\n        ") + on_one_line(written_briefly(use));
        return lines + "\n    ]";
    };
    const Json members = written_briefly(profile);
    std::string text;
    for (const auto& [name, value] : members.items())
        text += (text.empty() ? "{\n    \"" : ",\n    \"") + name + "\": "
            + (name == "axes"           ? lines_of(profile.axes)
                    : name == "buttons" ? lines_of(profile.buttons)
                                        : on_one_line(value));
    return text + "\n}\n";
}

void save_profile(const Profile& profile, const std::filesystem::path& file)
{
    const std::string text = profile_text(profile);
    std::error_code problem; // write_whole reports it
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path(), problem);
    // Exhibits are switched off by their mains switch.
    write_whole(file, text, Durability::fsync);
}

} // namespace starbow
