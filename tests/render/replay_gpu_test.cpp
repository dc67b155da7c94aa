// A flight's replay draws the same pictures to the byte.
#include "runtime/exhibit/replay_renderer.h"
#include "runtime/flight/history.h"
#include "runtime/flight/recorder.h"
#include "runtime/flight/replay.h"
#include "runtime/operation/record_files.h"
#include "tests/support/gpu_environment.h"

namespace replay_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;

namespace {

using Pictures = std::vector<std::vector<std::uint8_t>>;

/// The visitor's and builder's input: thrust, a turn, an effect off, the head aside, the tilt key, a test pattern, undo.
RecordEntry at(int frame)
{
    RecordEntry entry{.dt_ns = 16'000'000 + 1237 * frame};
    entry.exposure_ev = 0.01 * frame - 1;
    Controls& controls = entry.controls;
    controls.lever = std::min(0.3, 0.025 * frame);
    controls.turn = {0.3 * std::sin(0.1 * frame), 0.7, 0};
    controls.head = {{0.01 * frame, 0, 0.1}, glm::angleAxis(0.01 * frame, dvec3(0, 1, 0))};
    controls.set(Switch::doppler, frame == 7);
    controls.turn_by = frame == 9 ? 10 : 0;
    controls.set(Switch::pattern, frame > 20);
    controls.set(Switch::undo, frame == 14);
    return entry;
}

} // namespace

TEST(ReplayFrames, AreTheSameToTheByte)
{
    const Layout layout = one_view(Planar{}, {120, 90});
    const std::string scene = avenue().world.scene.start.scene;
    RecordHeader header{.scene = "avenue", .layout = "desk"};
    header.start = {avenue().world.scene.start};
    header.seconds_per_time_unit = avenue().world.scene.seconds_per_time_unit();
    const std::filesystem::path file = starbow::testing::scratch("frames.jsonl");
    std::vector<Pictures> live;
    {
        Recorder recorder(file, header, [](LogKind, const std::string& line) { ADD_FAILURE() << line; });
        OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
        ReplayRenderer replay_renderer(
            offscreen, Pattern::none, header.exposing, header.start.exposure_ev, starbow::testing::words());
        Flight flight = flight_at(header.start, header.rules);
        History history;
        for (int i = 0; i < 24; ++i) {
            const RecordEntry entry = at(i);
            flight = flown(
                flight, history, entry.controls, entry.dt_ns, header.rules, header.seconds_per_time_unit, header.start);
            recorder.keep(entry, flight);
            replay_renderer.take(entry, flight);
            live.push_back(replay_renderer.picture(flight, scene, nullptr));
        }
        recorder.end(flight);
    }
    Replay replay(file);
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    ReplayRenderer replay_renderer(
        offscreen, Pattern::none, replay.header().exposing, replay.header().start.exposure_ev, starbow::testing::words());
    Flight flight = flight_at(replay.header().start, replay.header().rules);
    History history;
    std::size_t frame = 0;
    int changed = 0;
    for (; const auto entry = replay.next(); ++frame) {
        flight = flown(flight, history, entry->controls, entry->dt_ns, replay.header().rules,
            replay.header().seconds_per_time_unit, replay.header().start);
        replay.compare(flight);
        replay_renderer.take(*entry, flight);
        ASSERT_LT(frame, live.size());
        ASSERT_EQ(replay_renderer.picture(flight, scene, nullptr), live[frame]) << frame;
        changed += frame > 0 && live[frame] != live[frame - 1];
    }
    EXPECT_EQ(frame, live.size());
    EXPECT_GT(changed, 20); // otherwise all pictures could be one
    EXPECT_EQ(replay.verdict(), "the same to the bit at 1 check");
}

} // namespace replay_gpu_test
