// The datagrams to a service manager, received by a socket of the test's own, and what the exhibit keeps about itself.
#include "runtime/operation/crash_counter.h"
#include "runtime/operation/last_language.h"
#include "runtime/operation/service.h"
#include "runtime/operation/state_folder.h"
#include "runtime/operation/waits.h"
#include "tests/support/files.h"
#include "tests/support/waiting.h"
#include <cstddef>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

namespace service_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// A socket that receives as a service manager does, and the environment that leads to it.
class Manager {
public:
    explicit Manager(const std::string& name)
    {
        const bool abstract = name[0] == '@';
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, name.data(), name.size());
        if (abstract)
            address.sun_path[0] = '\0';
        socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
        EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address),
                      socklen_t(offsetof(sockaddr_un, sun_path) + name.size() + !abstract)),
            0);
        setenv("NOTIFY_SOCKET", name.c_str(), 1);
    }
    ~Manager()
    {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
            unsetenv(name);
        close(socket_);
    }
    /// All messages since the last call, one after the other.
    std::string received() const
    {
        std::string all;
        char message[4096];
        for (ssize_t length; (length = recv(socket_, message, sizeof message, 0)) > 0;)
            all.append(message, std::size_t(length));
        return all;
    }

private:
    int socket_;
};

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

} // namespace

TEST(Service, SpeaksFromLoadingToItsEnd)
{
    for (const std::string& name : {scratch("manager").string(), "@starbow-test-" + std::to_string(getpid())}) {
        const Manager manager(name);
        setenv("WATCHDOG_USEC", "400000", 1);
        Service service;
        ASSERT_TRUE(service.supervised()) << name;
        EXPECT_EQ(service.watchdog_s(), 0.4);
        service.loads("Loads\nthe world.", 60);
        EXPECT_EQ(manager.received(), "EXTEND_TIMEOUT_USEC=60000000\nSTATUS=Loads the world.\n");
        service.loads("Loads\nthe world.", 60);
        EXPECT_EQ(manager.received(), "EXTEND_TIMEOUT_USEC=60000000\n");
        Service::Clock::time_point now{std::chrono::hours(1)};
        service.shows("Shows.", now);
        EXPECT_EQ(manager.received(), "READY=1\nWATCHDOG=1\nSTATUS=Shows.\n");
        service.shows("Shows.", now += std::chrono::milliseconds(39)); // within a tenth of the watchdog's time
        EXPECT_EQ(manager.received(), "");
        service.shows("Shows.", now += std::chrono::milliseconds(2));
        EXPECT_EQ(manager.received(), "WATCHDOG=1\n");
        // After READY=1 another clock of the manager's runs: it is widened for loading, and put back.
        service.loads("Opens the GPU again.", 60);
        EXPECT_EQ(manager.received(), "EXTEND_TIMEOUT_USEC=60000000\nWATCHDOG_USEC=60000000\nSTATUS=Opens the GPU again.\n");
        service.shows("Shows.", now);
        EXPECT_EQ(manager.received(), "WATCHDOG=1\nWATCHDOG_USEC=400000\nSTATUS=Shows.\n");
        service.stops();
        EXPECT_EQ(manager.received(), "STOPPING=1\nSTATUS=The exhibit closes.\n");
    }
}

TEST(Service, IsNotReadyWithoutAMonitorAndLives)
{
    const Manager manager(scratch("waiting").string());
    setenv("WATCHDOG_USEC", "400000", 1);
    Service service;
    Service::Clock::time_point now{std::chrono::hours(1)};
    service.waits("Waits for a monitor.", now);
    EXPECT_EQ(manager.received(), "EXTEND_TIMEOUT_USEC=10000000\nWATCHDOG=1\nSTATUS=Waits for a monitor.\n");
    service.waits("Waits for a monitor.", now += std::chrono::milliseconds(50));
    EXPECT_EQ(manager.received(), "WATCHDOG=1\n");
    // The manager's time for the start is widened again, a while before it is over.
    service.waits("Waits for a monitor.", now += std::chrono::milliseconds(1001));
    EXPECT_EQ(manager.received(), "EXTEND_TIMEOUT_USEC=10000000\nWATCHDOG=1\n");
}

TEST(Service, SaysNothingWithoutAManagerOrWatchdog)
{
    Service alone;
    EXPECT_FALSE(alone.supervised());
    EXPECT_FALSE(alone.watchdog_s());
    alone.shows("Shows.");
    {
        const Manager manager(scratch("no-watchdog").string());
        setenv("WATCHDOG_USEC", "5000000", 1);
        setenv("WATCHDOG_PID", "1", 1); // another process's
        EXPECT_FALSE(Service().watchdog_s());
        setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
        EXPECT_EQ(Service().watchdog_s(), 5);
    }
    for (const char* name : {"", "relative", "@", "/nowhere/at/all"}) {
        setenv("NOTIFY_SOCKET", name, 1);
        EXPECT_FALSE(Service().supervised()) << name;
    }
    setenv("NOTIFY_SOCKET", ("/" + std::string(200, 'x')).c_str(), 1);
    EXPECT_FALSE(Service().supervised());
    unsetenv("NOTIFY_SOCKET");
}

TEST(Waits, AWaitInsideAnotherTakesTheFlightsLimitAndFourTimesThatInLongWork)
{
    EXPECT_EQ(LimitedWait("a wait of a command").limit_s(), 600);
    const WaitWatch watch(0.5);
    EXPECT_EQ(LimitedWait("a wait in flight").limit_s(), 0.5);
    const LimitedWait loading("loading", 60);
    EXPECT_EQ(loading.limit_s(), 60);
    EXPECT_EQ(LimitedWait("a wait in loading").limit_s(), 2);
    const LimitedWait inner("a wait in loading");
    EXPECT_EQ(LimitedWait("a wait in a wait in loading").limit_s(), 2);
}

TEST(Waits, TimeWithoutAProcessorAndALoadingsOwnWorkAreNoHang)
{
    EXPECT_EQ(counted_s(0.1, 0, 0, false), 0.1);
    EXPECT_EQ(counted_s(0.1, 0, 0, true), 0.1);
    EXPECT_EQ(counted_s(0.1, 0.1, 0, false), 0.1) << "a frame that computes without an end hangs";
    EXPECT_DOUBLE_EQ(counted_s(0.1, 0.04, 0, true), 0.06);
    EXPECT_DOUBLE_EQ(counted_s(0.1, 0, 0.07, false), 0.03);
    EXPECT_DOUBLE_EQ(counted_s(0.1, 3, 3, true), 0.005) << "several threads";
    EXPECT_EQ(counted_s(0.1, -1, -1, true), 0.1) << "threads that ended took their times with them";
}

TEST(Waits, TheInnermostWaitBeyondItsLimitEndsTheProcess)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            const WaitWatch watch(1);
            const LimitedWait frame("the frame");
            for (int i = 0; i < 3; ++i) { // each ends in time, and the frame's own time begins anew
                const LimitedWait inner("a short wait");
                sleep_ms(400);
            }
            const LimitedWait fence("the fence of the test");
            sleep_ms(20000);
        },
        ::testing::ExitedWithCode(exit_hung), "error hang: the fence of the test has not come for 1\\.[0-9] s");
}

TEST(CrashCounter, FiveDisorderlyEndsWithinTenMinutesAreCounted)
{
    const std::filesystem::path folder = scratch("ends-state");
    EXPECT_EQ(CrashCounter(folder, 10000).lately(), 0); // the first start ever
    for (int i = 1; i <= 5; ++i)
        EXPECT_EQ(CrashCounter(folder, 10000 + 60 * i).lately(), i); // each finds the run before unfinished
    EXPECT_EQ(CrashCounter(folder, 10000 + 60 + 600).lately(), 5); // the first of five is ten minutes old, and one more came
    CrashCounter(folder, 10700).in_order();
    EXPECT_EQ(CrashCounter(folder, 10701).lately(), 0);
    // A clock that was set back, and a damaged file.
    EXPECT_EQ(CrashCounter(folder, 500).lately(), 1);
    std::ofstream(folder / "ends") << "nonsense\n-3\n99999999999999999999999999\n\n490\nrunning";
    EXPECT_EQ(CrashCounter(folder, 500).lately(), 2);
    // A folder that can't be written counts nothing.
    EXPECT_EQ(CrashCounter(write_text("ends-no-folder", "x"), 500).lately(), 0);
}

TEST(StateFolder, TheServicesFolderComesBeforeThePersons)
{
    const char* const names[] = {"STATE_DIRECTORY", "XDG_STATE_HOME", "HOME"};
    std::vector<std::string> before;
    for (const char* name : names)
        before.push_back(std::getenv(name) ? std::getenv(name) : "");
    setenv("STATE_DIRECTORY", "/var/lib/starbow:/var/lib/other", 1);
    setenv("XDG_STATE_HOME", "/x", 1);
    setenv("HOME", "/home/p", 1);
    EXPECT_EQ(state_folder(), "/var/lib/starbow");
    unsetenv("STATE_DIRECTORY");
    EXPECT_EQ(state_folder(), "/x/starbow");
    unsetenv("XDG_STATE_HOME");
    EXPECT_EQ(state_folder(), "/home/p/.local/state/starbow");
    unsetenv("HOME");
    EXPECT_EQ(state_folder(), "");
    for (std::size_t i = 0; i < 3; ++i)
        if (!before[i].empty())
            setenv(names[i], before[i].c_str(), 1);
}

TEST(LastLanguage, IsKeptForAStartAfterACrashAndIsANameAlone)
{
    const std::filesystem::path state = scratch("language-state");
    EXPECT_EQ(kept_language(state), "");
    keep_language(state, "de");
    until([&] { return !kept_language(state).empty(); });
    EXPECT_EQ(kept_language(state), "de");
    keep_language(state, "../../etc/passwd"); // no name: nothing is written
    for (const char* wrong : {"", "de\n", "a/b", "abcdefghijklmnopqrstuvwxyzabcdefghijk"}) {
        std::ofstream(state / "language") << wrong;
        EXPECT_EQ(kept_language(state), "") << wrong;
    }
    forget_language(state);
    EXPECT_FALSE(std::filesystem::exists(state / "language"));
    keep_language({}, "de");
    EXPECT_EQ(kept_language({}), "");
}

} // namespace service_test
