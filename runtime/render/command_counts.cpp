#include "command_counts.h"
#include "device.h"
#include <type_traits>

namespace starbow {
namespace {

thread_local CommandCounts counts;

/// Stands in for a function of Vulkan: it counts a call and makes it. `member` is the function's place in a dispatcher.
template <auto member, class Function> struct Counted;
template <auto member, class Result, class... Arguments> struct Counted<member, Result(VKAPI_PTR*)(Arguments...)> {
    static inline Result(VKAPI_PTR* own)(Arguments...) = nullptr;
    static inline CommandCounts::Kind kind;
    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments)
    {
        ++counts.of[kind];
        return own(arguments...);
    }
};

template <auto member, class Dispatcher> void count(Dispatcher& dispatcher, CommandCounts::Kind kind)
{
    auto& function = dispatcher.*member;
    using Stand = Counted<member, std::remove_reference_t<decltype(function)>>;
    if (function == Stand::call)
        return;
    Stand::own = function, Stand::kind = kind;
    function = Stand::call;
}

PFN_vkQueueSubmit2 submit;

VKAPI_ATTR VkResult VKAPI_CALL counted_submit(
    VkQueue queue, std::uint32_t submit_count, const VkSubmitInfo2* submits, VkFence fence)
{
    counts.of[CommandCounts::submits] += submit_count;
    for (std::uint32_t i = 0; i < submit_count; ++i)
        counts.of[CommandCounts::command_buffers] += submits[i].commandBufferInfoCount;
    return submit(queue, submit_count, submits, fence);
}

} // namespace

void count_commands(const Device& device)
{
    auto& recording = VULKAN_HPP_DEFAULT_DISPATCHER;
    using Recording = std::remove_reference_t<decltype(recording)>;
    count<&Recording::vkCmdBeginRendering>(recording, CommandCounts::passes);
    count<&Recording::vkCmdPipelineBarrier2>(recording, CommandCounts::barriers);
    count<&Recording::vkCmdDraw>(recording, CommandCounts::draws);
    count<&Recording::vkCmdDrawIndexed>(recording, CommandCounts::draws);
    count<&Recording::vkCmdDrawIndexedIndirect>(recording, CommandCounts::draws);
    count<&Recording::vkCmdBindPipeline>(recording, CommandCounts::pipeline_binds);
    count<&Recording::vkCmdBindDescriptorSets>(recording, CommandCounts::descriptor_binds);
    count<&Recording::vkCmdPushConstants>(recording, CommandCounts::pushes);
    count<&Recording::vkCmdSetViewport>(recording, CommandCounts::states);
    count<&Recording::vkCmdSetScissor>(recording, CommandCounts::states);
    count<&Recording::vkCmdSetCullMode>(recording, CommandCounts::states);
    count<&Recording::vkCmdSetFrontFace>(recording, CommandCounts::states);
    count<&Recording::vkCmdSetLineWidth>(recording, CommandCounts::states);
    count<&Recording::vkCmdBindVertexBuffers>(recording, CommandCounts::states);
    count<&Recording::vkCmdBindIndexBuffer>(recording, CommandCounts::states);
    // The queue calls by the table of the device's handle, which hands it out as constant.
    const auto& handed = *device.device.getDispatcher();
    auto& queue = const_cast<std::remove_cvref_t<decltype(handed)>&>(handed);
    if (queue.vkQueueSubmit2 != counted_submit)
        submit = std::exchange(queue.vkQueueSubmit2, counted_submit);
}

const CommandCounts& command_counts() { return counts; }

CommandCounts operator-(const CommandCounts& later, const CommandCounts& earlier)
{
    CommandCounts between;
    for (std::size_t i = 0; i < between.of.size(); ++i)
        between.of[i] = later.of[i] - earlier.of[i];
    return between;
}

void count_upload(std::uint64_t bytes) { counts.of[CommandCounts::uploaded_bytes] += bytes; }

} // namespace starbow
