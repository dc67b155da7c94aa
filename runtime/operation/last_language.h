#pragma once
#include <filesystem>
#include <string>

namespace starbow {

/// The visitors' language that a docent has chosen, in a state folder, so that a start after a crash speaks it too.
/// keep_language writes it, on a thread of its own; a folder that can't be written keeps none.
void keep_language(const std::filesystem::path& state, const std::string& language);
/// The kept one; empty where there is none, or no name of a language.
std::string kept_language(const std::filesystem::path& state);
void forget_language(const std::filesystem::path& state);

} // namespace starbow
