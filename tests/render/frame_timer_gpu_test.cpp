// A frame in two parts: the device draws the world while the screens are not ready yet, and the wait for them is no cost.
#include "runtime/render/frame_timer.h"
#include "tests/support/gpu_environment.h"
#include <chrono>
#include <thread>

namespace starbow::gpu_test::frame_timer_gpu_test {
namespace {

/// A frame of two parts that write a 1 each, once the second one may begin.
struct Parts {
    vk::raii::CommandBuffers commands{device().device, {*device().pool, vk::CommandBufferLevel::ePrimary, 2}};
    Buffer written = make_mapped_buffer(device(), 8, vk::BufferUsageFlagBits::eTransferDst);
    vk::raii::Fence done{device().device, vk::FenceCreateInfo{}};
    vk::raii::Event ready{device().device, vk::EventCreateInfo{}}; ///< the second part waits for it, as for the screens
    FrameTimer timer{device()};

    Parts()
    {
        std::memset(written.mapped, 0, 8);
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
            if (i == 0)
                timer.pause(*commands[0]);
            else
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
    Parts frame;
    const auto began = Clock::now();
    submit_frame(device(), *frame.commands[0], *frame.commands[1], {}, {}, *frame.done);
    while (frame.part(0) == 0 && Clock::now() - began < std::chrono::seconds(20))
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(frame.part(0), 1u) << "the world waits for the screens";
    EXPECT_EQ(frame.part(1), 0u) << "the picture does not wait for the screens";
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(frame.part(1), 0u);
    frame.ready.set();
    ASSERT_EQ(device().device.waitForFences(*frame.done, true, 20'000'000'000), vk::Result::eSuccess);
    EXPECT_EQ(frame.part(1), 1u);
    ASSERT_TRUE(frame.timer.ms());
    EXPECT_LT(*frame.timer.ms(), 150); // two fills of 4 bytes, with half of the wait for a busy machine
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
