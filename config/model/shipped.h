#pragma once
#include "profile.h"
#include "shot.h"
#include "tour_file.h"
#include "words.h"
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace starbow {

/// The folder that holds config/ and scenes/: the nearest above the program, or share/starbow there, where it is installed;
/// or else the same above the current folder. Throws InputError.
std::filesystem::path home();

/// The folder of an installed program's site, /etc/starbow: its files are read before the shipped ones of the same name.
/// Empty for a program in its checkout. It may not exist. Throws InputError as home() does.
std::filesystem::path site();

/// The folder of this person's own profiles: $XDG_CONFIG_HOME/starbow/profiles, or ~/.config/starbow/profiles.
std::filesystem::path own_profiles();

/// The shipped profiles, then the site's, the person's own, then those in the exhibit's folder if it names one. Of two for
/// the same device the later has precedence. Throws InputError for a wrong profile, and for a missing folder of the
/// exhibit's.
std::vector<Profile> known_profiles(const std::filesystem::path& exhibits = {});

/// A config file by path, or by the name of one of the site's or a shipped one: find("layouts", "dome") is
/// layouts/dome.json in site(), or else config/layouts/dome.json.
/// Throws InputError that lists the shipped names, or for a file that is of another kind.
std::filesystem::path shipped_file(const std::string& kind, const std::string& name);

/// The names of the site's and the shipped files of a kind, sorted: those by which shipped_file finds them.
std::vector<std::string> shipped_names(const std::string& kind);

/// The words of a language, by the name of a shipped one or a path. Throws InputError.
Words words_in(const std::string& language);
/// The languages that can be read, each by its name and in its own word. say: receives the reason for each other one.
std::vector<std::pair<std::string, std::string>> languages_here(const std::function<void(const std::string&)>& say);

/// A tour in a language, by the name of a shipped one or a path. Throws InputError.
Tour tour_in(const std::string& name, const Words& words);

/// The scene file of a shot: a shipped one, or a path from the shot's own folder.
std::filesystem::path scene_of(const Shot& shot, const std::filesystem::path& shot_file);
std::filesystem::path scene_of(const Tour& tour);

} // namespace starbow
