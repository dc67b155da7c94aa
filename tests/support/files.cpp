#include "files.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <unistd.h>

namespace starbow::testing {

std::filesystem::path source_dir()
{
    if (const char* elsewhere = std::getenv("STARBOW_SOURCE")) // a machine that did not build the tests
        return elsewhere;
    return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
}

std::filesystem::path scratch(const std::string& name)
{
    struct Folder {
        std::filesystem::path path
            = std::filesystem::path(::testing::TempDir()) / ("starbow-test-" + std::to_string(getpid()));
        Folder() { std::filesystem::create_directories(path); }
        ~Folder()
        {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
    };
    static const Folder folder;
    return folder.path / name;
}

void write_bytes(const std::filesystem::path& file, std::string_view bytes)
{
    std::fstream there(file, std::ios::in | std::ios::out | std::ios::binary);
    if (!there)
        there.open(file, std::ios::out | std::ios::binary);
    there.write(bytes.data(), std::streamsize(bytes.size()));
    there.close();
    std::filesystem::resize_file(file, bytes.size());
}

std::filesystem::path write_text(const std::string& name, const std::string& text)
{
    const std::filesystem::path file = scratch(name);
    write_bytes(file, text);
    return file;
}

std::string read_text(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << file << " can't be read";
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::filesystem::path> shipped(const std::string& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / folder))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void run_generator(const std::filesystem::path& folder, const std::filesystem::path& made)
{
    const std::string command = "/usr/bin/python3 -B '" + (folder / "make.py").string() + "' '" + made.string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

void expect_made_by_its_program(const std::string& scene, std::size_t most_bytes)
{
    const auto folder = source_dir() / "scenes" / scene, made = scratch(scene + ".glb");
    ASSERT_NO_FATAL_FAILURE(run_generator(folder, made));
    const std::string now = read_text(made), committed = read_text(folder / (scene + ".glb"));
    ASSERT_EQ(now.size(), committed.size()) << "run scenes/" << scene << "/make.py and commit what it writes";
    std::uint32_t json = 0;
    std::memcpy(&json, committed.data() + 12, 4);
    for (std::size_t at = 0; at + 4 <= now.size(); at += 4) {
        float a = 0, b = 0;
        std::memcpy(&a, now.data() + at, 4), std::memcpy(&b, committed.data() + at, 4);
        const bool same = std::memcmp(&a, &b, 4) == 0 || (at >= 20 + json && std::abs(a - b) < 1e-9f);
        ASSERT_TRUE(same) << "run scenes/" << scene << "/make.py and commit what it writes; byte " << at;
    }
    EXPECT_LT(now.size(), most_bytes);
    EXPECT_TRUE(std::filesystem::exists(folder / "LICENSES.md"));
}

const Words& words(std::string_view language)
{
    static std::map<std::string, Words> read;
    const auto [at, made] = read.try_emplace(std::string(language));
    if (made)
        at->second = load_words(source_dir() / "config/words" / (at->first + ".json"));
    return at->second;
}

std::pair<int, std::string> line_and_rest(const std::string& message, const std::filesystem::path& file)
{
    const std::string name = file.string();
    EXPECT_EQ(message.substr(0, name.size() + 1), name + ":");
    std::size_t at = std::min(name.size() + 1, message.size());
    int line = 0;
    for (; at < message.size() && std::isdigit(static_cast<unsigned char>(message[at])); ++at)
        line = line * 10 + (message[at] - '0');
    at += line > 0 && message.substr(at, 1) == ":";
    return {line, message.substr(std::min(at + 1, message.size()))};
}

std::string mutated(std::string text, std::mt19937& random)
{
    static const std::vector<std::string> pieces{"1e999", "-1", "0", "1e308", "1e-320", "null", "true", "\"\"", "[]", "{}",
        "[", "]", "{", "}", ",", ":", "\"", "NaN", "\\u0000", "\xff", "//", "/*", "99999999999999999999", "0.5",
        "\"gamma\":2,"};
    for (unsigned faults = 1 + random() % 4; faults > 0; --faults) {
        const std::size_t at = random() % (text.size() + 1);
        const std::size_t length = std::min<std::size_t>(random() % 12, text.size() - at);
        switch (random() % 6) {
        case 0:
            text.erase(at, length);
            break;
        case 1:
            text.insert(at, text.substr(at, length));
            break;
        case 2:
            text.insert(at, pieces[random() % pieces.size()]);
            break;
        case 3:
            text.replace(at, length, pieces[random() % pieces.size()]);
            break;
        case 4:
            if (at < text.size())
                text[at] = char(random());
            break;
        default: { // a number replaces a number, so that the text mostly stays JSON
            const std::size_t digit = text.find_first_of("0123456789", at);
            if (digit != std::string::npos)
                text.replace(digit, 1, pieces[random() % 5]);
        }
        }
    }
    return text;
}

bool all_cases() { return std::getenv("STARBOW_ALL_CASES") != nullptr; }

int fuzz_count()
{
    const char* count = std::getenv("STARBOW_FUZZ_COUNT");
    return count ? std::atoi(count) : 3000;
}

std::string complaint(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos) << error.what();
        return error.what();
    } catch (const std::exception& error) {
        ADD_FAILURE() << "not an InputError: " << error.what();
        return "";
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

void expect_wrong(const std::function<void(const std::filesystem::path&)>& load, const std::vector<Wrong>& cases)
{
    for (const Wrong& wrong : cases) {
        SCOPED_TRACE(wrong.text.substr(0, 300));
        const std::filesystem::path file = write_text("wrong.json", wrong.text);
        const std::string message = complaint([&] { load(file); });
        const auto [line, rest] = line_and_rest(message, file);
        const bool begun = wrong.value.starts_with("{")
            && !wrong.value.ends_with("}"); // the message shows only the beginning of a long object
        const std::string start = (wrong.pointer.empty() ? "" : wrong.pointer + ": ") + wrong.value + (begun ? "" : " ");
        EXPECT_EQ(rest.substr(0, start.size()), start);
        EXPECT_GE(line, 1);
        EXPECT_LE(line, 1 + std::count(wrong.text.begin(), wrong.text.end(), '\n'));
        EXPECT_NE(message.find(wrong.says), std::string::npos) << message;
        EXPECT_TRUE(message.ends_with(" is right") || message.ends_with(" are right")) << message;
    }
}

void expect_survives(
    const std::function<void(const std::filesystem::path&)>& load, const std::vector<std::string>& seeds, int count)
{
    std::mt19937 random(20070704);
    int loaded = 0, refused = 0;
    for (int i = 0; i < count; ++i) {
        const std::string text = mutated(seeds[random() % seeds.size()], random);
        const std::filesystem::path file = write_text("mutated", text);
        try {
            load(file);
            ++loaded;
        } catch (const InputError& error) {
            ++refused;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        } catch (const std::exception& error) {
            FAIL() << error.what() << " thrown for:\n" << text;
        }
    }
    EXPECT_GT(loaded, 0); // otherwise no mutation gets past the parser
    EXPECT_GT(refused, 0);
}

} // namespace starbow::testing
