// The master's count of the nodes in step.
#include "runtime/machines/gate.h"
#include <gtest/gtest.h>

namespace starbow::gate_test {
namespace {

constexpr std::uint64_t state = 77;

/// A gate of two nodes that are in step since frame 0.
Gate two_in_step()
{
    Gate gate({"left", "right"});
    gate.begin(0, state);
    gate.hear({"left", 0, state, 4});
    gate.hear({"right", 0, state, 9});
    gate.go();
    gate.take_events();
    return gate;
}

std::vector<std::string> events_of(Gate& gate)
{
    std::vector<std::string> all;
    for (const NodeEvent& event : gate.take_events()) {
        const char* kind = event.kind == NodeEvent::Kind::joins ? " joins "
            : event.kind == NodeEvent::Kind::leaves             ? " leaves "
            : event.kind == NodeEvent::Kind::differs            ? " differs "
                                                                : " doubled ";
        all.push_back(event.node + kind + std::to_string(event.frame));
    }
    return all;
}

using List = std::vector<std::string>;

TEST(GateTest, WaitsForNobodyAtFirst)
{
    Gate gate({"left", "right"});
    gate.begin(0, state);
    EXPECT_TRUE(gate.complete());
    EXPECT_EQ(gate.go().members, List{});
}

TEST(GateTest, WaitsForThoseInStep)
{
    Gate gate = two_in_step();
    gate.begin(1, state);
    EXPECT_FALSE(gate.complete());
    gate.hear({"right", 1, state, 9});
    gate.hear({"left", 0, state, 4}); // an old word
    EXPECT_FALSE(gate.complete());
    gate.hear({"left", 1, state, 4});
    EXPECT_TRUE(gate.complete());
    const GoMessage go = gate.go();
    EXPECT_EQ(go.frame, 1);
    EXPECT_EQ(go.members, (List{"left", "right"}));
    EXPECT_EQ(events_of(gate), List{});
}

/// A node's word with one sample of a view.
ReadyMessage metered(const char* node, std::int64_t frame, float luminance)
{
    return {node, frame, state, 4, false, {{0, {{luminance, 1}}, {}}}};
}

/// The luminances of a gate's samples.
std::vector<float> luminances(const Gate& gate)
{
    std::vector<float> all;
    for (const ViewSamples& view : gate.samples())
        for (const LuminanceSample& sample : view.surfaces)
            all.push_back(sample.luminance);
    return all;
}

TEST(GateTest, LightOfThePictureBeforeALeapIsForgotten)
{
    Gate gate = two_in_step();
    gate.begin(1, state);
    gate.hear(metered("left", 1, 10)), gate.hear(metered("right", 1, 20));
    gate.go();
    EXPECT_EQ(luminances(gate), (std::vector<float>{10, 20}));
    gate.begin(2, state);
    gate.hear(metered("right", 2, 21)); // the left one is late, and counts as it last said
    gate.go();
    EXPECT_EQ(luminances(gate), (std::vector<float>{10, 21}));

    gate.begin(3, state, true);
    EXPECT_EQ(luminances(gate), std::vector<float>{});
    gate.hear(metered("left", 2, 11)); // late again: of the other picture
    gate.hear(metered("right", 3, 300));
    gate.go();
    EXPECT_EQ(luminances(gate), std::vector<float>{300});
    gate.begin(4, state);
    gate.hear(metered("left", 3, 400));
    gate.go();
    EXPECT_EQ(luminances(gate), (std::vector<float>{400, 300}));
}

TEST(GateTest, TwoProgramsWithOneNameAreSaidOnce)
{
    Gate gate = two_in_step();
    const auto speaks = [&](std::int64_t frame, std::uint64_t sender) {
        ReadyMessage word{"left", frame, state, 4};
        word.sender = sender;
        gate.hear(word);
    };
    const auto frames = [&](std::int64_t from, std::vector<std::uint64_t> senders) {
        for (std::int64_t frame = from; frame < from + 4; ++frame) {
            gate.begin(frame, state);
            for (const std::uint64_t sender : senders)
                speaks(frame, sender);
            gate.hear({"right", frame, state, 9});
            gate.go();
        }
        return events_of(gate);
    };
    EXPECT_EQ(frames(1, {5}), List{});
    EXPECT_EQ(frames(5, {6}), List{}) << "one that was started again";
    EXPECT_EQ(frames(9, {6, 7}), List{"left doubled 10"});
    EXPECT_EQ(frames(13, {7}), List{}) << "one was stopped";
}

TEST(GateTest, AnotherLayoutMayHaveOtherNodes)
{
    Gate gate = two_in_step();
    gate.have({"left", "up"});
    gate.begin(1, state);
    gate.hear({"right", 1, state, 4});
    gate.hear({"left", 1, state, 4});
    EXPECT_TRUE(gate.complete()) << "up has never been in";
    EXPECT_EQ(gate.go().members, List{"left"});
    EXPECT_EQ(events_of(gate), List{}) << "left has stayed in, and nobody misses right";
    gate.begin(2, state);
    gate.hear({"up", 2, state, 4});
    EXPECT_FALSE(gate.complete());
    EXPECT_EQ(gate.go().members, List{"up"});
}

TEST(GateTest, ScreensChangeTogetherWhereAllInStepCan)
{
    Gate gate = two_in_step();
    EXPECT_FALSE(gate.barrier());
    gate.begin(1, state);
    gate.hear({"left", 1, state, 4, true});
    EXPECT_FALSE(gate.barrier());
    gate.hear({"right", 1, state, 4, true});
    EXPECT_TRUE(gate.barrier());
    gate.refuse("right", true);
    gate.begin(2, state);
    gate.hear({"right", 2, state, 4, false});
    EXPECT_TRUE(gate.barrier()) << "a refused node does not count";
}

TEST(GateTest, SilentNodesAreLeftOutAfterSixFrames)
{
    Gate gate = two_in_step();
    for (int frame = 1; frame <= 10; ++frame) {
        gate.begin(frame, state);
        gate.hear({"left", frame, state, 4});
        EXPECT_EQ(gate.complete(), frame > Gate::silent_frames) << frame;
        EXPECT_EQ(gate.go().members, List{"left"});
        EXPECT_EQ(events_of(gate), frame == Gate::silent_frames ? List{"right leaves 6"} : List{}) << frame;
    }
    // It comes back with its first frame, and is waited for from the next one on.
    gate.begin(11, state);
    gate.hear({"left", 11, state, 4});
    gate.hear({"right", 11, state, 4});
    EXPECT_EQ(gate.go().members, (List{"left", "right"}));
    EXPECT_EQ(events_of(gate), List{"right joins 11"});
    gate.begin(12, state);
    gate.hear({"left", 12, state, 4});
    EXPECT_FALSE(gate.complete());
}

TEST(GateTest, AFrameInTimeForgivesLateOnes)
{
    Gate gate = two_in_step();
    for (int frame = 1; frame <= 60; ++frame) {
        gate.begin(frame, state);
        gate.hear({"left", frame, state, 4});
        if (frame % Gate::silent_frames == 0)
            gate.hear({"right", frame, state, 4});
        gate.go();
    }
    EXPECT_EQ(events_of(gate), List{});
}

TEST(GateTest, ANodeThatIsAFrameBehindIsLetIn)
{
    Gate gate({"left"});
    for (int frame = 0; frame < 4; ++frame) {
        gate.begin(frame, state);
        if (frame > 0)
            gate.hear({"left", frame - 1, state, 4});
        gate.go();
    }
    EXPECT_TRUE(gate.nodes().at("left").in);
}

TEST(GateTest, RefusedAndUnknownNodesCountForNothing)
{
    Gate gate = two_in_step();
    gate.refuse("right", true);
    gate.refuse("nobody", true);
    gate.begin(1, state);
    gate.hear({"left", 1, state, 4});
    gate.hear({"right", 1, state, 4});
    gate.hear({"nobody", 1, state, 4});
    EXPECT_TRUE(gate.complete());
    EXPECT_EQ(gate.go().members, List{"left"});
    gate.refuse("right", false);
    gate.begin(2, state);
    gate.hear({"right", 2, state, 4});
    gate.go();
    EXPECT_EQ(events_of(gate), List{"right joins 2"});
}

TEST(GateTest, FramesOfAnEarlierMasterCountForNothing)
{
    Gate gate({"left"});
    gate.begin(100, state);
    gate.hear({"left", 5000, state, 4});
    gate.go();
    EXPECT_FALSE(gate.nodes().at("left").in);
}

TEST(GateTest, AnotherStateIsSaid)
{
    Gate gate = two_in_step();
    gate.begin(1, state);
    gate.hear({"left", 1, state + 1, 4});
    EXPECT_EQ(events_of(gate), List{"left differs 1"});
}

TEST(GateTest, WaitsTwiceTheSlowestNodesTime)
{
    Gate gate({"left", "right"});
    EXPECT_EQ(gate.bound_s(), Gate::least_wait_s);
    gate.begin(0, state);
    gate.hear({"left", 0, state, 4});
    gate.hear({"right", 0, state, 60});
    EXPECT_EQ(gate.bound_s(), Gate::least_wait_s) << "nobody is in yet";
    gate.go();
    EXPECT_DOUBLE_EQ(gate.bound_s(), 0.12);
    gate.begin(1, state);
    gate.hear({"left", 1, state, 4});
    gate.hear({"right", 1, state, 6000});
    EXPECT_EQ(gate.bound_s(), Gate::most_wait_s);
}

} // namespace
} // namespace starbow::gate_test
