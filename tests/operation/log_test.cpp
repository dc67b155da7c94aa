// The log's lines in a terminal and in the journal.
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "tests/support/files.h"
#include <regex>
#include <sys/stat.h>
#include <thread>

namespace log_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// A log that writes into a file as long as this object lives.
class LogFile {
public:
    explicit LogFile(const std::string& name)
        : path(scratch(name))
        , stream_(std::fopen(path.c_str(), "w"))
    {
    }
    ~LogFile()
    {
        unsetenv("JOURNAL_STREAM");
        open_log({});
        std::fclose(stream_);
    }
    void open(LogLevel lowest = LogLevel::info) { open_log({.lowest = lowest, .stream = stream_}); }
    /// The service manager's value for this stream, with `other` added to the inode.
    std::string journal_stream(unsigned long long other = 0) const
    {
        struct stat found { };
        EXPECT_EQ(fstat(fileno(stream_), &found), 0);
        return std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino + other);
    }
    std::FILE* stream() const { return stream_; }
    std::vector<std::string> lines() const
    {
        EXPECT_TRUE(flush_messages(5));
        std::istringstream text(read_text(path));
        std::vector<std::string> all;
        for (std::string line; std::getline(text, line);)
            all.push_back(line);
        return all;
    }

    const std::filesystem::path path;

private:
    std::FILE* stream_;
};

const std::string time_pattern = R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} )";

} // namespace

TEST(Log, ALineHoldsTimeLevelPartAndText)
{
    LogFile file("log-lines");
    file.open();
    log_info("input", "Stick is plugged in");
    log_warning("exhibit", "output 'left' is not shown: {} %s");
    log_error("exhibit", "the GPU is lost");
    info_log("record")("from a room below");
    const auto lines = file.lines();
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_TRUE(std::regex_match(lines[0], std::regex(time_pattern + "info input: Stick is plugged in"))) << lines[0];
    EXPECT_TRUE(
        std::regex_match(lines[1], std::regex(time_pattern + R"(warn exhibit: output 'left' is not shown: \{\} %s)")))
        << lines[1];
    EXPECT_TRUE(std::regex_match(lines[2], std::regex(time_pattern + "error exhibit: the GPU is lost"))) << lines[2];
    EXPECT_TRUE(std::regex_match(lines[3], std::regex(time_pattern + "info record: from a room below"))) << lines[3];
}

TEST(Log, LevelsBelowTheLowestAreLeftOut)
{
    LogFile file("log-levels");
    file.open();
    log_debug("exhibit", "left out");
    EXPECT_EQ(file.lines().size(), 0u);
    file.open(LogLevel::debug);
    log_debug("exhibit", "included");
    ASSERT_EQ(file.lines().size(), 1u);
    EXPECT_NE(file.lines()[0].find("debug exhibit: included"), std::string::npos);
    file.open(LogLevel::error);
    log_warning("exhibit", "no");
    EXPECT_EQ(file.lines().size(), 1u);
}

TEST(Log, AMessageStaysOneLineAndSteersNoTerminal)
{
    LogFile file("log-control");
    file.open();
    log_info("input", std::string("a\nb\x1b[31mc\x7f\0d γ", 15));
    ASSERT_EQ(file.lines().size(), 1u);
    EXPECT_TRUE(file.lines()[0].ends_with("input: a?b?[31mc??d γ")) << file.lines()[0];
}

TEST(Log, NoCharacterSteersTheTerminalOrTheDirectionOfWriting)
{
    LogFile file("log-steering");
    file.open();
    // CSI as U+009B, as a byte that is no UTF-8, and in the longer form that no UTF-8 has; overrides, isolates, marks.
    log_info("input",
        "a\xc2\x9b"
        "b\x9b"
        "c\xc0\x9b"
        "d\xe2\x80\xae"
        "e\xe2\x81\xa6"
        "f\xe2\x80\x8f"
        "g\xd8\x9c"
        "h\xe2\x80\xa8i γ€🚀\xe2\x80");
    EXPECT_TRUE(file.lines().at(0).ends_with("input: a?b?c??d?e?f?g?h?i γ€🚀??")) << file.lines()[0];
}

TEST(Log, TheJournalGetsPrioritiesInsteadOfTimes)
{
    LogFile file("log-journal");
    setenv("JOURNAL_STREAM", file.journal_stream().c_str(), 1);
    file.open(LogLevel::debug);
    log_debug("exhibit", "a");
    log_info("exhibit", "b");
    log_warning("exhibit", "c");
    log_error("exhibit", "d");
    EXPECT_EQ(file.lines(), (std::vector<std::string>{"<7>exhibit: a", "<6>exhibit: b", "<4>exhibit: c", "<3>exhibit: d"}));
}

TEST(Log, AStreamThatWasRedirectedIsNotTheJournals)
{
    const LogFile file("log-redirected");
    EXPECT_TRUE(is_journal(file.journal_stream().c_str(), file.stream()));
    EXPECT_FALSE(is_journal(file.journal_stream(1).c_str(), file.stream()));
    EXPECT_FALSE(is_journal("", file.stream()));
    EXPECT_FALSE(is_journal("yes", file.stream()));
    EXPECT_FALSE(is_journal(nullptr, file.stream()));
}

TEST(Log, ThreadsDoNotMixTheirLines)
{
    LogFile file("log-threads");
    file.open();
    constexpr int threads = 4, each = 500;
    std::vector<std::thread> all;
    for (int t = 0; t < threads; ++t)
        all.emplace_back([t] {
            for (int i = 0; i < each; ++i)
                log_info("thread" + std::to_string(t), std::string(80, char('a' + t)));
        });
    for (std::thread& one : all)
        one.join();
    const auto lines = file.lines();
    ASSERT_EQ(lines.size(), std::size_t(threads * each));
    for (const std::string& line : lines) {
        const int t = line.back() - 'a';
        EXPECT_TRUE(line.ends_with("info thread" + std::to_string(t) + ": " + std::string(80, line.back()))) << line;
    }
}

} // namespace log_test
