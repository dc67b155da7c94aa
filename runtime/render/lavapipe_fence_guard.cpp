#include "lavapipe_fence_guard.h"
#include <algorithm>

namespace starbow {

LavapipeFenceGuard::LavapipeFenceGuard(const vk::raii::Device& device)
    : queries_(device.createQueryPool({{}, vk::QueryType::eTimestamp, most}))
{
}

void LavapipeFenceGuard::begin(vk::CommandBuffer commands, std::uint32_t scenes)
{
    const std::uint32_t count = std::min(scenes, most / 4);
    next_ = end_ + count > most ? 0 : end_;
    end_ = next_ + count;
    commands.resetQueryPool(*queries_, next_, count);
}

void LavapipeFenceGuard::hold(vk::CommandBuffer commands)
{
    if (next_ < end_)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *queries_, next_++);
}

} // namespace starbow
