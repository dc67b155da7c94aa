// Messages between machines, here between processes on the loopback interface.
#include "config/json/error.h"
#include "runtime/machines/bus.h"
#include "runtime/machines/interface.h"
#include "runtime/machines/page_bytes.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

namespace starbow::bus_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A domain that no other test process uses at the time.
int free_domain() { return 20 + int(getpid() % 150); }

/// Waits until `come` is true, for ten seconds at most.
template <class Come> bool in_time(Bus& bus, const Come& come)
{
    for (const auto until = Clock::now() + 10s; Clock::now() < until; bus.wait(20ms))
        if (come())
            return true;
    return false;
}

/// Runs one machine's part in another process, which ends well if it returns true.
template <class Work> pid_t elsewhere(const Work& work)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(work() ? 0 : 1);
    return child;
}

bool ended_well(pid_t child)
{
    int status = -1;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(BusTest, ALateNodeReceivesTheLastStateAndItsWordsReachTheMaster)
{
    const int domain = free_domain();
    int start[2];
    ASSERT_EQ(pipe(start), 0);
    const pid_t node = elsewhere([&] {
        char ready = 0;
        if (read(start[0], &ready, 1) != 1) // the states were sent before this node began
            return false;
        Bus bus("lo", domain, Bus::Role::node);
        std::optional<StateMessage> state;
        std::vector<ConfigMessage> configs;
        if (!in_time(bus, [&] {
                if (auto come = bus.state())
                    state = come;
                for (const ConfigMessage& config : bus.configs())
                    configs.push_back(config);
                return state && !configs.empty();
            }))
            return false;
        const bool right = state->frame == 7 && state->instant == std::vector<std::uint8_t>(1000, 7)
            && configs[0].node == "master" && configs[0].files == FileDigests{{"the program", "11"}, {"en.json", "33"}}
            && configs[0].layout == FileDigests{{"dome.json", "22"}};
        bus.send(ReadyMessage{"left", state->frame, 99, 12.5, true});
        std::optional<GoMessage> go;
        return in_time(bus,
                   [&] {
                       if (!go)
                           bus.send(ReadyMessage{"left", state->frame, 99, 12.5, true});
                       go = bus.go();
                       return go.has_value();
                   })
            && right && go->frame == 7 && go->members == std::vector<std::string>{"left", "right"};
    });
    Bus bus("lo", domain, Bus::Role::master);
    bus.send(ConfigMessage{"master", {{"the program", "11"}, {"en.json", "33"}}, {{"dome.json", "22"}}});
    for (std::uint8_t frame = 1; frame <= 7; ++frame)
        bus.send(StateMessage{frame, std::vector<std::uint8_t>(1000, frame)});
    ASSERT_EQ(write(start[1], "x", 1), 1);
    std::vector<ReadyMessage> readies;
    EXPECT_TRUE(in_time(bus, [&] {
        readies = bus.readies();
        return !readies.empty();
    }));
    if (!readies.empty()) {
        EXPECT_EQ(readies[0].node, "left");
        EXPECT_EQ(readies[0].frame, 7);
        EXPECT_EQ(readies[0].digest, 99u);
        EXPECT_EQ(readies[0].frame_ms, 12.5);
        EXPECT_TRUE(readies[0].barrier);
    }
    const auto over = [&] {
        siginfo_t info{};
        return waitid(P_PID, id_t(node), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == node;
    };
    for (const auto until = Clock::now() + 10s; Clock::now() < until && !over(); bus.wait(20ms)) {
        bus.send(GoMessage{7, {"left", "right"}});
        bus.readies(), bus.configs();
    }
    EXPECT_TRUE(ended_well(node));
}

/// A page of the instruments is larger than a datagram, and is there for those that join late, too.
TEST(BusTest, ALateNodeReceivesTheLastPage)
{
    const int domain = free_domain();
    int start[2];
    ASSERT_EQ(pipe(start), 0);
    Panel panel{{640, 480}, std::vector<std::uint8_t>(2 * 640 * 480)};
    std::mt19937 random(3);
    for (std::uint8_t& texel : panel.texels)
        texel = std::uint8_t(random()); // packed, it is as large
    const pid_t node = elsewhere([&] {
        char ready = 0;
        if (read(start[0], &ready, 1) != 1)
            return false;
        Bus bus("lo", domain, Bus::Role::node);
        std::optional<PageMessage> page;
        return in_time(bus,
                   [&] {
                       if (auto come = bus.page())
                           page = come;
                       return page.has_value();
                   })
            && page->number == 9 && panel_of(*page).size == panel.size && panel_of(*page).texels == panel.texels;
    });
    Bus bus("lo", domain, Bus::Role::master);
    bus.send(page_of(Panel{{1, 1}, {7, 8}}, 8));
    bus.send(page_of(panel, 9));
    ASSERT_EQ(write(start[1], "x", 1), 1);
    for (const auto until = Clock::now() + 10s; Clock::now() < until;) {
        siginfo_t info{};
        if (waitid(P_PID, id_t(node), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == node)
            break;
        bus.wait(20ms);
    }
    EXPECT_TRUE(ended_well(node));
}

TEST(BusTest, InterfacesAreNamesOrNetworks)
{
    EXPECT_EQ(interface_of("lo").address, "127.0.0.1");
    EXPECT_TRUE(interface_of("lo").loopback);
    EXPECT_EQ(interface_of("127.0.0.0/8").name, "lo");
    const auto said = [](const std::string& wanted) {
        try {
            interface_of(wanted);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_TRUE(said("no0").starts_with("interface \"no0\" is none of this machine; one of these is right: lo (127.0.0.1)"))
        << said("no0");
    EXPECT_TRUE(said("203.0.113.0/24").starts_with("interface \"203.0.113.0/24\" is none of this machine"))
        << said("203.0.113.0/24");
    for (const char* wrong : {"127.0.0.0/", "127.0.0.0/33", "127.0.0.0/0", "127.0.0/8", "a/8", "127.0.0.0/8x"})
        EXPECT_EQ(said(wrong),
            "interface \"" + std::string(wrong) + "\" is not a network; one such as \"192.168.7.0/24\" is right");
}

TEST(BusTest, ANetworkWithAGatewayLeadsElsewhere)
{
    const auto routes = testing::write_text("routes",
        "Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\n"
        "enp3s0\t0007A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\n"
        "enp4s0\t00000000\t010AA8C0\t0003\t0\t0\t0\t00000000\n");
    EXPECT_FALSE(leads_elsewhere({"enp3s0", "192.168.7.1"}, routes));
    EXPECT_TRUE(leads_elsewhere({"enp4s0", "192.168.10.2"}, routes));
    EXPECT_FALSE(leads_elsewhere({"enp4s0", "192.168.10.2"}, "/nowhere"));
}

} // namespace
} // namespace starbow::bus_test
