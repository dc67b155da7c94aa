#include "shader_costs.h"
#include "absent_card.h"
#include "config/model/quality.h"
#include "config/model/shipped.h"
#include "render_context.h"
#include "runtime/hud/hud.h"
#include "runtime/operation/progress.h"
#include "warm_up.h"
#include <algorithm>
#include <map>
#include <string_view>

namespace starbow {
namespace {

/// Passes by name and description. Their SPIR-V is part of the program.
using Reached = std::map<std::pair<std::string_view, std::string>, PipelinePass>;

void add_reached(Reached& all, const std::filesystem::path& scene)
{
    Device::Options options = device_options(false);
    options.as_gpu = true;
    RenderContext context(scene, options);
    const Panel panel = plate({64, 32}, 4);
    for (const char* layout : {"desk", "dome", "stereo"})
        for (const char* quality : {"balanced", "fine"}) {
            WarmUp states(context.device, context.pipelines, context.world, load_layout(shipped_file("layouts", layout)),
                within(context.device, load_quality(shipped_file("qualities", quality))), context.world.scene.start,
                vk::Format::eB8G8R8A8Srgb, true, 0.1, false);
            while (states.step(&panel)) { }
        }
    for (const auto& [pass, pipeline] : context.pipelines.made())
        all.emplace(std::pair(std::string_view(pass.name), describe(pass)), pass);
}

std::string stage_name(const PipelinePass& pass, vk::ShaderStageFlagBits stage)
{
    return table_name(pass) + (stage == vk::ShaderStageFlagBits::eVertex ? ", vertex" : "");
}

ShaderCost cost_of(
    const Device& card, const Reached::value_type& reached, vk::Pipeline pipeline, vk::ShaderStageFlagBits stage)
{
    ShaderCost cost{.pass = stage_name(reached.second, stage), .variant = reached.first.second};
    const std::map<std::string, double> figures = shader_statistics(card, pipeline, stage);
    for (std::size_t i = 0; i < shader_figures.size(); ++i)
        cost.figures[i] = figures.at(shader_figures[i].figure);
    return cost;
}

} // namespace

ShaderCosts shader_costs(
    const std::vector<std::filesystem::path>& scenes, const std::string& family, const std::string& only)
{
    constexpr std::array stages{vk::ShaderStageFlagBits::eFragment, vk::ShaderStageFlagBits::eVertex};
    Reached reached;
    {
        Progress progress;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            progress.show("the pipelines of " + scenes[i].stem().string(), double(i) / double(scenes.size()));
            add_reached(reached, scenes[i]);
        }
    }
    if (!only.empty())
        std::erase_if(reached, [&](const Reached::value_type& one) {
            return std::ranges::none_of(stages, [&](auto stage) { return stage_name(one.second, stage) == only; });
        });
    const std::unique_ptr<Device> card = open_absent_card(family);
    Pipelines pipelines(*card);
    ShaderCosts all{.card = card->name(), .shaders = {}};
    Progress progress;
    for (std::size_t done = 0; const auto& one : reached) {
        progress.show(std::to_string(reached.size()) + " pipelines for " + family, double(done) / double(reached.size()));
        for (const auto stage : stages)
            all.shaders.push_back(cost_of(*card, one, pipelines.find_or_make(one.second), stage));
        ++done;
    }
    std::ranges::stable_sort(all.shaders, [](const ShaderCost& a, const ShaderCost& b) {
        return a.pass != b.pass ? a.pass < b.pass : a.figures[cycles_figure] > b.figures[cycles_figure];
    });
    return all;
}

} // namespace starbow
