#include "frame_timer.h"
#include "debug.h"
#include <algorithm>

namespace starbow {

FrameTimer::FrameTimer(const Device& device)
{
    const std::uint32_t bits = device.physical.getQueueFamilyProperties()[device.family].timestampValidBits;
    if (bits == 0)
        return;
    mask_ = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    ms_per_tick_ = 1e-6 * device.properties.limits.timestampPeriod;
    stamps_ = device.device.createQueryPool({{}, vk::QueryType::eTimestamp, 2 + 2 * most_spans});
    name_object(device, stamps_, "frame timer");
}

void FrameTimer::begin(vk::CommandBuffer commands)
{
    names_.clear(), open_.clear();
    if (!*stamps_)
        return;
    commands.resetQueryPool(*stamps_, 0, 2 + 2 * most_spans);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *stamps_, 0);
}

void FrameTimer::end(vk::CommandBuffer commands)
{
    if (!*stamps_)
        return;
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, 1);
    measured_ = true;
}

void FrameTimer::begin_span(vk::CommandBuffer commands, const char* name)
{
    open_.push_back(std::uint32_t(names_.size()));
    names_.push_back(name);
    if (*stamps_ && open_.back() < most_spans)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, 2 + 2 * open_.back());
}

void FrameTimer::end_span(vk::CommandBuffer commands)
{
    if (*stamps_ && open_.back() < most_spans)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, 3 + 2 * open_.back());
    open_.pop_back();
}

std::optional<double> FrameTimer::ms() const
{
    if (!measured_)
        return {};
    const auto [result, ticks] = stamps_.getResults<std::uint64_t>(0, 2, 16, 8, vk::QueryResultFlagBits::e64);
    if (result != vk::Result::eSuccess)
        return {};
    return ms_per_tick_ * double((ticks[1] - ticks[0]) & mask_);
}

std::span<const PassTime> FrameTimer::passes()
{
    passes_.clear();
    if (!measured_)
        return {};
    const std::uint32_t spans = std::min(std::uint32_t(names_.size()), most_spans);
    const std::uint32_t count = 2 + 2 * spans;
    const auto [result, ticks] = stamps_.getResults<std::uint64_t>(0, count, 8 * count, 8, vk::QueryResultFlagBits::e64);
    if (result != vk::Result::eSuccess)
        return {};
    for (std::uint32_t i = 0; i < spans; ++i)
        passes_.push_back({names_[i], ms_per_tick_ * double((ticks[2 + 2 * i] - ticks[0]) & mask_),
            ms_per_tick_ * double((ticks[3 + 2 * i] - ticks[2 + 2 * i]) & mask_)});
    return passes_;
}

} // namespace starbow
