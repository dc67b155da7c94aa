#pragma once
#include "config/model/tour_file.h"
#include <string>
#include <string_view>
#include <vector>

namespace starbow {

/// Texts one after the other, each as a sentence of its own; empty ones are left out.
std::string sentences(const std::vector<std::string>& texts);

/// The texts that are read aloud as a step begins, with a number in place of one that will be measured.
std::string text_to_read(const Step& step);

/// The time that Speaker's program needs to read a text, and some 10 % more, seconds: an estimate by its letters, figures
/// and punctuation marks for 150 words a minute, in English and German.
double reading_s(std::string_view text);

/// The same tour, its steps and explanations as long as their texts are read. The ship's time is slower there: each step's
/// motion is the same. Where visitors fly, their time only lasts longer.
Tour paced_to_be_read(Tour tour);

} // namespace starbow
