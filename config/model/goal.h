#pragma once
#include "measure.h"
#include <limits>
#include <map>
#include <string>

namespace starbow {

struct Words;

/// A text of a scene's file: a key of the words that begins with "goal.", or the text itself in some languages.
struct Saying {
    std::string key; ///< empty: the texts are here
    std::map<std::string, std::string> texts; ///< by language
};
/// The text in the words' language; where it has none, in English, or in the first that it has. Of a key that the words do
/// not know, the key.
std::string said(const Saying& saying, const Words& words);

/// A measure's number is at least `from` and below `below`.
struct GoalCondition {
    Measure measure;
    double from = -std::numeric_limits<double>::infinity(), below = std::numeric_limits<double>::infinity();
};

/// Something for a visitor to find or to do in a world. It is reached while all conditions hold.
struct Goal {
    Saying ask, reward;
    std::vector<GoalCondition> conditions;
};

} // namespace starbow
