#pragma once
#include "localised_text.h"
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// One part of a show: a tour, a world or a view, by the name of a shipped one.
struct ProgrammeItem {
    std::string tour, scene, shot; ///< one of them; the others are empty
    double minutes = 0; ///< planned; nothing ends by itself
    LocalisedText notes; ///< for the guide alone
};

/// The kind of what an item shows ("tour", "scene" or "shot", as commands and Words::title call it), and its name.
std::pair<std::string, std::string> shown_by(const ProgrammeItem& item);

/// A show that a guide gives, part after part.
struct Programme {
    std::vector<ProgrammeItem> items;
};

/// Reads and checks a programme. Throws InputError with file, line, JSON pointer, value and what would be right.
Programme load_programme(const std::filesystem::path& file);

} // namespace starbow
