#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// All visitors' texts in one language, by key. Log lines, errors and --help are English.
class Words {
public:
    /// The text of a known key with its placeholders filled: words("hud.ev", {{"ev", "+1.0"}}) is "+1.0 EV". An unknown
    /// key is a programming error and ends the program.
    std::string operator()(
        std::string_view key, const std::vector<std::pair<std::string_view, std::string>>& with = {}) const;

    /// A tour's text; nullopt where there is none.
    const std::string* tour(const std::string& key) const;

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
