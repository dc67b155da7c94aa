#pragma once
#include <filesystem>
#include <string>

namespace starbow {

/// The file under its own spelling where one exists whose name differs only in how its letters are composed: "é" is one character
/// or "e" with a mark (Unicode's NFC and NFD), by the program that wrote it. Otherwise `file` as it is.
std::filesystem::path as_stored(const std::filesystem::path& file);

/// The end of a message about a file that does not exist: ", and the nearest name there is "a.json"", of several up to three; ""
/// where nothing in its folder has a name like it.
std::string nearest_names(const std::filesystem::path& file);

/// The end of a file's name in small letters, with its dot: ".glb" of "Hall.GLB".
std::string ending_of(const std::filesystem::path& file);

} // namespace starbow
