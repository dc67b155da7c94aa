#include "pass_timer.h"
#include "debug.h"
#include "runtime/operation/trace.h"

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

std::int64_t PassTimer::exhibit_frame(const Shot& shot, const Panel* hud, FrameTimer* timer)
{
    const vk::raii::CommandBuffers parts(device_.device, {*device_.pool, vk::CommandBufferLevel::ePrimary, 2});
    const vk::raii::Fence done = device_.device.createFence({});
    name_object(device_, parts[0], "timed frame: world"), name_object(device_, parts[1], "timed frame: outputs");
    name_object(device_, done, "timed frame");
    for (const auto& part : parts)
        part.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    if (timer)
        timer->begin(*parts[0]), timer->resume(*parts[1]);
    device_.timer = timer;
    draw(*parts[0], *parts[1], shot, hud);
    device_.timer = nullptr;
    if (timer)
        timer->pause(*parts[0]), timer->end(*parts[1]);
    for (const auto& part : parts)
        part.end();
    const std::int64_t submitted = Trace::now_ns();
    submit_frame(device_, *parts[0], *parts[1], {}, {}, *done);
    device_.await(*done, "the end of a timed frame (fence)");
    return submitted;
}

TimedFrame PassTimer::timed(const Shot& shot, const Panel* hud)
{
    FrameTimer timer(device_);
    TimedFrame frame{.begin_ns = Trace::now_ns()};
    frame.submit_ns = exhibit_frame(shot, hud, &timer);
    frame.end_ns = Trace::now_ns();
    frame.device_ms = timer.ms().value_or(0);
    const std::span<const PassTime> passes = timer.passes();
    frame.passes.assign(passes.begin(), passes.end());
    return frame;
}

CommandCounts PassTimer::counts(const Shot& shot, const Panel* hud)
{
    const CommandCounts before = command_counts();
    exhibit_frame(shot, hud, nullptr);
    return command_counts() - before;
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
