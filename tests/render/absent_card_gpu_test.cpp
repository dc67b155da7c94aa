// Every shader compiles on graphics cards of another maker than any machine of these tests has: Mesa's driver for AMD's
// cards compiles for a card that is not there.
#include "runtime/render/absent_card.h"
#include "runtime/render/pipelines.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace starbow::absent_card_gpu_test {
namespace {

void make_surfaces(Pipelines& pipelines)
{
    const TargetKind light{{light_format}}, spectrum{{light_format, light_format, light_format}};
    for (const Topology topology : {Topology::triangles, Topology::lines, Topology::points})
        for (const bool mapped : {false, true}) {
            SurfaceVariant plain{};
            plain.topology = topology, plain.mapped = mapped;
            SurfaceVariant lit = plain;
            lit.base_texture = lit.emissive_texture = lit.emits = lit.coloured = lit.masked = lit.cones = true;
            lit.lights = 8, lit.shadows = 1 << 16 | 1, lit.point_lamps = 0x55;
            lit.roughness_map = lit.normal_map = lit.occlusion_map = mapped;
            SurfaceVariant moving = lit;
            moving.several_rest_frames = moving.clock = moving.finite_existence = moving.blink = moving.moves
                = moving.deforms = moving.lamps_move = moving.matrices = true;
            moving.kinds = 3, moving.coefficients.reflected = 12;
            SurfaceVariant blended = plain;
            blended.blended = blended.coefficients.with_alpha = true;
            for (const SurfaceVariant& v : {plain, lit, blended})
                pipelines.surface(v, light);
            pipelines.surface(moving, spectrum);
        }
    for (const bool milky_way : {false, true})
        pipelines.sky(milky_way, light);
}

void make_views(Pipelines& pipelines)
{
    const vk::Format screen = vk::Format::eB8G8R8A8Srgb;
    std::vector<WarpVariant> views(1);
    views[0].aberration = views[0].doppler = views[0].headlight = views[0].sampled_response = true;
    const auto also = [&](const auto& change) { change(views.emplace_back(views[0])); };
    also([](WarpVariant& v) { v.map = v.stars = v.milky_way = v.range = v.mips = true; });
    also([](WarpVariant& v) { v.rays = 2, v.cut = v.linear = v.layered = true; });
    also([](WarpVariant& v) { v.channels = v.map = v.unaligned = true; });
    also([](WarpVariant& v) {
        v.several_rest_frames = v.stars = true, v.rest_frames = MAX_REST_FRAMES, v.coefficients.reflected = 12;
    });
    also([](WarpVariant& v) { v.reproject = v.turning = v.stars = true; });
    also([](WarpVariant& v) { v.globes = 9, v.each_globe = v.stars = v.map = true; });
    also([](WarpVariant& v) { v.globes = 9, v.each_globe = v.stars = v.map = v.glows = true; });
    also([](WarpVariant& v) {
        v.globes = 9, v.rays = 2, v.each_globe = v.several_rest_frames = v.reproject = v.glows = true;
    });
    also([](WarpVariant& v) { v.several_rest_frames = true, v.rays = 2, v.rest_frames = MAX_REST_FRAMES; });
    also([](WarpVariant& v) { v.reproject = true, v.rays = 2; });
    also([](WarpVariant& v) { v.galilean = true; });
    also([](WarpVariant& v) { v.single = true, v.aberration = v.doppler = v.headlight = v.by_table = false; });
    for (const WarpVariant& v : views) {
        pipelines.warp(v, screen);
        pipelines.dark(v, screen);
        pipelines.stars(v, screen);
        pipelines.measure(v);
        pipelines.probe(v);
        pipelines.meter(v);
        pipelines.star_meter(v);
        pipelines.overlay(v, OVERLAY_GRID, screen);
    }
}

void make_pictures(Pipelines& pipelines)
{
    const vk::Format screen = vk::Format::eB8G8R8A8Srgb;
    pipelines.mip(light_format);
    pipelines.lookup(screen);
    pipelines.scaled(screen);
    pipelines.fade(screen);
    for (const bool one : {false, true}) {
        pipelines.compress(one);
        pipelines.bloomed(one, screen);
        pipelines.hud(one, screen, one, one);
        pipelines.layer(one);
        pipelines.vignette(one, screen);
        pipelines.pattern(one, 1, screen);
        for (const bool first : {false, true})
            pipelines.bloom(one, first);
    }
    pipelines.finish({}, screen);
}

/// The cycles of a wave (the compiler's "Inverse Throughput") that the plainest and the richest of the variants above take
/// on navi21 in the fragment stage, the richest in the vertex stage, and the registers of both. Loops count eightfold. The
/// compiler of one version always says the same. `starbow bench --shaders --pass NAME --against OLD` shows which variants a
/// change made slower.
struct Ceiling {
    const char* pass;
    double plainest, richest, vertex, registers;
};
constexpr Ceiling ceilings[] = {
    {"bloom pipeline", 46, 186, 62, 32},
    {"bloomed pipeline", 263, 311, 62, 24},
    {"compress pipeline", 18232, 23944, 62, 56},
    {"dark pipeline", 2172, 2717, 62, 24},
    {"fade pipeline", 4, 4, 62, 24},
    {"finish pipeline", 114, 114, 62, 24},
    {"hud pipeline", 72, 131, 62, 24},
    {"layer pipeline", 25, 25, 62, 24},
    {"lookup pipeline", 48, 48, 62, 24},
    {"mapped surface pipeline", 216, 8134, 9341, 128},
    {"measure pipeline", 290, 277595, 62, 128},
    {"meter pipeline", 74, 49174, 62, 128},
    {"mip pipeline", 35, 35, 62, 24},
    {"overlay pipeline", 707, 780, 62, 24},
    {"pattern pipeline", 94, 94, 62, 24},
    {"probe pipeline", 290, 49457, 62, 128},
    {"scaled pipeline", 24, 24, 62, 24},
    {"sky pipeline", 74, 222, 79, 24},
    {"star meter pipeline", 28, 28, 88035, 48},
    {"stars pipeline", 44, 64, 88498, 48},
    {"surface pipeline", 30, 6289, 18574, 80},
    {"vignette pipeline", 130, 174, 62, 24},
    {"warp pipeline", 304, 108017, 62, 128},
};

bool made_with_mesa_22_3(const Device& card)
{
    return VK_API_VERSION_MAJOR(card.properties.driverVersion) == 22
        && VK_API_VERSION_MINOR(card.properties.driverVersion) == 3;
}

/// Reports what lies above its ceiling; returns the number of faults.
int above_ceilings(const Device& card, const Pipelines& pipelines)
{
    int faults = 0;
    std::map<std::string, Ceiling> found;
    for (const auto& [pass, pipeline] : pipelines.made())
        for (const auto stage : {vk::ShaderStageFlagBits::eFragment, vk::ShaderStageFlagBits::eVertex}) {
            const auto figures = shader_statistics(card, pipeline, stage);
            if (!figures.contains("Spilled VGPRs") || figures.at("Instructions") < 1)
                std::fprintf(stderr, "%s says nothing\n", pass.name), ++faults;
            else if (figures.at("Spilled VGPRs") > 0)
                std::fprintf(stderr, "%s spills %.0f registers\n", pass.name, figures.at("Spilled VGPRs")), ++faults;
            Ceiling& now = found.try_emplace(pass.name, Ceiling{pass.name, 1e9, 0, 0, 0}).first->second;
            const double cycles = figures.at("Inverse Throughput");
            if (stage == vk::ShaderStageFlagBits::eFragment)
                now.plainest = std::min(now.plainest, cycles), now.richest = std::max(now.richest, cycles);
            else
                now.vertex = std::max(now.vertex, cycles);
            now.registers = std::max(now.registers, figures.at("VGPRs"));
        }
    if (std::string_view(card.name()).find("NAVI21") == std::string_view::npos || !made_with_mesa_22_3(card))
        return faults;
    for (const auto& [name, now] : found) {
        const auto most = std::ranges::find(ceilings, name, [](const Ceiling& one) { return std::string(one.pass); });
        if (most == std::end(ceilings) || now.plainest > most->plainest || now.richest > most->richest
            || now.vertex > most->vertex || now.registers > most->registers) {
            std::fprintf(stderr, "above its ceiling, or without one: {\"%s\", %.0f, %.0f, %.0f, %.0f}\n", name.c_str(),
                now.plainest, now.richest, now.vertex, now.registers);
            ++faults;
        }
    }
    return faults;
}

/// Compiles shaders for a card of the family, every one or a few, and ends the process: 0 if none spills registers or costs
/// more than it may.
[[noreturn]] void compile_for(const char* family, bool every)
{
    int faults = 0;
    try {
        const std::unique_ptr<Device> card = open_absent_card(family);
        Pipelines pipelines(*card);
        if (every) {
            make_surfaces(pipelines);
            make_views(pipelines);
        }
        make_pictures(pipelines);
        faults = every ? above_ceilings(*card, pipelines) : 0;
        std::fprintf(stderr, "%zu pipelines\n", pipelines.count());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(2);
    }
    _exit(faults > 0);
}

} // namespace

// In a process of its own, as it chooses the driver of the whole process.
TEST(AbsentCardDeathTest, CompilesEveryShaderForEveryFamily)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    for (const char* family : card_families) {
        const bool every = family == card_families.front() || testing::all_cases();
        EXPECT_EXIT(compile_for(family, every), ::testing::ExitedWithCode(0), "[0-9]+ pipelines") << family;
    }
}

} // namespace starbow::absent_card_gpu_test
