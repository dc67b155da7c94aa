#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace starbow {

/// Everything that a visitor reads, in one language: a text for each key. Log lines, errors and --help are English.
class Words {
public:
    /// The text of a key that the program knows, its placeholders filled: words("hud.ev", {{"ev", "+1.0"}}) is "+1.0 EV".
    /// Another key is the program's mistake, and ends it.
    std::string operator()(
        std::string_view key, const std::vector<std::pair<std::string_view, std::string>>& with = {}) const;

    /// A tour's text; nothing where there is none.
    const std::string* tour(const std::string& key) const;

    /// As C writes a number, in the language's way: with its decimal sign.
    std::string number(std::string c) const;

    std::string language; ///< the file's name without its end: en, de
    std::filesystem::path file;
    std::map<std::string, std::string, std::less<>> texts;
};

/// Reads and checks a language's file. Throws InputError where a text that the program needs is missing, where one is too
/// many, and where a text lacks a placeholder.
Words load_words(const std::filesystem::path& file);

/// {name} in a text by what it stands for.
std::string filled(std::string text, const std::vector<std::pair<std::string_view, std::string>>& with);

/// The names in { } of a text, in its order.
std::vector<std::string> placeholders(const std::string& text);

} // namespace starbow
