#include "frame_timer.h"
#include "debug.h"
#include "runtime/operation/trace.h"
#include <algorithm>
#include <array>

namespace starbow {

FrameTimer::FrameTimer(const Device& device)
{
    const std::uint32_t bits = device.physical.getQueueFamilyProperties()[device.family].timestampValidBits;
    if (bits == 0)
        return;
    mask_ = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    ms_per_tick_ = 1e-6 * device.properties.limits.timestampPeriod;
    stamps_ = device.device.createQueryPool({{}, vk::QueryType::eTimestamp, first_span + 2 * most_spans});
    name_object(device, stamps_, "frame timer");
}

void FrameTimer::begin(vk::CommandBuffer commands)
{
    names_.clear(), open_.clear();
    in_parts_ = false;
    if (!*stamps_)
        return;
    commands.resetQueryPool(*stamps_, 0, first_span + 2 * most_spans);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *stamps_, begun);
}

void FrameTimer::end(vk::CommandBuffer commands)
{
    if (!*stamps_)
        return;
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, ended);
    measured_ = true;
}

void FrameTimer::pause(vk::CommandBuffer commands)
{
    if (*stamps_)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, paused);
}

void FrameTimer::resume(vk::CommandBuffer commands)
{
    in_parts_ = true;
    if (*stamps_) // a stage that waits; the top of the pipe would be reached before the screens are ready
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps_, resumed);
}

void FrameTimer::begin_span(vk::CommandBuffer commands, const char* name)
{
    open_.push_back(std::uint32_t(names_.size()));
    names_.push_back(name);
    if (*stamps_ && open_.back() < most_spans)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, first_span + 2 * open_.back());
}

void FrameTimer::end_span(vk::CommandBuffer commands)
{
    if (*stamps_ && open_.back() < most_spans)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, first_span + 2 * open_.back() + 1);
    open_.pop_back();
}

std::optional<double> FrameTimer::ms() const
{
    if (!measured_)
        return {};
    const auto read
        = [&](std::uint32_t stamp) { return stamps_.getResult<std::uint64_t>(stamp, 1, 8, vk::QueryResultFlagBits::e64); };
    const auto between = [&](std::uint32_t from, std::uint32_t to) -> std::optional<double> {
        const auto [first, before] = read(from);
        const auto [last, after] = read(to);
        if (first != vk::Result::eSuccess || last != vk::Result::eSuccess)
            return {};
        return ms_per_tick_ * double((after - before) & mask_);
    };
    if (!in_parts_)
        return between(begun, ended);
    const auto first = between(begun, paused), second = between(resumed, ended);
    return first && second ? std::optional(*first + *second) : std::nullopt;
}

std::span<const PassTime> FrameTimer::passes()
{
    passes_.clear();
    if (!measured_)
        return {};
    const std::uint32_t spans = std::min(std::uint32_t(names_.size()), most_spans);
    if (spans == 0)
        return {};
    const auto [zero_result, zero] = stamps_.getResult<std::uint64_t>(begun, 1, 8, vk::QueryResultFlagBits::e64);
    const auto [result, ticks]
        = stamps_.getResults<std::uint64_t>(first_span, 2 * spans, 16 * spans, 8, vk::QueryResultFlagBits::e64);
    if (zero_result != vk::Result::eSuccess || result != vk::Result::eSuccess)
        return {};
    for (std::uint32_t i = 0; i < spans; ++i)
        passes_.push_back({names_[i], ms_per_tick_ * double((ticks[2 * i] - zero) & mask_),
            ms_per_tick_ * double((ticks[2 * i + 1] - ticks[2 * i]) & mask_)});
    return passes_;
}

void add_passes(Trace& trace, std::span<const PassTime> passes, std::int64_t submitted_ns)
{
    for (const PassTime& pass : passes)
        trace.gpu(pass.name, submitted_ns + std::int64_t(1e6 * pass.begin_ms), std::int64_t(1e6 * pass.duration_ms));
}

void submit_frame(const Device& device, vk::CommandBuffer world, vk::CommandBuffer outputs,
    std::span<const vk::SemaphoreSubmitInfo> wait, std::span<const vk::SemaphoreSubmitInfo> signal, vk::Fence done)
{
    const vk::CommandBufferSubmitInfo first(world), second(outputs);
    std::array<vk::SubmitInfo2, 2> parts;
    parts[0].setCommandBufferInfos(first);
    parts[1].setCommandBufferInfos(second);
    parts[1].waitSemaphoreInfoCount = std::uint32_t(wait.size()), parts[1].pWaitSemaphoreInfos = wait.data();
    parts[1].signalSemaphoreInfoCount = std::uint32_t(signal.size()), parts[1].pSignalSemaphoreInfos = signal.data();
    device.queue.submit2(parts, done);
}

} // namespace starbow
