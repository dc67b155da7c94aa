#include "json.h"
#include <algorithm>

namespace starbow {
namespace {

std::string shown(const Json& json)
{
    if (json.is_object())
        return "an object";
    if (json.is_array())
        return "a list of " + std::to_string(json.size());
    if (json.is_string())
        return in_quotes(json.get_ref<const std::string&>());
    return json.dump();
}

std::string plain(double value) { return Json(value).dump(); }

} // namespace

std::string in_quotes(const std::string& text)
{
    std::string out = "\"";
    for (char c : text.substr(0, 60))
        out += c >= ' ' && c <= '~' ? c : '?';
    return out + (text.size() > 60 ? "...\"" : "\"");
}

JsonSpot JsonSpot::operator[](const std::string& key) const
{
    auto found = json.find(key);
    if (found == json.end())
        fail("has no " + in_quotes(key) + "; glTF requires it");
    std::string escaped;
    for (char c : key.substr(0, 60))
        escaped += c == '~' ? "~0" : c == '/' ? "~1" : c >= ' ' && c <= '~' ? std::string(1, c) : "?";
    return {*found, at + "/" + escaped, file};
}

const JsonSpot& object(const JsonSpot& spot)
{
    if (!spot.json.is_object())
        spot.fail("is " + shown(spot.json) + "; should be an object");
    return spot;
}

const JsonSpot& list(const JsonSpot& spot, std::size_t at_least)
{
    if (!spot.json.is_array() || spot.json.size() < at_least)
        spot.fail("is " + shown(spot.json) + "; should be a list of " + std::to_string(at_least) + " or more");
    return spot;
}

std::int64_t integer(const JsonSpot& spot, std::int64_t low, std::int64_t high)
{
    // JSON does not distinguish 3 from 3.0, and some exporters write the latter.
    double value = spot.json.is_number() ? spot.json.get<double>() : std::nan("");
    if (!(value >= double(low) && value <= double(high)) || value != std::floor(value))
        spot.fail("is " + shown(spot.json) + "; should be a whole number from " + std::to_string(low) + " to "
            + std::to_string(high));
    return std::int64_t(value);
}

double number(const JsonSpot& spot, double low, double high)
{
    double value = spot.json.is_number() ? spot.json.get<double>() : std::nan("");
    if (!(value >= low && value <= high))
        spot.fail("is " + shown(spot.json) + "; should be a number from " + plain(low) + " to " + plain(high));
    return value;
}

std::vector<double> numbers(const JsonSpot& spot, std::size_t count, double low, double high)
{
    if (!spot.json.is_array() || spot.json.size() != count)
        spot.fail("is " + shown(spot.json) + "; should be a list of " + std::to_string(count) + " numbers");
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = number(spot[i], low, high);
    return values;
}

std::string text(const JsonSpot& spot)
{
    if (!spot.json.is_string())
        spot.fail("is " + shown(spot.json) + "; should be a text");
    return spot.json.get<std::string>();
}

bool boolean(const JsonSpot& spot)
{
    if (!spot.json.is_boolean())
        spot.fail("is " + shown(spot.json) + "; should be true or false");
    return spot.json.get<bool>();
}

void reject_unknown_members(const JsonSpot& spot, std::initializer_list<const char*> known)
{
    std::string right;
    for (const char* name : known)
        right += (right.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    for (const auto& [name, value] : object(spot).json.items())
        if (std::ranges::find(known, name) == known.end())
            spot[name].fail("is not known here; should be one of " + right);
}

std::int64_t index_into(const JsonSpot& spot, const char* what, std::size_t size)
{
    if (size == 0)
        spot.fail("names " + std::string(what) + " " + shown(spot.json) + ", but the file has none");
    double value = spot.json.is_number() ? spot.json.get<double>() : std::nan("");
    if (!(value >= 0 && value < double(size)) || value != std::floor(value))
        spot.fail("names " + std::string(what) + " " + shown(spot.json) + "; the file has 0 to " + std::to_string(size - 1));
    return std::int64_t(value);
}

} // namespace starbow
