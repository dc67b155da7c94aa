#include "warm_up.h"
#include "debug.h"

namespace starbow {
namespace {

/// One state of the switches.
struct State {
    glm::dvec3 u; ///< proper velocity, cockpit's axes
    Effects effects;
    Overlay overlay = Overlay::off;
    Pattern pattern = Pattern::none;
};

/// combined: also the comparisons and false colours together with every effect switched off.
std::vector<State> states(bool combined)
{
    std::vector<State> all;
    // Plans differ in kind with the speed: one image, several, tiles with several images. In slow flight aside the cube map
    // has other axes than the motion's.
    for (const glm::dvec3& u : {glm::dvec3(0), glm::dvec3(0, 0, -0.1), glm::dvec3(0.06, 0, -0.08), glm::dvec3(0, 0, -4),
             glm::dvec3(0, 0, -100), glm::dvec3(0, 0, -1e5)}) {
        for (int off = 0; off < 8; ++off) // the three effects, alone and together
            all.push_back({u, {.aberration = !(off & 1), .doppler = !(off & 2), .headlight = !(off & 4)}});
        for (Comparison comparison : {Comparison::galilean, Comparison::no_light_delay})
            all.push_back({u, {.comparison = comparison}});
        all.push_back({u, {.false_colours = true}});
        for (int off = 0; combined && off < 8; ++off)
            for (Comparison comparison : {Comparison::none, Comparison::galilean, Comparison::no_light_delay})
                for (bool false_colours : {false, true})
                    all.push_back({u, {!(off & 1), !(off & 2), !(off & 4), comparison, false_colours}});
        for (Overlay overlay : {Overlay::aim, Overlay::grid, Overlay::ring, Overlay::distance, Overlay::emission})
            all.push_back({u, {}, overlay});
    }
    for (std::size_t pattern = 1; pattern < pattern_names.size(); ++pattern)
        all.push_back({glm::dvec3(0), {}, Overlay::off, Pattern(pattern)});
    return all;
}

} // namespace

std::size_t warm_up(Device& device, Pipelines& pipelines, FrameRenderer& frame, const Shot& shot, const Panel* hud,
    vk::Format format, const std::function<void(std::size_t, std::size_t)>& progress)
{
    std::vector<Image> images;
    std::vector<Target> targets;
    for (const OutputState& output : frame.views().outputs) {
        images.push_back(make_image(device,
            {format, {std::uint32_t(output.size.x), std::uint32_t(output.size.y)},
                vk::ImageUsageFlagBits::eColorAttachment}));
        targets.push_back({*images.back().image, *images.back().view, images.back().extent, format});
    }
    const std::vector<State> all = states(!device.on_processor());
    vk::raii::CommandBuffer commands
        = std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    const vk::raii::Fence done = device.device.createFence({});
    name_object(device, commands, "warm-up");
    name_object(device, done, "warm-up done");
    std::size_t step = 0;
    for (const State& state : all) {
        progress(step++, all.size());
        Shot at = shot;
        at.effects = state.effects;
        at.u = at.ship_from_cockpit * state.u;
        frame.show(state.pattern);
        if (state.overlay != Overlay::off)
            frame.measure(Measuring{.probes = {{glm::dvec3(0, 0, -1)}},
                .over = {.overlay = state.overlay},
                .panel = hud,
                .scale = {0.1, 0.1, 0.9, 0.2}});
        const std::size_t before = pipelines.count();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        for (const Image& image : images)
            transition(*commands, image, vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits2::eColorAttachmentOutput, {},
                vk::ImageLayout::eColorAttachmentOptimal, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                vk::AccessFlagBits2::eColorAttachmentWrite);
        frame.draw(*commands, at, hud, targets);
        commands.end();
        if (pipelines.count() > before) {
            const vk::CommandBufferSubmitInfo buffer(*commands);
            device.queue.submit2(vk::SubmitInfo2({}, {}, buffer, {}), *done);
            device.await(*done, "the end of a warm-up's drawing (fence)");
            device.device.resetFences(*done);
        }
        frame.measure({});
    }
    return pipelines.count();
}

} // namespace starbow
