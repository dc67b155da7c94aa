#include "command_counts.h"
#include "device.h"
#include <tuple>
#include <type_traits>
#include <utility>

namespace starbow {
namespace {

thread_local CommandCounts counts;
thread_local DrawObserver* observer = nullptr;
thread_local VkPipeline bound_pipeline = nullptr;

/// Stands in for a function of Vulkan: it counts a call and makes it. `member` is the function's place in a dispatcher.
template <auto member, CommandCounts::Kind kind, class Function> struct Counted;
template <auto member, CommandCounts::Kind kind, class... Arguments>
struct Counted<member, kind, void(VKAPI_PTR*)(VkCommandBuffer, Arguments...)> {
    static inline void(VKAPI_PTR* own)(VkCommandBuffer, Arguments...) = nullptr;
    static VKAPI_ATTR void VKAPI_CALL call(VkCommandBuffer commands, Arguments... arguments)
    {
        ++counts.of[kind];
        if constexpr (kind == CommandCounts::pipeline_binds)
            bound_pipeline = std::get<VkPipeline>(std::tuple(arguments...));
        const bool observed = kind == CommandCounts::draws && observer;
        if (observed)
            observer->before_draw(commands, vk::Pipeline(bound_pipeline));
        own(commands, arguments...);
        if (observed)
            observer->after_draw(commands);
    }
};

template <auto member, CommandCounts::Kind kind, class Dispatcher> void count(Dispatcher& dispatcher)
{
    auto& function = dispatcher.*member;
    using Stand = Counted<member, kind, std::remove_reference_t<decltype(function)>>;
    if (function != Stand::call)
        Stand::own = std::exchange(function, Stand::call);
}

VKAPI_ATTR VkResult VKAPI_CALL counted_submit(
    VkQueue queue, std::uint32_t submit_count, const VkSubmitInfo2* submits, VkFence fence)
{
    counts.of[CommandCounts::submits] += submit_count;
    for (std::uint32_t i = 0; i < submit_count; ++i)
        counts.of[CommandCounts::command_buffers] += submits[i].commandBufferInfoCount;
    // The loader's function finds the queue's device, as several may be counted.
    return VULKAN_HPP_DEFAULT_DISPATCHER.vkQueueSubmit2(queue, submit_count, submits, fence);
}

} // namespace

void count_commands(const Device& device)
{
    auto& recording = VULKAN_HPP_DEFAULT_DISPATCHER;
    using Recording = std::remove_reference_t<decltype(recording)>;
    count<&Recording::vkCmdBeginRendering, CommandCounts::passes>(recording);
    count<&Recording::vkCmdPipelineBarrier2, CommandCounts::barriers>(recording);
    count<&Recording::vkCmdDraw, CommandCounts::draws>(recording);
    count<&Recording::vkCmdDrawIndexed, CommandCounts::draws>(recording);
    count<&Recording::vkCmdDrawIndexedIndirect, CommandCounts::draws>(recording);
    count<&Recording::vkCmdBindPipeline, CommandCounts::pipeline_binds>(recording);
    count<&Recording::vkCmdBindDescriptorSets, CommandCounts::descriptor_binds>(recording);
    count<&Recording::vkCmdPushConstants, CommandCounts::pushes>(recording);
    count<&Recording::vkCmdSetViewport, CommandCounts::states>(recording);
    count<&Recording::vkCmdSetScissor, CommandCounts::states>(recording);
    count<&Recording::vkCmdSetCullMode, CommandCounts::states>(recording);
    count<&Recording::vkCmdSetFrontFace, CommandCounts::states>(recording);
    count<&Recording::vkCmdSetLineWidth, CommandCounts::states>(recording);
    count<&Recording::vkCmdBindVertexBuffers, CommandCounts::states>(recording);
    count<&Recording::vkCmdBindIndexBuffer, CommandCounts::states>(recording);
    // The queue calls by the table of the device's handle, which hands it out as constant.
    const auto& handed = *device.device.getDispatcher();
    auto& queue = const_cast<std::remove_cvref_t<decltype(handed)>&>(handed);
    queue.vkQueueSubmit2 = counted_submit;
}

const CommandCounts& command_counts() { return counts; }

CommandCounts operator-(const CommandCounts& later, const CommandCounts& earlier)
{
    CommandCounts between;
    for (std::size_t i = 0; i < between.of.size(); ++i)
        between.of[i] = later.of[i] - earlier.of[i];
    return between;
}

void observe_draws(DrawObserver* one) { observer = one; }

void count_upload(std::uint64_t bytes) { counts.of[CommandCounts::uploaded_bytes] += bytes; }

} // namespace starbow
