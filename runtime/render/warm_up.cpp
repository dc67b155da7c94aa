#include "warm_up.h"

namespace starbow {
namespace {

/// One state of the switches.
struct State {
    double speed_u;
    Effects effects;
    Overlay overlay = Overlay::off;
    Pattern pattern = Pattern::none;
};

std::vector<State> states()
{
    std::vector<State> all;
    // Proper velocities at which plans differ in kind: one image, several, tiles with several images.
    for (double u : {0.0, 0.5, 4.0})
        for (int switches = 0; switches < 16; ++switches)
            for (Comparison comparison : {Comparison::none, Comparison::galilean, Comparison::no_light_delay}) {
                Effects effects;
                effects.aberration = !(switches & 1), effects.doppler = !(switches & 2);
                effects.headlight = !(switches & 4), effects.false_colours = switches & 8;
                effects.comparison = comparison;
                all.push_back({u, effects});
            }
    for (double u : {0.0, 4.0})
        for (Overlay overlay : {Overlay::aim, Overlay::grid, Overlay::ring, Overlay::distance, Overlay::emission})
            all.push_back({u, {}, overlay});
    for (std::size_t pattern = 1; pattern < pattern_names.size(); ++pattern)
        all.push_back({0, {}, Overlay::off, Pattern(pattern)});
    return all;
}

} // namespace

std::size_t warm_up(Device& device, Pipelines& pipelines, FrameRenderer& frame, const Shot& shot, const Panel* hud,
    vk::Format format, std::span<const Quality> qualities, const std::function<void(std::size_t, std::size_t)>& progress)
{
    std::vector<Image> images;
    std::vector<Target> targets;
    for (const OutputState& output : frame.views().outputs) {
        images.push_back(make_image(device,
            {format, {std::uint32_t(output.size.x), std::uint32_t(output.size.y)}, vk::ImageUsageFlagBits::eColorAttachment}));
        targets.push_back({*images.back().image, *images.back().view, images.back().extent, format});
    }
    const std::vector<State> all = states();
    vk::raii::CommandBuffer commands
        = std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    const vk::raii::Fence done = device.device.createFence({});
    std::size_t step = 0;
    for (const Quality& quality : qualities) {
        frame.adopt(quality);
        for (const State& state : all) {
            progress(step++, qualities.size() * all.size());
            Shot at = shot;
            at.effects = state.effects;
            at.u = at.ship_from_cockpit * glm::dvec3(0, 0, -state.speed_u);
            frame.show(state.pattern);
            if (state.overlay != Overlay::off)
                frame.measure(Measuring{.probes = {{0, 0, -1}}, .over = {.overlay = state.overlay}});
            const std::size_t before = pipelines.count();
            commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
            for (const Image& image : images)
                transition(*commands, image, vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                    {}, vk::ImageLayout::eColorAttachmentOptimal, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                    vk::AccessFlagBits2::eColorAttachmentWrite);
            frame.draw(*commands, at, hud, targets);
            commands.end();
            frame.measure({});
            if (pipelines.count() == before)
                continue;
            device.queue.submit2(vk::SubmitInfo2({}, {}, vk::ArrayProxyNoTemporaries<const vk::CommandBufferSubmitInfo>(
                vk::CommandBufferSubmitInfo(*commands)), {}), *done);
            (void)device.device.waitForFences(*done, true, UINT64_MAX);
            device.device.resetFences(*done);
        }
    }
    frame.show(Pattern::none);
    return pipelines.count();
}

} // namespace starbow
