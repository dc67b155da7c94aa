#pragma once
#include "config/model/words.h"
#include "input/capabilities.h"
#include <string>
#include <utility>
#include <vector>

namespace starbow {

struct Panel;
struct Show;
struct Touring;
class Typesetter;

/// A tour's text on the head-up display.
struct Caption {
    std::string text;
    std::vector<std::string> choices{}; ///< a question's choices
    int chosen = -1; ///< index of the visitor's choice; -1: none
    int right = -1; ///< index of the right choice, once it is shown; -1: not yet
    std::string aside{}; ///< what the keys do now, and the seconds left
    bool flying = false; ///< the visitor flies: the lever counts
    bool menu = false; ///< the chosen choice is large, and the ones before and after it stand beside it
    std::string picture{}; ///< of a menu: the name of the small picture beside it, as thumbnail_of()'s, or empty
};

/// The caption of a tour's present state, in words for the controls at hand; empty where the visitor flies freely.
Caption caption_of(const Touring& touring, const Show& show, const Words& words, const InputCapabilities& capabilities);

/// The right choice, ticked, and another one that the visitor has chosen, crossed; empty before the answer.
std::string verdict_of(const Caption& caption);

/// Writes a caption on a panel's plate, as large as it fits; the first of the fields are small above it.
void write_caption(Panel& panel, const Typesetter& typesetter, const Caption& caption,
    const std::vector<std::pair<std::string, std::string>>& fields);

/// Breaks a text into lines no wider than `width` by `measure`; a wider word has a line of its own.
template <class Measure> std::vector<std::string> wrapped(const std::string& text, double width, Measure width_of)
{
    std::vector<std::string> lines{""};
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (!lines.back().empty() && width_of(longer) > width)
            lines.push_back(word);
        else
            lines.back() = std::move(longer);
        at = end + 1;
    }
    return lines;
}

} // namespace starbow
