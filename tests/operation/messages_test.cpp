// Messages to a stream whose reader does not read.
#include "runtime/operation/messages.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"
#include <fcntl.h>
#include <sstream>
#include <unistd.h>

namespace messages_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

struct Pipe {
    int ends[2];
    Pipe() { EXPECT_EQ(pipe2(ends, O_CLOEXEC), 0); }
    std::string read(std::size_t most)
    {
        std::string text(most, '\0');
        const ssize_t got = ::read(ends[0], text.data(), text.size());
        text.resize(std::size_t(std::max<ssize_t>(got, 0)));
        return text;
    }
};

} // namespace

TEST(Messages, NobodyWaitsForAFullPipe)
{
    Pipe pipe;
    const std::string line(999, 'x');
    constexpr int sent = 2000; // 2 MB; pipe and queue together take less than a fifth
    double took_s = 0;
    for (int i = 0; i < sent; ++i)
        took_s += own_seconds([&] { send_message(pipe.ends[1], line + "\n"); });
    EXPECT_LT(took_s, 2);
    EXPECT_FALSE(flush_messages(0.05));

    // The number of lost messages comes after those that came before them, and then the next ones.
    std::string all;
    while (!flush_messages(0.01))
        all += pipe.read(1 << 16);
    send_message(pipe.ends[1], "the last\n");
    EXPECT_TRUE(flush_messages(5));
    while (!all.ends_with("the last\n"))
        all += pipe.read(1 << 16);
    // The writer may take a first heap while the others are still sent: then each heap has its own number.
    const std::string notice = " messages are dropped here, because nobody read them in time";
    long whole = 0, dropped = 0, notices = 0;
    std::string last;
    std::istringstream lines(all);
    for (std::string one; std::getline(lines, one); last = one)
        if (one == line)
            ++whole;
        else if (one.starts_with("starbow: ") && one.ends_with(notice))
            dropped += std::stol(one.substr(9)), ++notices;
        else
            EXPECT_EQ(one, "the last");
    EXPECT_EQ(last, "the last");
    EXPECT_EQ(whole + dropped, long(sent));
    EXPECT_GE(notices, 1);
    EXPECT_LE(notices, 2);
    EXPECT_GT(dropped, 1000);
}

TEST(Messages, AClosedStreamTakesNoTime)
{
    guard_streams(); // else SIGPIPE ends this test
    Pipe pipe;
    close(pipe.ends[0]);
    send_message(pipe.ends[1], "nobody there\n");
    EXPECT_TRUE(flush_messages(5));
    close(pipe.ends[1]);
    send_message(pipe.ends[1], "no stream\n");
    EXPECT_TRUE(flush_messages(5));
}

} // namespace messages_test
