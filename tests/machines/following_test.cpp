// Which master a node follows, and which of several masters leads, with a clock of the test's own.
#include "runtime/machines/following.h"
#include <gtest/gtest.h>
#include <vector>

namespace starbow::following_test {
namespace {

using namespace std::chrono_literals;

constexpr Following::Time start = Following::Time{} + 1000h;

TEST(FollowingTest, OneMasterIsFollowedUntilItIsGone)
{
    Following node{};
    EXPECT_FALSE(node.drops(true, start)); // nobody is followed yet
    EXPECT_TRUE(node.hears(1, start));
    for (int i = 1; i < 100; ++i) {
        EXPECT_FALSE(node.hears(2, start + i * 20ms));
        EXPECT_FALSE(node.drops(false, start + i * 20ms));
    }
    EXPECT_TRUE(node.hears(1, start + 2s));
    EXPECT_FALSE(node.drops(false, start + 4999ms));
    EXPECT_TRUE(node.drops(false, start + 5s)); // it was silent for three seconds
    EXPECT_TRUE(node.hears(2, start + 5s));
    EXPECT_FALSE(node.hears(1, start + 5s));
    EXPECT_TRUE(node.drops(true, start + 5s)); // the network says that it has ended
    EXPECT_TRUE(node.hears(1, start + 5s));
}

/// Masters on one network that hear each other's states, and nodes, each of which follows one.
struct Network {
    struct Machine {
        std::uint64_t number;
        Leading::Time began;
        Leading leading{number, began};
        bool on = true, sends = false;
    };
    std::vector<Machine> masters{};
    std::vector<Following> nodes{};
    Leading::Time now = start;

    int in_step(std::uint64_t number) const
    {
        return int(std::ranges::count_if(nodes, [&](const Following& node) { return node.master() == number; }));
    }
    /// Frames of 20 ms.
    void run(std::chrono::milliseconds time)
    {
        for (const auto end = now + time; now < end; now += 20ms)
            for (Machine& one : masters) {
                if (!one.on)
                    continue;
                one.sends = one.leading.leads(in_step(one.number) > 0, now);
                if (!one.sends)
                    continue;
                const Rival rival{one.number, one.leading.led_ms(now), in_step(one.number) > 0};
                for (Machine& other : masters)
                    if (other.on && other.number != one.number)
                        other.leading.hears(rival, in_step(other.number) > 0, now);
                for (Following& node : nodes) {
                    node.drops(false, now);
                    node.hears(one.number, now);
                }
            }
    }
    int senders() const
    {
        return int(std::ranges::count_if(masters, [](const Machine& one) { return one.on && one.sends; }));
    }
};

TEST(FollowingTest, ASecondMasterStandsBackUntilTheFirstIsGone)
{
    for (const std::uint64_t second : {1, 9}) { // neither number counts
        Network net{.masters = {{5, start}}, .nodes = std::vector<Following>(2)};
        net.run(980ms);
        EXPECT_EQ(net.senders(), 0); // it listens first
        net.run(1s);
        EXPECT_EQ(net.in_step(5), 2);
        net.masters.push_back({second, net.now});
        net.run(60s);
        EXPECT_EQ(net.in_step(5), 2);
        EXPECT_FALSE(net.masters[1].sends);
        EXPECT_TRUE(net.masters[1].leading.hears_other(net.now));
        net.masters[0].on = false;
        net.run(2900ms);
        EXPECT_FALSE(net.masters[1].sends);
        net.run(1s);
        EXPECT_EQ(net.in_step(second), 2);
        net.masters[0] = {5, net.now}; // the first one is started again
        net.run(60s);
        EXPECT_EQ(net.in_step(second), 2);
        EXPECT_EQ(net.senders(), 1);
    }
}

/// All machines of a museum get their power at once.
TEST(FollowingTest, OfMastersThatBeginTogetherOneLeads)
{
    Network net{.masters = {{5, start}, {3, start}, {4, start + 10ms}}, .nodes = std::vector<Following>(3)};
    net.run(10s);
    EXPECT_EQ(net.senders(), 1);
    const auto leader = std::ranges::find_if(net.masters, &Network::Machine::sends);
    ASSERT_NE(leader, net.masters.end());
    EXPECT_EQ(net.in_step(leader->number), 3);
    Network alone{.masters = {{5, start}, {3, start}}};
    alone.run(10s);
    EXPECT_EQ(alone.senders(), 1); // also without nodes
}

/// A master whose nodes follow it never stands back, whatever another one says of itself.
TEST(FollowingTest, AStrayMasterTakesNobodysNodes)
{
    Network net{.masters = {{5, start}}, .nodes = std::vector<Following>(1)};
    net.run(2s);
    Leading& leading = net.masters[0].leading;
    for (int i = 0; i < 1000; ++i) {
        leading.hears({1, 1000000000, i % 2 == 0}, net.in_step(5) > 0, net.now);
        net.run(20ms);
    }
    EXPECT_TRUE(net.masters[0].sends);
    EXPECT_EQ(net.in_step(5), 1);
    net.nodes.clear(); // while the network is too full for its nodes, another one's word is not enough either
    for (int i = 0; i < 100; ++i) {
        leading.hears({1, 1000000000, false}, false, net.now);
        net.run(20ms);
    }
    EXPECT_TRUE(net.masters[0].sends);
    leading.hears({1, 0, true}, false, net.now); // but its nodes' word is
    net.run(20ms);
    EXPECT_FALSE(net.masters[0].sends);
}

} // namespace
} // namespace starbow::following_test
