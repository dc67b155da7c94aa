#pragma once
#include "reader.h"
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace starbow {

/// A value for a JSON pointer: true or false, a finite number, a text, or a list of finite numbers.
struct Change {
    std::string pointer;
    nlohmann::json value;
};

/// Sets one value in the text of a JSON file; every other byte stays, comments too. A missing member, and missing objects
/// on the way to it, are added after the opening brace of the innermost existing object. A list's numbers are changed one
/// by one if their count stays. `file`: its name in messages. Throws InputError if the text is not JSON; if the pointer
/// leads through a value that is no object or list, or beyond a list's end; if an object would be lost; and if the result
/// would not read back as the same document with the one value set.
std::string patched(const std::string& file, const std::string& text, const Change& change);

/// Sets values in a file: all or none. The new text replaces the file in one step and with its permissions, so that a
/// reader sees the old or the new one. Throws InputError, also where the folder can't be written to.
void patch_file(const std::filesystem::path& file, const std::vector<Change>& changes);

} // namespace starbow
