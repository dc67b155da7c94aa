#include "frame_timer.h"

namespace starbow {

FrameTimer::FrameTimer(const Device& device)
{
    const std::uint32_t bits = device.physical.getQueueFamilyProperties()[device.family].timestampValidBits;
    if (bits == 0)
        return;
    mask_ = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    ms_per_tick_ = 1e-6 * device.properties.limits.timestampPeriod;
    stamps_ = device.device.createQueryPool({{}, vk::QueryType::eTimestamp, 2});
}

void FrameTimer::begin(vk::CommandBuffer commands)
{
    if (!*stamps_)
        return;
    commands.resetQueryPool(*stamps_, 0, 2);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *stamps_, 0);
}

void FrameTimer::end(vk::CommandBuffer commands)
{
    if (!*stamps_)
        return;
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *stamps_, 1);
    told_ = true;
}

std::optional<double> FrameTimer::ms() const
{
    if (!told_)
        return {};
    const auto [result, ticks] = stamps_.getResults<std::uint64_t>(0, 2, 16, 8, vk::QueryResultFlagBits::e64);
    if (result != vk::Result::eSuccess)
        return {};
    return ms_per_tick_ * double((ticks[1] - ticks[0]) & mask_);
}

} // namespace starbow
