#include "invocations.h"
#include "config/json/error.h"
#include <type_traits>

namespace starbow {
namespace {

/// What the functions below count for; of the thread that records.
struct Counting {
    VkQueryPool queries = nullptr;
    std::uint32_t most = 0;
    VkPipeline bound = nullptr;
    std::vector<vk::Pipeline> draws;
};
thread_local Counting counting;

/// The functions of Vulkan before count_draws put others in their places.
PFN_vkCmdBindPipeline bind_pipeline;
PFN_vkCmdBeginQuery begin_query;
PFN_vkCmdEndQuery end_query;

VKAPI_ATTR void VKAPI_CALL note_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline)
{
    counting.bound = pipeline;
    bind_pipeline(commands, point, pipeline);
}

/// Stands in for a function that draws, and counts around it.
template <auto member, class Function> struct CountedDraw;
template <auto member, class... Arguments> struct CountedDraw<member, void(VKAPI_PTR*)(VkCommandBuffer, Arguments...)> {
    static inline void(VKAPI_PTR* own)(VkCommandBuffer, Arguments...) = nullptr;
    static VKAPI_ATTR void VKAPI_CALL call(VkCommandBuffer commands, Arguments... arguments)
    {
        const auto index = std::uint32_t(counting.draws.size());
        const bool counts = counting.queries && index < counting.most;
        if (counts)
            begin_query(commands, counting.queries, index, 0);
        own(commands, arguments...);
        if (counts)
            end_query(commands, counting.queries, index), counting.draws.emplace_back(counting.bound);
    }
};

template <auto member, class Dispatcher> void count(Dispatcher& dispatcher)
{
    auto& function = dispatcher.*member;
    using Stand = CountedDraw<member, std::remove_reference_t<decltype(function)>>;
    if (function != Stand::call)
        Stand::own = std::exchange(function, Stand::call);
}

void count_draws()
{
    auto& recording = VULKAN_HPP_DEFAULT_DISPATCHER;
    using Recording = std::remove_reference_t<decltype(recording)>;
    begin_query = recording.vkCmdBeginQuery, end_query = recording.vkCmdEndQuery;
    if (recording.vkCmdBindPipeline != note_pipeline)
        bind_pipeline = std::exchange(recording.vkCmdBindPipeline, note_pipeline);
    count<&Recording::vkCmdDraw>(recording);
    count<&Recording::vkCmdDrawIndexedIndirect>(recording);
}

} // namespace

InvocationCounter::InvocationCounter(const Device& device)
    : queries_(device.device.createQueryPool({{}, vk::QueryType::ePipelineStatistics, most_draws,
        vk::QueryPipelineStatisticFlagBits::eVertexShaderInvocations
            | vk::QueryPipelineStatisticFlagBits::eFragmentShaderInvocations}))
{
    count_draws();
}

InvocationCounter::~InvocationCounter() { counting = {}; }

void InvocationCounter::begin(vk::CommandBuffer commands)
{
    commands.resetQueryPool(*queries_, 0, most_draws);
    counting = {.queries = *queries_, .most = most_draws};
}

std::vector<DrawInvocations> InvocationCounter::end()
{
    const Counting counted = std::exchange(counting, {});
    if (counted.draws.size() == most_draws)
        throw InputError("A frame has more draws than can be counted: " + std::to_string(most_draws)
            + "; a layout with fewer viewports is right");
    std::vector<DrawInvocations> all;
    for (std::uint32_t i = 0; i < counted.draws.size(); ++i) {
        const auto [result, numbers] = queries_.getResults<std::uint64_t>(i, 1, 2 * sizeof(std::uint64_t),
            2 * sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        all.push_back({counted.draws[i], numbers[0], numbers[1]});
    }
    return all;
}

} // namespace starbow
