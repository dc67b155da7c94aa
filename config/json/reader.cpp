#include "reader.h"
#include "edit_distance.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace starbow {
using nlohmann::json;

namespace {

std::string value_text(const json& value)
{
    // A message shows a path's end; a list's beginning is enough.
    return one_line(value.dump(-1, ' ', false, json::error_handler_t::replace), value.is_string() ? 160 : 60);
}

std::string phrase(Range range)
{
    const std::string low = shown(range.low), high = shown(range.high);
    return "a number " + (range.low_open ? "above " + low + " up to " + high : "from " + low + " to " + high) + " is right";
}

std::string choice(const std::vector<std::string_view>& names)
{
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i)
        out += (i == 0 ? "\"" : i + 1 == names.size() ? " or \"" : ", \"") + std::string(names[i]) + "\"";
    return out;
}

} // namespace

Place root(const Document& document) { return {&document, &document.root, ""}; }

void fail_at(const Place& place, const std::string& problem)
{
    const std::optional<Span> span = find_span(*place.document, place.pointer);
    throw InputError(place.document->file + (span ? ":" + std::to_string(span->line) : ""), one_line(place.pointer),
        value_text(*place.json) + " " + problem);
}

double number(const Place& place, Range range)
{
    if (!place.json->is_number())
        fail_at(place, "is not a number; " + phrase(range));
    const double value = place.json->get<double>();
    if (value < range.low || (range.low_open && value == range.low))
        fail_at(place, "is too small; " + phrase(range));
    if (!(value <= range.high))
        fail_at(place, "is too large; " + phrase(range));
    return value;
}

int integer(const Place& place, int low, int high)
{
    const double value = number(place, {double(low), double(high)});
    if (value != std::floor(value))
        fail_at(
            place, "is not a whole number; one from " + std::to_string(low) + " to " + std::to_string(high) + " is right");
    return int(value);
}

bool boolean(const Place& place)
{
    if (!place.json->is_boolean())
        fail_at(place, "is neither true nor false; one of these is right");
    return place.json->get<bool>();
}

std::string text(const Place& place)
{
    if (!place.json->is_string())
        fail_at(place, "is not a text; a text in double quotes is right");
    const std::string value = place.json->get<std::string>();
    if (value.empty())
        fail_at(place, "is empty; a text with at least one letter is right");
    if (plain_text(value) != value)
        fail_at(place, "holds a control character; a text without them is right");
    return value;
}

std::string one_of(const Place& place, const std::vector<std::string_view>& choices)
{
    if (place.json->is_string())
        for (std::string_view name : choices)
            if (place.json->get_ref<const std::string&>() == name)
                return std::string(name);
    fail_at(place, "is not known here; " + choice(choices) + " is right");
}

std::size_t index_named(std::string_view name, const std::vector<std::string_view>& names, const std::string& kind)
{
    const auto at = std::ranges::find(names, name);
    if (at == names.end())
        throw InputError(
            "the " + kind + " " + one_line(std::string(name), 40) + " is not known; " + choice(names) + " is right");
    return std::size_t(at - names.begin());
}

std::vector<Place> elements(const Place& array)
{
    std::vector<Place> places;
    for (std::size_t i = 0; i < array.json->size(); ++i)
        places.push_back({array.document, &(*array.json)[i], array.pointer + "/" + std::to_string(i)});
    return places;
}

std::vector<Place> items(const Place& place, std::size_t least, std::size_t most, const std::string& what)
{
    const std::string right = "a list of " + (least == most ? "" : std::to_string(least) + " to ") + std::to_string(most)
        + " " + what + " in [ ] is right";
    if (!place.json->is_array())
        fail_at(place, "is not a list; " + right);
    const std::size_t count = place.json->size();
    if (count < least || count > most)
        fail_at(place, "has length " + std::to_string(count) + "; " + right);
    return elements(place);
}

glm::dvec2 vec2(const Place& place, Range range)
{
    const std::vector<Place> at = items(place, 2, 2, "numbers");
    return {number(at[0], range), number(at[1], range)};
}

glm::dvec3 vec3(const Place& place, Range range)
{
    const std::vector<Place> at = items(place, 3, 3, "numbers");
    return {number(at[0], range), number(at[1], range), number(at[2], range)};
}

glm::dvec4 vec4(const Place& place, Range range)
{
    const std::vector<Place> at = items(place, 4, 4, "numbers");
    return {number(at[0], range), number(at[1], range), number(at[2], range), number(at[3], range)};
}

/// Names of members in older files, with their present names.
const std::map<std::string_view, std::string_view> renamed{
    {"against", "relative_to"},
    {"greatest_ev", "max_ev"},
    {"greatest_gamma", "max_gamma"},
    {"hold_ms", "frame_budget_ms"},
    {"least_ev", "min_ev"},
    {"most_texels_per_pixel", "max_texels_per_pixel"},
    {"rear_images", "clip_levels"},
    {"rungs", "levels"},
    {"shading_texels", "lod_shading_texels"},
    {"stray_texels", "lod_error_texels"},
    {"told", "explanation"},
    {"told_s", "explanation_s"},
    {"what", "quantity"},
};

void reject_unknown_members(const Place& place, const std::vector<std::string_view>& known)
{
    if (!place.json->is_object())
        fail_at(place, "is not an object; an object in { } is right");
    for (const auto& [name, value] : place.json->items()) {
        if (std::find(known.begin(), known.end(), name) != known.end())
            continue;
        if (const auto now = renamed.find(name);
            now != renamed.end() && std::find(known.begin(), known.end(), now->second) != known.end())
            fail_at({place.document, &value, place.pointer + "/" + escaped(name)},
                "stands under a name of older files; \"" + std::string(now->second) + "\" is its name now");
        const std::string word = one_line(name, 60);
        std::vector<std::string_view> nearest = known;
        std::stable_sort(nearest.begin(), nearest.end(), [&](std::string_view a, std::string_view b) {
            return edit_distance<std::string_view>(word, a) < edit_distance<std::string_view>(word, b);
        });
        nearest.resize(std::min<std::size_t>(nearest.size(), 3));
        fail_at({place.document, &value, place.pointer + "/" + escaped(name)},
            "stands under an unknown name; " + choice(nearest) + " is right");
    }
}

std::optional<Place> find_member(const Place& place, const std::string& name)
{
    const auto found = place.json->find(name);
    if (found == place.json->end())
        return {};
    return Place{place.document, &*found, place.pointer + "/" + escaped(name)};
}

void read_optional(const Place& place, const std::string& name, double& value, Range range)
{
    if (auto p = find_member(place, name))
        value = number(*p, range);
}

void read_optional(const Place& place, const std::string& name, bool& value)
{
    if (auto p = find_member(place, name))
        value = boolean(*p);
}

void read_optional(const Place& place, const std::string& name, glm::dvec2& value, Range range)
{
    if (auto p = find_member(place, name))
        value = vec2(*p, range);
}

void read_optional(const Place& place, const std::string& name, glm::dvec3& value, Range range)
{
    if (auto p = find_member(place, name))
        value = vec3(*p, range);
}

Place member(const Place& place, const std::string& name)
{
    if (auto found = find_member(place, name))
        return *found;
    fail_at(place, "lacks \"" + name + "\"; an object with this member is right");
}

std::string escaped(const std::string& name)
{
    std::string out;
    for (char c : name)
        out += c == '~' ? std::string("~0") : c == '/' ? std::string("~1") : std::string(1, c);
    return out;
}

std::string shown(double number)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

namespace {

/// The number of bytes of the UTF-8 character at `at`, and its code point (RFC 3629); 0 bytes where there is none.
std::pair<std::size_t, std::uint32_t> character(std::string_view text, std::size_t at)
{
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(at);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
    if (length < 2 || at + length > text.size())
        return {length == 1 ? 1 : 0, lead};
    std::uint32_t code = lead & (0x7f >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80)
            return {0, 0};
        code = code << 6 | (byte(at + i) & 0x3f);
    }
    // Longer than needed, a half of a surrogate pair, beyond Unicode.
    if ((length == 3 && code < 0x800) || (length == 4 && code < 0x10000) || (code >= 0xd800 && code < 0xe000)
        || code > 0x10ffff)
        return {0, 0};
    return {length, code};
}

/// True for a character that steers a terminal, or the direction of writing.
bool steers(std::uint32_t code)
{
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x061c || code == 0x200e || code == 0x200f
        || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

} // namespace

std::string plain_text(const std::string& text)
{
    std::string out;
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const auto [length, code] = character(text, at);
        if (length == 0 || steers(code))
            out += '?';
        else
            out.append(text, at, length);
        at += std::max<std::size_t>(length, 1);
    }
    return out;
}

std::string one_line(std::string text, std::size_t most)
{
    text = plain_text(text);
    if (text.size() > most) {
        std::size_t cut = most;
        while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) // not inside a UTF-8 character
            --cut;
        text.resize(cut);
        text += "...";
    }
    return text;
}

} // namespace starbow
