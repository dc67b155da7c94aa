#include "scene_keeper.h"

namespace starbow {

SceneKeeper::SceneKeeper(const vk::raii::Device& device)
    : queries_(device.createQueryPool({{}, vk::QueryType::eTimestamp, 2 * half}))
{
}

void SceneKeeper::begin(vk::CommandBuffer commands)
{
    if (held_ < half / 2)
        return;
    held_ = 0;
    first_ = half - first_;
    commands.resetQueryPool(*queries_, first_, half);
}

void SceneKeeper::hold(vk::CommandBuffer commands)
{
    if (held_ < half)
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *queries_, first_ + held_++);
}

} // namespace starbow
