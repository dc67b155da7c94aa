#pragma once
#include "profile.h"
#include "shot.h"
#include "tour_file.h"
#include "words.h"
#include <filesystem>
#include <string>

namespace starbow {

/// The folder that holds config/ and scenes/: the nearest above the program, or else above the current folder. Throws
/// InputError.
std::filesystem::path home();

/// The folder of this person's own profiles: $XDG_CONFIG_HOME/starbow/profiles, or ~/.config/starbow/profiles.
std::filesystem::path own_profiles();

/// The shipped profiles, then the person's own, then those in the exhibit's folder if it names one. Of two for the same
/// device the later has precedence. Throws InputError for a wrong profile, and for a missing folder of the exhibit's.
std::vector<Profile> known_profiles(const std::filesystem::path& exhibits = {});

/// A config file by path, or by the name of a shipped one: find("layouts", "dome") is config/layouts/dome.json.
/// Throws InputError that lists the shipped names.
std::filesystem::path shipped_file(const std::string& kind, const std::string& name);

/// The words of a language, by the name of a shipped one or a path. Throws InputError.
Words words_in(const std::string& language);

/// A tour in a language, by the name of a shipped one or a path. Throws InputError.
Tour tour_in(const std::string& name, const Words& words);

/// The scene file of a shot: a shipped one, or a path from the shot's own folder.
std::filesystem::path scene_of(const Shot& shot, const std::filesystem::path& shot_file);
std::filesystem::path scene_of(const Tour& tour);

} // namespace starbow
