#include "shaders.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/quality.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/hud/hud.h"
#include "runtime/render/absent_card.h"
#include "runtime/render/render_context.h"
#include "runtime/render/warm_up.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

using Json = nlohmann::ordered_json;

/// A pipeline's identity on every device: its shaders, its constants and its target.
std::string variant_of(const PipelinePass& pass)
{
    std::string text = pass.name;
    for (std::size_t i = 0; i < pass.constants.count; ++i)
        if (pass.constants.list[i].value != 0)
            text += " " + std::to_string(int(pass.constants.list[i].constant)) + "="
                + std::to_string(pass.constants.list[i].value);
    text += " to";
    for (const vk::Format format : pass.target.colours)
        text += " " + vk::to_string(format);
    return text + (pass.target.samples == vk::SampleCountFlagBits::e1 ? "" : " x" + vk::to_string(pass.target.samples));
}

/// The pipelines that a world reaches, by variant_of.
void add_reached(std::map<std::string, PipelinePass>& all, const std::filesystem::path& scene)
{
    RenderContext context(scene, device_options(false));
    const Shot start = context.world.scene.start;
    for (const char* layout : {"desk", "dome", "stereo"})
        for (const char* quality : {"balanced", "fine"}) {
            WarmUp states(context.device, context.pipelines, context.world, load_layout(shipped_file("layouts", layout)),
                within(context.device, load_quality(shipped_file("qualities", quality))), start, vk::Format::eB8G8R8A8Srgb,
                true, 0.1, false);
            const Panel panel = plate({64, 32}, 4);
            while (states.step(&panel)) { }
        }
    for (const auto& [pass, pipeline] : context.pipelines.made())
        all.emplace(variant_of(pass), pass);
}

/// The compiler's figures, in the driver's words.
using Figures = std::map<std::string, double>;

/// A column of the table: the driver's word, and whether its least value is the worst.
struct Column {
    const char *title, *figure;
    bool least;
};
constexpr Column columns[]
    = {{"instructions", "Instructions", false}, {"cycles", "Inverse Throughput", false}, {"latency", "Latency", false},
        {"VGPRs", "VGPRs", false}, {"waves", "Subgroups per SIMD", true}, {"spills", "Spilled VGPRs", false}};

} // namespace

void bench_shaders(const std::string& family, const std::string& json, const std::string& against)
{
    Json old;
    if (!against.empty())
        old = Json::parse(read_whole(against, 100 << 20, "a file that bench --shaders --json wrote"), nullptr, false);
    if (!against.empty() && (!old.is_object() || !old.contains("passes")))
        throw InputError(against + ": is no table of shaders; a file that bench --shaders --json wrote is right");
    using Clock = std::chrono::steady_clock;
    const Clock::time_point began = Clock::now();
    std::map<std::string, PipelinePass> reached;
    const std::vector<std::string> scenes = shipped_names("scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const double s = std::chrono::duration<double>(Clock::now() - began).count();
        std::fprintf(stderr, "%zu of %zu worlds: %s%s\n", i + 1, scenes.size(), scenes[i].c_str(),
            i > 0 ? (", about " + std::to_string(std::lround(s / double(i) * double(scenes.size() - i))) + " s left").c_str()
                  : "");
        add_reached(reached, shipped_file("scenes", scenes[i]));
    }
    const std::unique_ptr<Device> card = open_absent_card(family);
    const Pipelines pipelines(*card);
    std::map<std::string, std::vector<Figures>> by_pass;
    Json all{{"device", card->name()}, {"family", family}};
    for (const auto& [variant, pass] : reached) {
        const vk::raii::Pipeline made = pipelines.make(pass);
        for (const auto stage : {vk::ShaderStageFlagBits::eVertex, vk::ShaderStageFlagBits::eFragment}) {
            const char* of = stage == vk::ShaderStageFlagBits::eVertex ? ", vertex" : "";
            const Figures figures = shader_statistics(*card, *made, stage);
            by_pass[std::string(pass.name) + of].push_back(figures);
            all["pipelines"][variant + of] = figures;
        }
    }
    std::printf("%s, %zu pipelines of %zu worlds: the median and the worst of each pass\n\n%-32s%9s", card->name(),
        reached.size(), scenes.size(), "", "variants");
    for (const Column& column : columns)
        std::printf("%18s", column.title);
    std::printf("\n");
    for (const auto& [name, variants] : by_pass) {
        std::printf("%-32s%9zu", name.c_str(), variants.size());
        for (const Column& column : columns) {
            std::vector<double> values;
            for (const Figures& figures : variants)
                if (const auto at = figures.find(column.figure); at != figures.end())
                    values.push_back(at->second);
            if (values.empty()) {
                std::printf("%18s", "");
                continue;
            }
            const double middle = median(values),
                         worst = column.least ? *std::ranges::min_element(values) : *std::ranges::max_element(values);
            all["passes"][name][column.title] = {middle, worst};
            std::printf("%9.0f%9.0f", middle, worst);
        }
        std::printf("\n");
    }
    if (!against.empty()) {
        std::printf("\nChanged since %s:\n", against.c_str());
        for (const auto& [name, figures] : all["passes"].items())
            for (const auto& [title, now] : figures.items())
                if (const Json before = old["passes"].value(name, Json::object()).value(title, Json()); before != now)
                    std::printf(
                        "%-32s%-14s %s, now %s\n", name.c_str(), title.c_str(), before.dump().c_str(), now.dump().c_str());
    }
    if (!json.empty())
        write_whole(json, all.dump(1) + "\n");
}

} // namespace starbow
