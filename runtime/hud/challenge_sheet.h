#pragma once
#include "challenges.h"

namespace starbow {

/// A challenge as text: title, question, what to begin with and to use, how it is checked, and its first `hints` hints.
std::string challenge_text(const Challenge& challenge, int hints, const Words& words);

/// All challenges as a page (HTML) for a screen or paper; each hint is closed until it is opened.
std::string challenge_sheet(const Words& words);

} // namespace starbow
