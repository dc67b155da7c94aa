#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// A text of the program, with the names in { } that it needs, separated by spaces.
struct KnownText {
    std::string_view key, placeholders;
    constexpr auto operator<=>(const KnownText&) const = default;
};
/// Every text of the program but tours', goals' and the names of files: those of config/words/en.json, in the order of their
/// keys.
inline constexpr KnownText known_texts[] = {
#include <known_texts.inc>
};

/// The key of a text that exists: another one does not compile.
class Key {
public:
    constexpr Key() = default; ///< of no text
    consteval Key(const char* name)
        : Key("", name)
    {
    }
    /// The key of a prefix and a name, as of "hud." and "speed".
    consteval Key(std::string_view prefix, std::string_view name)
    {
        text_ = std::ranges::partition_point(known_texts, [&](const KnownText& one) {
            const std::string_view begin = one.key.substr(0, prefix.size());
            return begin != prefix ? begin < prefix : one.key.substr(prefix.size()) < name;
        });
        if (text_ == std::end(known_texts) || !text_->key.starts_with(prefix) || text_->key.substr(prefix.size()) != name)
            throw "config/words/en.json has no text with this key";
    }
    constexpr std::string_view name() const { return text_ ? text_->key : std::string_view(); }
    constexpr explicit operator bool() const { return text_; }
    constexpr bool operator==(const Key&) const = default;

private:
    const KnownText* text_ = nullptr;
};
/// A key in an expression, as on one side of a condition.
consteval Key operator""_key(const char* name, std::size_t) { return Key(name); }
/// The texts of several names, such as those of an enum's values: keys_of("inset.", inset_view_names).
template <class Name, std::size_t count>
consteval std::array<Key, count> keys_of(std::string_view prefix, const std::array<Name, count>& names)
{
    std::array<Key, count> keys;
    for (std::size_t i = 0; i < count; ++i)
        keys[i] = Key(prefix, names[i]);
    return keys;
}

/// All visitors' texts in one language, by key. Log lines, errors and --help are English.
class Words {
public:
    /// A text with its placeholders filled: words("hud.ev", {{"ev", "+1.0"}}) is "+1.0 EV". Empty without a key.
    std::string operator()(Key key, const std::vector<std::pair<std::string_view, std::string>>& with = {}) const;

    /// A tour's text; nullopt where there is none.
    const std::string* tour(const std::string& key) const;

    /// People's name of a world (kind "scene"), a tour ("tour") or a view ("shot"), wherever one is offered or shown. Of one
    /// that the words do not know, the file's own.
    std::string title(std::string_view kind, const std::string& name) const;

    /// A number in C's format, with the language's decimal sign.
    std::string number(std::string c) const;

    std::string language; ///< the file's name without its end: en, de
    std::filesystem::path file;
    std::map<std::string, std::string, std::less<>> texts;
};

/// Reads and checks a language's file. Throws InputError for a missing key, for an unknown one, and for a text that lacks a
/// placeholder.
Words load_words(const std::filesystem::path& file);

/// Replaces {name} in a text by its value.
std::string filled(std::string text, const std::vector<std::pair<std::string_view, std::string>>& with);

/// The names in { } of a text, in order.
std::vector<std::string> placeholders(const std::string& text);

} // namespace starbow
