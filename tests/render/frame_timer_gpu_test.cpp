// A frame in two parts: the device draws the world while the screens are not ready yet, and the wait for them is no cost.
#include "runtime/render/frame_timer.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/waiting.h"

namespace starbow::gpu_test::frame_timer_gpu_test {
namespace {

/// A frame of two parts that write a 1 each, once the second one may begin. After the first part's end a 1 is written, too.
struct Parts {
    vk::raii::CommandBuffers commands{device().device, {*device().pool, vk::CommandBufferLevel::ePrimary, 2}};
    Buffer written = make_mapped_buffer(device(), 12, vk::BufferUsageFlagBits::eTransferDst);
    vk::raii::Fence done{device().device, vk::FenceCreateInfo{}};
    vk::raii::Event ready{device().device, vk::EventCreateInfo{}}; ///< the second part waits for it, as for the screens
    FrameTimer timer{device()};

    Parts()
    {
        std::memset(written.mapped, 0, 12);
        for (std::uint32_t i = 0; i < 2; ++i) {
            commands[i].begin(vk::CommandBufferBeginInfo());
            if (i == 0) {
                timer.begin(*commands[0]);
            } else {
                const vk::MemoryBarrier2 from_host(
                    vk::PipelineStageFlagBits2::eHost, {}, vk::PipelineStageFlagBits2::eAllCommands, {});
                commands[1].waitEvents2(*ready, vk::DependencyInfo({}, from_host));
                timer.resume(*commands[1]);
            }
            commands[i].fillBuffer(*written.buffer, 4 * i, 4, 1);
            const vk::MemoryBarrier2 to_host(vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferWrite,
                vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
            commands[i].pipelineBarrier2(vk::DependencyInfo({}, to_host));
            if (i == 0) {
                timer.pause(*commands[0]);
                commands[i].pipelineBarrier2(vk::DependencyInfo({}, to_host));
                commands[i].fillBuffer(*written.buffer, 8, 4, 1);
                commands[i].pipelineBarrier2(vk::DependencyInfo({}, to_host));
            } else
                timer.end(*commands[1]);
            commands[i].end();
        }
    }

    std::uint32_t part(std::size_t i) const { return static_cast<volatile std::uint32_t*>(written.mapped)[i]; }
};

} // namespace

TEST(FrameTimer, TheWaitForTheScreensIsNoCostAndTheWorldDoesNotWait)
{
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;
    Parts frame;
    const auto began = Clock::now();
    submit_frame(device(), *frame.commands[0], *frame.commands[1], {}, {}, *frame.done);
    EXPECT_TRUE(testing::until([&] { return frame.part(2) == 1; })) << "the world waits for the screens";
    const auto waits = Clock::now();
    EXPECT_EQ(frame.part(0), 1u);
    EXPECT_EQ(frame.part(1), 0u) << "the picture does not wait for the screens";
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // the screens'
    EXPECT_EQ(frame.part(1), 0u);
    const Milliseconds waited = Clock::now() - waits;
    frame.ready.set();
    ASSERT_EQ(device().device.waitForFences(*frame.done, true, 60'000'000'000), vk::Result::eSuccess);
    const Milliseconds took = Clock::now() - began;
    EXPECT_EQ(frame.part(1), 1u);
    ASSERT_TRUE(frame.timer.ms());
    EXPECT_LE(*frame.timer.ms(), (took - waited).count() + 1) << "with a millisecond for the difference of two clocks";
}

// Without parts the frame is one span, as before.
TEST(FrameTimer, AFrameInOnePartIsTimedWhole)
{
    FrameTimer timer(device());
    EXPECT_FALSE(timer.ms());
    device().now([&](vk::CommandBuffer commands) {
        timer.begin(commands);
        timer.begin_span(commands, "pass");
        timer.end_span(commands);
        timer.end(commands);
    });
    ASSERT_TRUE(timer.ms());
    EXPECT_GE(*timer.ms(), 0);
    ASSERT_EQ(timer.passes().size(), 1u);
    EXPECT_STREQ(timer.passes()[0].name, "pass");
    EXPECT_LE(timer.passes()[0].duration_ms, *timer.ms());
}

} // namespace starbow::gpu_test::frame_timer_gpu_test
