#include "localised_text.h"

namespace starbow {

LocalisedText read_saying(const Place& place)
{
    if (place.json->is_string())
        return {.key = text(place), .texts = {}};
    if (!place.json->is_object() || place.json->empty())
        fail_at(place, "is not a text; a key of the words, or { \"en\": \"...\", \"de\": \"...\" } is right");
    LocalisedText saying;
    for (const auto& [language, value] : place.json->items())
        saying.texts[language] = text(member(place, language));
    return saying;
}

std::string said(const LocalisedText& saying, const Words& words)
{
    if (!saying.key.empty()) {
        const auto found = words.texts.find(saying.key);
        return found == words.texts.end() ? saying.key : found->second;
    }
    for (const std::string& language : {words.language, std::string("en")})
        if (const auto found = saying.texts.find(language); found != saying.texts.end())
            return found->second;
    return saying.texts.empty() ? "" : saying.texts.begin()->second;
}

} // namespace starbow
