#include "pass_timer.h"
#include "debug.h"
#include "frame_timer.h"

namespace starbow {

void make_writable(vk::CommandBuffer commands, const Target& target)
{
    constexpr auto output = vk::PipelineStageFlagBits2::eColorAttachmentOutput;
    using Access = vk::AccessFlagBits2;
    vk::ImageMemoryBarrier2 barrier(output, Access::eColorAttachmentWrite, output,
        Access::eColorAttachmentWrite | Access::eColorAttachmentRead, vk::ImageLayout::eUndefined,
        vk::ImageLayout::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, target.image,
        {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

PassTimer::PassTimer(Device& device, OffscreenRenderer& renderer)
    : device_(device)
    , frame_(renderer.frame())
{
    for (std::size_t output = 0; output < renderer.layout().outputs.size(); ++output)
        targets_.push_back(renderer.target(output));
}

void PassTimer::draw(vk::CommandBuffer world, vk::CommandBuffer outputs, const Shot& shot, const Panel* hud)
{
    for (const Target& target : targets_)
        make_writable(outputs, target);
    frame_.draw(world, outputs, shot, hud, targets_);
}

double PassTimer::frame(const Shot& shot, const Panel* hud)
{
    return milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) { draw(commands, commands, shot, hud); });
        (void)frame_.metered();
    });
}

double PassTimer::update(const Shot& shot, const Panel* hud)
{
    return milliseconds([&] { frame_.update(shot, hud); });
}

double PassTimer::cubes(double* recording_ms)
{
    double recording = 0;
    const double whole = milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) { recording = milliseconds([&] { frame_.draw_cubes(commands); }); });
    });
    if (recording_ms)
        *recording_ms = recording;
    return whole;
}

double PassTimer::stars()
{
    return milliseconds(
        [&] { device_.now([&](vk::CommandBuffer commands) { frame_.passes().draw_stars(commands, 0, 0, 0, 1); }); });
}

template <class Record> double PassTimer::each_output(Record&& record)
{
    return milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) {
            for (std::size_t output = 0; output < targets_.size(); ++output) {
                make_writable(commands, targets_[output]);
                record(commands, output, targets_[output]);
            }
        });
    });
}

double PassTimer::warp()
{
    return each_output([&](vk::CommandBuffer commands, std::size_t output, const Target& target) {
        for (std::size_t layer = 0; layer < frame_.views().outputs[output].layers(); ++layer) {
            frame_.passes().warp_layer(commands, output, layer, target);
            frame_.passes().end_layer(commands, output, layer);
        }
    });
}

double PassTimer::finish()
{
    return each_output([&](vk::CommandBuffer commands, std::size_t output, const Target& target) {
        frame_.passes().finish_output(commands, output, target);
    });
}

double PassTimer::hud()
{
    return milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) {
            make_writable(commands, targets_[0]);
            frame_.passes().draw_hud(commands, 0, 0, targets_[0]);
        });
    });
}

double PassTimer::metering()
{
    return milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) { frame_.draw_meter(commands); });
        (void)frame_.metered();
    });
}

CommandCounts PassTimer::counts(const Shot& shot, const Panel* hud)
{
    const vk::raii::CommandBuffers parts(device_.device, {*device_.pool, vk::CommandBufferLevel::ePrimary, 2});
    const vk::raii::Fence done = device_.device.createFence({});
    name_object(device_, parts[0], "counted frame: world"), name_object(device_, parts[1], "counted frame: outputs");
    name_object(device_, done, "counted frame");
    for (const auto& part : parts)
        part.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    const CommandCounts before = command_counts();
    draw(*parts[0], *parts[1], shot, hud);
    for (const auto& part : parts)
        part.end();
    submit_frame(device_, *parts[0], *parts[1], {}, {}, *done);
    const CommandCounts counts = command_counts() - before;
    device_.await(*done, "the end of a counted frame (fence)");
    return counts;
}

std::vector<DrawInvocations> PassTimer::invocations(const Shot& shot, const Panel* hud)
{
    InvocationCounter counter(device_);
    device_.now([&](vk::CommandBuffer commands) {
        counter.begin(commands);
        draw(commands, commands, shot, hud);
    });
    return counter.end();
}

double PassTimer::busy(const Shot& shot, int frames)
{
    FrameTimer timer(device_);
    double processor = 0;
    device_.now([&](vk::CommandBuffer commands) {
        timer.begin(commands);
        for (int i = 0; i < frames; ++i)
            processor += milliseconds([&] { draw(commands, commands, shot, nullptr); });
        timer.end(commands);
    });
    return processor + timer.ms().value_or(0);
}

} // namespace starbow
