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

/// What a tour says on the head-up display.
struct Caption {
    std::string text;
    std::vector<std::string> choices{}; ///< of a question
    int chosen = -1; ///< of them
    std::string aside{}; ///< how to answer, how long there is
    bool flying = false; ///< the visitor flies: the lever counts
};

/// Of a tour as it stands, in the words of what there is to answer with; no text where the visitor flies freely.
Caption caption_of(const Touring& touring, const Show& show, const Words& words, const InputCapabilities& capabilities);

/// Writes it on a panel's plate, as large as it fits; the first of the fields small above it.
void write_caption(Panel& panel, const Typesetter& typesetter, const Caption& caption,
    const std::vector<std::pair<std::string, std::string>>& fields);

/// A text in lines no wider than `width`, as this measures it; a word that is wider has a line of its own.
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
