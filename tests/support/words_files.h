#pragma once
// A language's texts as their file has them, for tests that compare them with numbers of their own.
#include "files.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

namespace starbow::testing {

/// The texts of config/words/LANGUAGE.json by their keys.
inline nlohmann::json words_file(const std::string& language)
{
    return nlohmann::json::parse(read_text(source_dir() / "config/words" / (language + ".json")), nullptr, true, true);
}

/// The numbers of a text in English figures, each once, sorted. left_out: parts of the text whose numbers are none.
inline std::vector<std::string> numbers_in(const std::string& text, bool german, const std::regex& left_out)
{
    const std::string own = std::regex_replace(text, left_out, "");
    std::vector<std::string> all;
    const std::regex number("\\d+([.,]\\d+)*");
    for (std::sregex_iterator at(own.begin(), own.end(), number), end; at != end; ++at) {
        std::string figures = at->str();
        if (german)
            for (char& c : figures)
                c = c == ',' ? '.' : c == '.' ? ',' : c;
        all.push_back(figures);
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

} // namespace starbow::testing
