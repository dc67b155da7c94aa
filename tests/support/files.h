#pragma once
#include "config/json/error.h"
#include "config/model/words.h"
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace starbow::testing {

/// The repository's root, for the shipped files.
std::filesystem::path source_dir();

/// Returns the path of `name` in this process's own folder, which is removed when the process ends.
std::filesystem::path scratch(const std::string& name);

/// Writes a file's bytes as they are. A file that is there is overwritten: ext4 waits for the disk after one was emptied.
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

/// Writes a file into that folder.
std::filesystem::path write_text(const std::string& name, const std::string& text);

std::string read_text(const std::filesystem::path& file);

/// The JSON files of a folder of the repository, in order of their names.
std::vector<std::filesystem::path> shipped(const std::string& folder);

/// Runs FOLDER/make.py, which writes to `made`; the test fails if the program does.
void run_generator(const std::filesystem::path& folder, const std::filesystem::path& made);

/// Runs scenes/SCENE/make.py, and expects that the committed world is what it writes: the same bytes, and numbers to 1e-9,
/// because C libraries differ in the last bit of a sine; a folder with its licence, and at most so many bytes.
void expect_made_by_its_program(const std::string& scene, std::size_t most_bytes);

/// The shipped words of a language.
const Words& words(std::string_view language = "en");

/// Returns the message of the InputError that `act` throws. Anything else fails the test and returns "".
std::string complaint(const std::function<void()>& act);

/// Splits "FILE:LINE: rest" into its line and the rest. The line is 0 if the message names the file alone.
std::pair<int, std::string> line_and_rest(const std::string& message, const std::filesystem::path& file);

/// A faulty file: its text, where the message points ("" for the whole file), the value it shows and a part of the reason.
struct Wrong {
    std::string text, pointer, value, says;
};

/// Each file is refused with its line, the value and the right one.
void expect_wrong(const std::function<void(const std::filesystem::path&)>& load, const std::vector<Wrong>& cases);

/// Returns the text with a few random faults, as typing mistakes and bad disks make them.
std::string mutated(std::string text, std::mt19937& random);

/// With STARBOW_ALL_CASES set, tests of many cases take all of them; otherwise a sample.
bool all_cases();

/// STARBOW_FUZZ_COUNT, or a few thousand.
int fuzz_count();

/// Every mutated file either loads or is refused in one line. Any other exception fails the test.
void expect_survives(const std::function<void(const std::filesystem::path&)>& load, const std::vector<std::string>& seeds,
    int count = fuzz_count());

} // namespace starbow::testing
