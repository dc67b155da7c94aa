// The text and the language reach the program that speaks, a new text ends the one before, and nothing is left running.
#include "runtime/operation/speaker.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"
#include <csignal>
#include <gtest/gtest.h>

namespace speaker_test {

using namespace starbow;
using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

/// A program that writes its arguments and its process number, then "speaks" for longer than a test lasts.
fs::path program(const std::string& name)
{
    const fs::path out = scratch(name + ".out");
    const fs::path file = write_text(name,
        "#!/bin/sh\nprintf '%s|' \"$@\" >> '" + out.string() + "'\necho $$ >> '" + out.string() + "'\nexec sleep 100\n");
    fs::permissions(file, fs::perms::owner_all);
    return file;
}

std::vector<std::string> lines_after(const fs::path& file, std::size_t count)
{
    std::vector<std::string> lines;
    until([&] {
        lines.clear();
        std::ifstream in(file);
        for (std::string line; std::getline(in, line) && !in.eof();) // one without its end is still being written
            lines.push_back(line);
        return lines.size() >= count;
    });
    return lines;
}

bool runs(const std::string& line) { return kill(pid_t(std::stoi(line.substr(line.rfind('|') + 1))), 0) == 0; }

} // namespace

TEST(Speaker, SpeaksOneTextAtATime)
{
    const fs::path file = program("speaks");
    std::vector<std::string> lines;
    {
        Speaker speaker(file.string());
        speaker.say("-v Gr\xc3\xbc\xc3\x9f Gott; $(rm x)", "de");
        lines = lines_after(file.string() + ".out", 1);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_TRUE(lines[0].starts_with("-v|de|-s|150| -v Gr\xc3\xbc\xc3\x9f Gott; $(rm x)|")) << lines[0];
        EXPECT_TRUE(runs(lines[0]));
        speaker.say("Second.", "en");
        lines = lines_after(file.string() + ".out", 2);
        ASSERT_EQ(lines.size(), 2u);
        EXPECT_FALSE(runs(lines[0]));
        EXPECT_TRUE(runs(lines[1]));
        speaker.say("", "en");
        EXPECT_FALSE(runs(lines[1]));
        speaker.say("Third.", "en");
        lines = lines_after(file.string() + ".out", 3);
        ASSERT_EQ(lines.size(), 3u);
    }
    EXPECT_FALSE(runs(lines[2]));
}

TEST(Speaker, AMissingProgramIsNoEnd)
{
    Speaker speaker("starbow-has-no-such-program");
    speaker.say("One.", "en");
    speaker.say("Two.", "en");
}

} // namespace speaker_test
