#pragma once
#include "runtime/render/offscreen.h"
#include <algorithm>
#include <chrono>
#include <vector>

namespace starbow {

/// Milliseconds that `work` takes. This file serves all benches of frames.

template <class Work> double milliseconds(Work&& work)
{
    const auto began = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

inline double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Makes a target ready for drawing, whatever it held.
inline void make_writable(vk::CommandBuffer commands, const Target& target)
{
    constexpr auto output = vk::PipelineStageFlagBits2::eColorAttachmentOutput;
    using Access = vk::AccessFlagBits2;
    vk::ImageMemoryBarrier2 barrier(output, Access::eColorAttachmentWrite, output,
        Access::eColorAttachmentWrite | Access::eColorAttachmentRead, vk::ImageLayout::eUndefined,
        vk::ImageLayout::eColorAttachmentOptimal, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, target.image,
        {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

/// Milliseconds of a whole off-screen frame: planned, drawn and finished.
inline double frame_ms(Device& device, OffscreenRenderer& renderer, const Shot& shot)
{
    return milliseconds([&] {
        std::vector<Target> targets;
        for (std::size_t i = 0; i < renderer.layout().outputs.size(); ++i)
            targets.push_back(renderer.target(i));
        device.now([&](vk::CommandBuffer c) {
            for (const Target& target : targets)
                make_writable(c, target);
            renderer.frame().draw(c, shot, nullptr, targets);
        });
    });
}

} // namespace starbow
