#include "invocations.h"
#include "config/json/error.h"

namespace starbow {

InvocationCounter::InvocationCounter(const Device& device)
    : queries_(device.device.createQueryPool({{}, vk::QueryType::ePipelineStatistics, most_draws,
        vk::QueryPipelineStatisticFlagBits::eVertexShaderInvocations
            | vk::QueryPipelineStatisticFlagBits::eFragmentShaderInvocations}))
{
    count_commands(device);
}

InvocationCounter::~InvocationCounter() { observe_draws(nullptr); }

void InvocationCounter::begin(vk::CommandBuffer commands)
{
    commands.resetQueryPool(*queries_, 0, most_draws);
    observe_draws(this);
}

void InvocationCounter::before_draw(vk::CommandBuffer commands, vk::Pipeline bound)
{
    if (draws_.size() < most_draws)
        commands.beginQuery(*queries_, std::uint32_t(draws_.size()), {});
    draws_.push_back({bound});
}

void InvocationCounter::after_draw(vk::CommandBuffer commands)
{
    if (draws_.size() <= most_draws)
        commands.endQuery(*queries_, std::uint32_t(draws_.size() - 1));
}

std::vector<DrawInvocations> InvocationCounter::end()
{
    observe_draws(nullptr);
    if (draws_.size() > most_draws)
        throw InputError("A frame has more draws than can be counted: " + std::to_string(most_draws)
            + "; a layout with fewer viewports is right");
    for (std::uint32_t i = 0; i < draws_.size(); ++i) {
        const auto [result, numbers] = queries_.getResults<std::uint64_t>(i, 1, 2 * sizeof(std::uint64_t),
            2 * sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        draws_[i].vertex = numbers[0], draws_[i].fragment = numbers[1];
    }
    return std::move(draws_);
}

} // namespace starbow
