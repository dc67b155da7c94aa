// Counts of calls of Vulkan: of calls that this file makes by itself, and of a frame, which has ceilings, so that no change
// adds a call unseen.
#include "runtime/render/command_counts.h"
#include "runtime/render/pass_timer.h"
#include "tests/support/gpu_environment.h"
#include <thread>

namespace starbow::gpu_test::command_counts_gpu_test {
namespace {

std::array<std::uint64_t, CommandCounts::kinds> since(const CommandCounts& before) { return (command_counts() - before).of; }

void turn_over(vk::CommandBuffer commands, const Image& image)
{
    transition(commands, image, vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits2::eNone, {},
        vk::ImageLayout::eGeneral, vk::PipelineStageFlagBits2::eTransfer, {});
}

TEST(CommandCounts, EachCallOnceAndOnlyTheThreadsOwn)
{
    count_commands(device());
    count_commands(device()); // counts no call twice
    const Image image
        = make_image(device(), {vk::Format::eR8G8B8A8Unorm, {8, 8}, vk::ImageUsageFlagBits::eColorAttachment, 1, 1});
    const Buffer buffer = make_mapped_buffer(device(), 1000, vk::BufferUsageFlagBits::eUniformBuffer);
    const vk::RenderingAttachmentInfo colour(*image.view, vk::ImageLayout::eColorAttachmentOptimal);
    const CommandCounts before = command_counts();
    device().now([&](vk::CommandBuffer commands) {
        turn_over(commands, image);
        turn_over(commands, image);
        transition(commands, image, vk::ImageLayout::eGeneral, vk::PipelineStageFlagBits2::eTransfer, {},
            vk::ImageLayout::eColorAttachmentOptimal, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
            vk::AccessFlagBits2::eColorAttachmentWrite);
        device().begin_rendering(commands, {{}, {{0, 0}, {8, 8}}, 1, 0, colour});
        set_area(commands, {0, 0}, {8, 8});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines().fade(image.format));
        commands.pushConstants<float>(*pipelines().layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, 0.5f);
        for (int i = 0; i < 5; ++i)
            commands.draw(3, 1, 0, 0);
        device().end_rendering(commands);
    });
    const std::vector<std::byte> bytes(700);
    copy_to(buffer, bytes, 300);
    std::thread([&] {
        device().now([&](vk::CommandBuffer commands) { turn_over(commands, image); });
        copy_to(buffer, bytes);
    }).join();
    // submits, command buffers, passes, barriers, draws, pipelines, descriptor sets, pushes, states, bytes
    EXPECT_EQ(since(before), (std::array<std::uint64_t, CommandCounts::kinds>{1, 1, 1, 3, 5, 1, 0, 1, 2, 700}));
}

TEST(CommandCounts, ADeviceIsCountedWhereAnotherWasSince)
{
    count_commands(device());
    Device other({.name = device_options(false).name});
    count_commands(other);
    const CommandCounts before = command_counts();
    for (Device* each : {&device(), &other})
        each->now([](vk::CommandBuffer) {});
    EXPECT_EQ((command_counts() - before).of[CommandCounts::submits], 2u);
}

TEST(InvocationCounter, ShadersRunAsOftenAsTheirDrawsSay)
{
    Device counting({.invocations = true, .name = device_options(false).name});
    Pipelines own(counting);
    const Image image
        = make_image(counting, {vk::Format::eR8G8B8A8Unorm, {256, 256}, vk::ImageUsageFlagBits::eColorAttachment, 1, 1});
    const vk::RenderingAttachmentInfo colour(*image.view, vk::ImageLayout::eColorAttachmentOptimal);
    InvocationCounter counter(counting);
    counting.now([&](vk::CommandBuffer commands) {
        counter.begin(commands);
        transition(commands, image, vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits2::eNone, {},
            vk::ImageLayout::eColorAttachmentOptimal, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
            vk::AccessFlagBits2::eColorAttachmentWrite);
        counting.begin_rendering(commands, {{}, {{0, 0}, {256, 256}}, 1, 0, colour});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, own.fade(image.format));
        commands.pushConstants<float>(*own.layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, 0.5f);
        for (const int width : {256, 128}) {
            set_area(commands, {0, 0}, {width, 256});
            commands.draw(3, 2, 0, 0);
        }
        counting.end_rendering(commands);
    });
    const std::vector<DrawInvocations> draws = counter.end();
    ASSERT_EQ(draws.size(), 2u);
    EXPECT_EQ(draws[0].pipeline, own.fade(image.format));
    EXPECT_EQ(draws[0].vertex, 6u) << "two instances of a triangle";
    // A device may count whole blocks, and those twice that two triangles share: llvmpipe blocks of 4x4, and it cuts the
    // triangle into two.
    const double blocks = 2 * 64 * 16;
    for (const std::size_t k : {0, 1}) {
        const double pixels = 2 * 256 * (k == 0 ? 256 : 128);
        EXPECT_GE(double(draws[k].fragment), pixels);
        EXPECT_LE(double(draws[k].fragment), pixels + blocks);
    }
}

/// The avenue as an exhibit draws it (one of the draws is that of its Sun's glare), on llvmpipe with its default quality.
TEST(CommandCounts, AFrameHasItsCeilings)
{
    count_commands(device());
    OffscreenRenderer window(
        device(), pipelines(), avenue().world, one_view(Planar{60}, {800, 600}), default_quality(device(), false), false);
    window.frame().meter(true);
    PassTimer timer(device(), window);
    Shot shot = avenue().world.scene.start;
    shot.position.z = -8, shot.exposure_ev = -3;
    struct {
        double gamma;
        std::uint64_t draws, binds, others;
    } const ceilings[] = {{1, 24, 18, 44}, {4, 34, 43, 135}, {100, 128, 88, 333}};
    for (const auto& most : ceilings) {
        shot.u = {0, 0, -std::sqrt((most.gamma - 1) * (most.gamma + 1))};
        timer.counts(shot); // makes room and pipelines
        const auto first = timer.counts(shot).of, again = timer.counts(shot).of;
        EXPECT_EQ(first, again) << "the same frame asks the same";
        using Counts = CommandCounts;
        EXPECT_EQ(first[Counts::submits], 2u);
        EXPECT_EQ(first[Counts::command_buffers], 2u);
        EXPECT_GT(first[Counts::uploaded_bytes], 1000u);
        EXPECT_LE(first[Counts::draws], most.draws) << "at gamma " << most.gamma;
        EXPECT_LE(first[Counts::pipeline_binds] + first[Counts::descriptor_binds], most.binds) << "at gamma " << most.gamma;
        EXPECT_LE(
            first[Counts::passes] + first[Counts::barriers] + first[Counts::pushes] + first[Counts::states], most.others)
            << "at gamma " << most.gamma;
    }
}

} // namespace
} // namespace starbow::gpu_test::command_counts_gpu_test
