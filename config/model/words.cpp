#include "words.h"
#include "config/json/reader.h"
#include <algorithm>

namespace starbow {
namespace {

static_assert(std::ranges::is_sorted(known_texts), "Key looks them up by halves");

/// The prefix of the tours' keys, which the tours define.
constexpr std::string_view of_tours = "tour.";
/// The prefix of the goals' keys, which the scenes define.
constexpr std::string_view of_goals = "goal.";

/// The prefix of the names of worlds, tours and views, which their files define.
constexpr std::string_view of_names = "name.";

/// "a b" as "{a}, {b}".
std::string in_braces(std::string_view names)
{
    if (names.empty())
        return "no { }";
    std::string list = "{";
    for (const char c : names)
        list += c == ' ' ? "}, {" : std::string(1, c);
    return list + "}";
}

} // namespace

std::string filled(std::string text, const std::vector<std::pair<std::string_view, std::string>>& with)
{
    for (const auto& [name, value] : with) {
        const std::string hole = std::string("{").append(name).append("}");
        for (std::size_t at = 0; (at = text.find(hole, at)) != text.npos; at += value.size())
            text.replace(at, hole.size(), value);
    }
    return text;
}

std::vector<std::string> placeholders(const std::string& text)
{
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = text.find('{', at)) != text.npos; ++at)
        if (const std::size_t end = text.find('}', at); end != text.npos)
            names.push_back(text.substr(at + 1, end - at - 1));
    return names;
}

std::string Words::operator()(Key key, const std::vector<std::pair<std::string_view, std::string>>& with) const
{
    const auto found = texts.find(key.name());
    return found == texts.end() ? "" : filled(found->second, with);
}

const std::string* Words::tour(const std::string& key) const
{
    const auto found = key.starts_with(of_tours) ? texts.find(key) : texts.end();
    return found == texts.end() ? nullptr : &found->second;
}

std::string Words::title(std::string_view kind, const std::string& name) const
{
    const auto found = texts.find(std::string(of_names).append(kind).append(".").append(name));
    return found == texts.end() ? name : found->second;
}

std::string Words::number(std::string c) const
{
    if (const std::size_t point = c.find('.'); point != c.npos)
        c.replace(point, 1, (*this)("decimal_sign"));
    return c;
}

Words load_words(const std::filesystem::path& file)
{
    const Document document = read_document(file);
    const Place top = root(document);
    if (!top.json->is_object())
        fail_at(top, "is not an object; an object in { } is right");
    std::vector<std::string_view> keys;
    for (const KnownText& one : known_texts)
        keys.push_back(one.key);
    for (const auto& [key, value] : top.json->items())
        if (key.starts_with(of_tours) || key.starts_with(of_goals) || key.starts_with(of_names))
            keys.push_back(key);
    reject_unknown_members(top, keys);
    Words words{.language = file.stem(), .file = file, .texts = {}};
    for (const auto& [key, value] : top.json->items())
        words.texts[key] = text(member(top, key));
    for (const KnownText& one : known_texts) {
        const Place at = member(top, std::string(one.key));
        std::vector<std::string> there = placeholders(words.texts.find(one.key)->second);
        std::ranges::sort(there);
        std::string names;
        for (const std::string& name : there)
            names += (names.empty() ? "" : " ") + name;
        if (names != one.placeholders)
            fail_at(
                at, "has other placeholders than this text needs; a text with " + in_braces(one.placeholders) + " is right");
    }
    return words;
}

} // namespace starbow
