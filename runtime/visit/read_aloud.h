#pragma once
#include "config/model/tour_file.h"
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// Texts one after the other, each as a sentence of its own; empty ones are left out.
std::string sentences(const std::vector<std::string>& texts);

/// The text that is read aloud as a step begins, with its caption, or its question, as it is shown.
std::string text_to_read(const Step& step, const std::string& caption);
/// The same before it is shown, with some number in place of the measured one.
std::string text_to_read(const Step& step);

/// The time that Speaker's program needs to read a text, and some 10 % more, seconds: an estimate by its letters, figures
/// and punctuation marks for 150 words a minute, in English and German.
double reading_s(std::string_view text);

/// The same tour with steps and explanations that last until their texts are read. The ship's time is slower in longer
/// steps, so that their motion is the same; in a step in which visitors fly it is not.
Tour paced_to_be_read(Tour tour);

} // namespace starbow
