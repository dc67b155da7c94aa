#include "frame_estimate.h"
#include "absent_card.h"
#include "config/model/quality.h"
#include "config/model/shipped.h"
#include "invocations.h"
#include "pass_timer.h"
#include "render_context.h"
#include "runtime/hud/hud.h"
#include "shader_costs.h"
#include <algorithm>
#include <vulkan/vulkan_format_traits.hpp>

namespace starbow {
namespace {

static_assert(std::ranges::equal(
    card_families, named_cards, {}, [](const char* family) { return std::string_view(family); },
    [](const NamedCard& card) { return std::string_view(card.family); }));

/// A pipeline of a frame, and how often its shaders run.
struct DrawnPass {
    PipelinePass pass;
    double vertices = 0, fragments = 0;
};

std::vector<DrawnPass> drawn_passes(const std::filesystem::path& scene, const Layout& layout, const Shot& shot)
{
    Device::Options options = device_options(false);
    options.as_gpu = options.invocations = true;
    RenderContext context(scene, options);
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, layout,
        within(context.device, load_quality(shipped_file("qualities", "fine"))), false);
    renderer.frame().meter(true); // as the exhibit flies
    const Panel panel = plate({renderer.frame().views().hud_width(), renderer.frame().views().hud_width() / 8}, 4);
    std::vector<DrawnPass> drawn;
    const std::vector<DrawInvocations> draws = PassTimer(context.device, renderer).invocations(shot, &panel);
    for (const auto& [pass, pipeline] : context.pipelines.made()) {
        DrawnPass one{pass};
        for (const DrawInvocations& draw : draws)
            if (draw.pipeline == pipeline)
                one.vertices += double(draw.vertex), one.fragments += double(draw.fragment);
        if (one.vertices > 0)
            drawn.push_back(one);
    }
    return drawn;
}

/// Bytes that a fragment writes.
double bytes_of(const PipelinePass& pass)
{
    double bytes = pass.depth ? vk::blockSize(vk::Format::eD32Sfloat) : 0;
    for (const vk::Format format : pass.target.colours)
        bytes += vk::blockSize(format);
    return bytes;
}

} // namespace

std::vector<PassEstimate> frame_estimate(
    const std::filesystem::path& scene, const Layout& layout, const Shot& shot, const NamedCard& named)
{
    const std::vector<DrawnPass> drawn = drawn_passes(scene, layout, shot);
    const std::unique_ptr<Device> card = open_absent_card(named.family);
    Pipelines pipelines(*card);
    std::vector<PassEstimate> passes;
    for (const DrawnPass& one : drawn) {
        const std::string name = table_name(one.pass);
        auto pass = std::ranges::find(passes, name, &PassEstimate::pass);
        if (pass == passes.end())
            pass = passes.insert(passes.end(), {.pass = name});
        const vk::Pipeline pipeline = pipelines.find_or_make(one.pass);
        const auto ms_of = [&](double invocations, vk::ShaderStageFlagBits stage) {
            constexpr double wave = 64, hertz_and_ms = 1e6; // of 1 GHz
            return invocations / wave * shader_statistics(*card, pipeline, stage).at(shader_figures[cycles_figure].figure)
                / (named.simds * named.clock_ghz * hertz_and_ms);
        };
        pass->vertices += one.vertices, pass->fragments += one.fragments;
        pass->arithmetic_ms += ms_of(one.vertices, vk::ShaderStageFlagBits::eVertex)
            + ms_of(one.fragments, vk::ShaderStageFlagBits::eFragment);
        pass->memory_ms += one.fragments * bytes_of(one.pass) / (named.gigabytes_per_s * 1e6);
    }
    std::ranges::sort(passes, std::greater(), &PassEstimate::ms);
    return passes;
}

} // namespace starbow
