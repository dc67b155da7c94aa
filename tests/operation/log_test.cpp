// The log's lines in a terminal and in the journal.
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "tests/support/files.h"
#include <array>
#include <regex>
#include <set>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

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
    void open(LogLevel lowest = LogLevel::info) { open_log({.lowest = lowest, .stream = stream_, .journal = journal}); }
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
    std::string journal = "/no/such/socket"; ///< the machine's own journal must not hear of tests

private:
    std::FILE* stream_;
};

const std::string time_pattern = R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} )";

} // namespace

TEST(Log, ALineHoldsTimeLevelPartAndText)
{
    LogFile file("log-lines");
    file.open();
    write_log(LogKind::device_plugged, "Stick is plugged in");
    write_log(LogKind::output_missing, "output 'left' is not shown: {} %s");
    write_log(LogKind::gpu_given_up, "the GPU is lost");
    const LogTo below = write_log;
    below(LogKind::record_differs, "from a room below");
    const auto lines = file.lines();
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_TRUE(std::regex_match(lines[0], std::regex(time_pattern + "info input: Stick is plugged in"))) << lines[0];
    EXPECT_TRUE(
        std::regex_match(lines[1], std::regex(time_pattern + R"(warn exhibit: output 'left' is not shown: \{\} %s)")))
        << lines[1];
    EXPECT_TRUE(std::regex_match(lines[2], std::regex(time_pattern + "error exhibit: the GPU is lost"))) << lines[2];
    EXPECT_TRUE(std::regex_match(lines[3], std::regex(time_pattern + "warn record: from a room below"))) << lines[3];
}

TEST(Log, LevelsBelowTheLowestAreLeftOut)
{
    LogFile file("log-levels");
    file.open();
    write_log(LogKind::command_done, "left out");
    EXPECT_EQ(file.lines().size(), 0u);
    file.open(LogLevel::debug);
    write_log(LogKind::command_done, "included");
    ASSERT_EQ(file.lines().size(), 1u);
    EXPECT_NE(file.lines()[0].find("debug remote: included"), std::string::npos);
    file.open(LogLevel::error);
    write_log(LogKind::output_missing, "no");
    EXPECT_EQ(file.lines().size(), 1u);
}

/// Whatever comes over a network, the log stays readable, and small.
TEST(Log, LinesThatStrangersCauseAreFew)
{
    using namespace std::chrono_literals;
    LogFile file("log-limited");
    file.open();
    const auto start = std::chrono::steady_clock::now() + 1h; // after what other tests of this process have written
    for (int i = 0; i < 1000; ++i)
        write_limited(LogKind::node_differs, "line " + std::to_string(i), start + i * 10ms);
    write_limited(LogKind::node_refused, "of another kind", start + 10s);
    write_limited(LogKind::node_differs, "a minute later", start + 60s);
    write_limited(LogKind::node_differs, "then as before", start + 61s);
    const std::vector<std::string> lines = file.lines();
    ASSERT_EQ(lines.size(), 13u);
    EXPECT_TRUE(lines[0].ends_with("machines: line 0"));
    EXPECT_TRUE(lines[9].ends_with("machines: line 9"));
    EXPECT_TRUE(lines[10].ends_with("machines: of another kind"));
    EXPECT_TRUE(lines[11].ends_with("machines: a minute later (990 such lines before are left out)")) << lines[11];
    EXPECT_TRUE(lines[12].ends_with("machines: then as before"));
}

TEST(Log, AMessageStaysOneLineAndSteersNoTerminal)
{
    LogFile file("log-control");
    file.open();
    write_log(LogKind::device_plugged, std::string("a\nb\x1b[31mc\x7f\0d γ", 15));
    ASSERT_EQ(file.lines().size(), 1u);
    EXPECT_TRUE(file.lines()[0].ends_with("input: a?b?[31mc??d γ")) << file.lines()[0];
}

TEST(Log, NoCharacterSteersTheTerminalOrTheDirectionOfWriting)
{
    LogFile file("log-steering");
    file.open();
    // CSI as U+009B, as a byte that is no UTF-8, and in the longer form that no UTF-8 has; overrides, isolates, marks.
    write_log(LogKind::device_plugged,
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
    write_log(LogKind::command_done, "a");
    write_log(LogKind::output_shown, "b");
    write_log(LogKind::output_missing, "c");
    write_log(LogKind::gpu_given_up, "d");
    EXPECT_EQ(file.lines(), (std::vector<std::string>{"<7>remote: a", "<6>exhibit: b", "<4>exhibit: c", "<3>exhibit: d"}));
}

TEST(Log, TheJournalsSocketGetsTheKindOfEachLine)
{
    LogFile file("log-socket");
    file.journal = scratch("journal");
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    ASSERT_LT(file.journal.size(), sizeof at.sun_path);
    std::ranges::copy(file.journal, at.sun_path);
    const int journal = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    ASSERT_EQ(bind(journal, reinterpret_cast<const sockaddr*>(&at), sizeof at), 0);
    setenv("JOURNAL_STREAM", file.journal_stream().c_str(), 1);
    file.open();
    const auto received = [&] {
        std::array<char, 1000> text;
        const ssize_t size = recv(journal, text.data(), text.size(), 0);
        return size < 0 ? std::string() : std::string(text.data(), std::size_t(size));
    };
    write_log(LogKind::gpu_lost, "the GPU is lost\nMESSAGE_ID=0");
    EXPECT_EQ(received(),
        "MESSAGE=exhibit: the GPU is lost?MESSAGE_ID=0\nPRIORITY=4\nSYSLOG_IDENTIFIER=starbow\nMESSAGE_ID="
            + std::string(rule_of(LogKind::gpu_lost).message_id) + "\nSTARBOW_LINE=gpu-lost\n");
    write_log(LogKind::command_done, "too low");
    EXPECT_EQ(received(), "");
    EXPECT_TRUE(file.lines().empty());

    // A journal that does not read: nothing waits, and no line is lost.
    constexpr std::size_t sent = 2000;
    for (std::size_t i = 0; i < sent; ++i)
        write_log(LogKind::gpu_lost, "again");
    std::size_t read = 0;
    while (!received().empty())
        ++read;
    EXPECT_GT(read, 0u);
    const std::vector<std::string> others = file.lines();
    EXPECT_GT(others.size(), 0u);
    EXPECT_EQ(read + others.size(), sent);
    EXPECT_EQ(others.at(0), "<4>exhibit: again");

    // A journal that has ended.
    close(journal);
    write_log(LogKind::gpu_lost, "to nobody");
    EXPECT_EQ(file.lines().back(), "<4>exhibit: to nobody");
}

TEST(Log, EachKindHasItsOwnIdentifiers)
{
    std::set<std::string_view> names, ids;
    for (const LogRule& rule : log_rules) {
        EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
        EXPECT_TRUE(ids.insert(rule.message_id).second) << rule.name;
        EXPECT_TRUE(std::regex_match(std::string(rule.message_id), std::regex("[0-9a-f]{32}"))) << rule.name;
        EXPECT_TRUE(std::regex_match(std::string(rule.name), std::regex("[a-z]+(-[a-z]+)*"))) << rule.name;
    }
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
                write_log(LogKind::world_note, std::string(80, char('a' + t)));
        });
    for (std::thread& one : all)
        one.join();
    const auto lines = file.lines();
    ASSERT_EQ(lines.size(), std::size_t(threads * each));
    for (const std::string& line : lines) {
        EXPECT_TRUE(line.ends_with("info world: " + std::string(80, line.back()))) << line;
    }
}

} // namespace log_test
