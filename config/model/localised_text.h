#pragma once
#include "config/json/reader.h"
#include "words.h"
#include <map>
#include <string>

namespace starbow {

/// A text of a tour's or a scene's file: a key of the words, or the text itself in some languages.
struct LocalisedText {
    std::string key; ///< empty: the texts are here
    std::map<std::string, std::string> texts; ///< by language
};

/// Reads one. Whether the words know the key is the caller's to check. Throws InputError.
LocalisedText read_saying(const Place& place);

/// The text in the words' language; where it has none, in English, or in the first that it has. Of a key that the words do
/// not know, the key.
std::string said(const LocalisedText& saying, const Words& words);

} // namespace starbow
