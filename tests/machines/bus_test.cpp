// Messages between machines, here between processes on the loopback interface.
#include "config/json/error.h"
#include "runtime/machines/bus.h"
#include "runtime/machines/interface.h"
#include "runtime/machines/page_bytes.h"
#include "tests/support/files.h"
#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

/// Of the address sanitizer's runtime; null without it.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes() __attribute__((weak));

namespace starbow::bus_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A domain that no other test process uses at the time.
int free_domain() { return 20 + int(getpid() % 150); }

/// A bus on the loopback interface, open. said: receives its lines.
Bus open_bus(int domain, Bus::Role role, const std::string& exhibit = "dome", std::vector<std::string>* said = nullptr)
{
    Bus bus({"lo", domain, exhibit}, role, [said](LogKind, const std::string& line) {
        if (said)
            said->push_back(line);
    });
    bus.know({"master", "left"});
    EXPECT_TRUE(bus.follow());
    return bus;
}

/// Waits until `come` is true, for a minute at most, which no machine needs for what a test waits for here.
template <class Come> bool in_time(Bus& bus, const Come& come)
{
    for (const auto until = Clock::now() + 60s; Clock::now() < until; bus.wait(20ms))
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
        Bus bus = open_bus(domain, Bus::Role::node);
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
        const bool right = state->frame == 7 && state->bytes == std::vector<std::uint8_t>(1000, 7)
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
    Bus bus = open_bus(domain, Bus::Role::master);
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
        Bus bus = open_bus(domain, Bus::Role::node);
        std::optional<PageMessage> page;
        return in_time(bus,
                   [&] {
                       bus.state(); // it says whom the node follows
                       if (auto come = bus.page())
                           page = come;
                       return page.has_value();
                   })
            && page->number == 9 && panel_of(*page).size == panel.size && panel_of(*page).texels == panel.texels;
    });
    Bus bus = open_bus(domain, Bus::Role::master);
    bus.send(page_of(Panel{{1, 1}, {7, 8}}, 8));
    bus.send(page_of(panel, 9));
    bus.send(StateMessage{1, {1}});
    ASSERT_EQ(write(start[1], "x", 1), 1);
    for (const auto until = Clock::now() + 10s; Clock::now() < until;) {
        siginfo_t info{};
        if (waitid(P_PID, id_t(node), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == node)
            break;
        bus.wait(20ms);
    }
    EXPECT_TRUE(ended_well(node));
}

bool has(const std::vector<std::string>& said, const std::string& text)
{
    return std::ranges::any_of(said, [&](const std::string& line) { return line.find(text) != line.npos; });
}

/// Runs a node of the exhibit "dome" in another process until `come`, which gets its bus and its last state. `sends` is this
/// process's part meanwhile; it opens its bus at the first call, as no process may be forked from one with a bus.
template <class Come, class Send> bool node_hears(int domain, const Come& come, const Send& sends)
{
    const pid_t node = elsewhere([&] {
        std::vector<std::string> said;
        Bus bus = open_bus(domain, Bus::Role::node, "dome", &said);
        std::optional<StateMessage> state;
        return in_time(bus, [&] {
            bus.follow();
            if (auto one = bus.state())
                state = std::move(one);
            return come(bus, state, said);
        });
    });
    for (const auto until = Clock::now() + 30s; Clock::now() < until; std::this_thread::sleep_for(5ms)) {
        siginfo_t info{};
        if (waitid(P_PID, id_t(node), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == node)
            break;
        sends();
    }
    return ended_well(node);
}

/// Two exhibits on one network and domain: each hears its own alone, however much the other one sends.
TEST(BusTest, AnotherExhibitsMessagesAreLeftOut)
{
    const int domain = free_domain();
    const pid_t other = elsewhere([&] {
        Bus bus = open_bus(domain, Bus::Role::master, "another dome");
        for (std::int64_t frame = 1000000; getppid() != 1; ++frame) { // until it is killed, or the test is
            bus.send(StateMessage{frame, {9}, 1, 1000000});
            bus.send(ConfigMessage{"master", {{"the program", "other"}}, {}});
            bus.send(GoMessage{frame, {}});
            std::this_thread::sleep_for(1ms);
        }
        return true;
    });
    std::optional<Bus> bus;
    std::int64_t frame = 0;
    int heard = 0;
    EXPECT_TRUE(node_hears(
        domain,
        [&](Bus& node, const std::optional<StateMessage>& state, const std::vector<std::string>& said) {
            for (const ConfigMessage& config : node.configs())
                if (config.files != FileDigests{{"the program", "11"}})
                    _exit(2);
            const std::optional<GoMessage> go = node.go();
            if ((state && state->bytes != std::vector<std::uint8_t>{7}) || (go && go->frame >= 1000000))
                _exit(3);
            heard += go.has_value();
            return heard >= 20 && has(said, "of another exhibit, 'another dome', and this one is 'dome'");
        },
        [&] {
            if (!bus) {
                bus.emplace(open_bus(domain, Bus::Role::master));
                bus->send(ConfigMessage{"master", {{"the program", "11"}}, {}});
            }
            bus->send(StateMessage{++frame, {7}});
            bus->send(GoMessage{frame, {}});
        }));
    kill(other, SIGKILL);
    waitpid(other, nullptr, 0);
}

/// A node follows the first master, also where a second one sends ten times as much; and takes the second once the first has
/// ended.
TEST(BusTest, ANodeFollowsOneMasterUntilItIsGone)
{
    const int domain = free_domain();
    int heard[2], begin[2];
    ASSERT_EQ(pipe(heard), 0);
    ASSERT_EQ(pipe(begin), 0);
    const pid_t second = elsewhere([&] {
        char mark = 0;
        if (read(begin[0], &mark, 1) != 1)
            return false;
        Bus bus = open_bus(domain, Bus::Role::master);
        bus.send(ConfigMessage{"master", {{"the program", "second"}}, {}});
        for (std::int64_t later = 1000000; getppid() != 1; ++later) {
            bus.send(StateMessage{later, {8}});
            std::this_thread::sleep_for(500us);
        }
        return true;
    });
    std::optional<Bus> first;
    std::int64_t frame = 0, since_second = 0;
    int own = 0, others = 0;
    EXPECT_TRUE(node_hears(
        domain,
        [&](Bus& node, const std::optional<StateMessage>& state, const std::vector<std::string>& said) {
            for (const ConfigMessage& config : node.configs())
                if (config.files[0].second == "second" && others == 0)
                    _exit(2);
            if (!state)
                return false;
            if (state->bytes[0] == 7) {
                if (others > 0)
                    _exit(3);
                if (++own == 1 && write(heard[1], "x", 1) != 1)
                    _exit(4);
                return false;
            }
            return ++others > 20 && own > 20 && has(said, "a second master");
        },
        [&] {
            if (!first && since_second == 0) {
                first.emplace(open_bus(domain, Bus::Role::master));
                fcntl(heard[0], F_SETFL, O_NONBLOCK);
            }
            char mark = 0;
            if (since_second == 0 && read(heard[0], &mark, 1) == 1)
                since_second = write(begin[1], "x", 1);
            if (first)
                first->send(StateMessage{++frame, {7}});
            if (since_second > 0 && ++since_second > 600) // three seconds and more
                first.reset();
        }));
    kill(second, SIGKILL);
    waitpid(second, nullptr, 0);
}

/// Names that the layout lacks are keys of a topic, which would stay in memory for ever.
TEST(BusTest, UnknownNodesTakeNoMemory)
{
    const int domain = free_domain();
    const auto used_kb = [] {
        if (__sanitizer_get_current_allocated_bytes) // what is freed stays in the sanitizer's quarantine
            return long(__sanitizer_get_current_allocated_bytes() / 1024);
        const struct mallinfo2 about = mallinfo2();
        return long((about.uordblks + about.hblkhd) / 1024);
    };
    const std::string large(50000, 'A');
    const pid_t rogue = elsewhere([&] {
        Bus bus = open_bus(domain, Bus::Role::node);
        for (int i = 0; i < 4000 && getppid() != 1; ++i) {
            bus.send(ConfigMessage{"rogue " + std::to_string(i), {{"a file", large}}, {}});
            std::this_thread::sleep_for(1ms);
        }
        for (;;) {
            bus.send(ConfigMessage{"left", {{"the program", "11"}}, {}});
            std::this_thread::sleep_for(20ms);
        }
        return true;
    });
    std::vector<std::string> said;
    Bus bus = open_bus(domain, Bus::Role::master, "dome", &said);
    const long before = used_kb();
    std::vector<ConfigMessage> configs;
    EXPECT_TRUE(in_time(bus, [&] {
        bus.follow();
        for (ConfigMessage& config : bus.configs())
            configs.push_back(std::move(config));
        return !configs.empty() && configs.back().node == "left";
    }));
    EXPECT_LE(configs.size(), 17u); // a few strangers, as a layout to come may have them
    // 4000 times 50 kB are 200 MB; what is still on its way through the engine's queues goes.
    EXPECT_TRUE(in_time(bus, [&] { return bus.configs(), used_kb() - before < 40000; })) << used_kb() - before;
    EXPECT_EQ(said.size(), 1u);
    kill(rogue, SIGKILL);
    waitpid(rogue, nullptr, 0);
}

/// An interface that this machine lacks is waited for.
TEST(BusTest, AnInterfaceMayComeLater)
{
    std::vector<std::string> said;
    Bus bus(
        {"203.0.113.0/24", 7, "dome"}, Bus::Role::master, [&](LogKind, const std::string& line) { said.push_back(line); });
    EXPECT_FALSE(bus.follow());
    EXPECT_FALSE(bus.follow());
    bus.send(StateMessage{1, {1}});
    EXPECT_FALSE(bus.state() || bus.go() || bus.page());
    EXPECT_TRUE(bus.readies().empty() && bus.configs().empty());
    bus.wait(1ms);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_TRUE(
        said[0].starts_with("the network of the exhibit's machines can't be had (interface \"203.0.113.0/24\" is none "
                            "of this machine"))
        << said[0];
    EXPECT_THROW(Bus({"203.0.113.0/99", 7, "dome"}, Bus::Role::master, [](LogKind, const std::string&) {}), InputError);
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

TEST(BusTest, AddressesAreHereOrNot)
{
    for (const char* here : {"127.0.0.1", "127.0.3.1", "0.0.0.0", "::"})
        EXPECT_TRUE(is_here(here)) << here;
    for (const char* away : {"192.0.2.7", "2001:db8::7", "", "lo"}) // RFC 5737, RFC 3849
        EXPECT_FALSE(is_here(away)) << away;
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
