// Every shader compiles on graphics cards of another maker than any machine of these tests has: Mesa's driver for AMD's
// cards compiles for a card that is not there.
#include "runtime/render/absent_card.h"
#include "runtime/render/pipelines.h"
#include "tests/support/files.h"
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

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
            lit.base_texture = lit.emissive_texture = lit.masked = lit.cones = true;
            lit.lights = 8, lit.shadows = 1 << 16 | 1 << 8 | 1;
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
    views[0].aberration = views[0].doppler = views[0].headlight = true;
    const auto also = [&](const auto& change) { change(views.emplace_back(views[0])); };
    also([](WarpVariant& v) { v.map = v.stars = v.milky_way = v.range = v.mips = true; });
    also([](WarpVariant& v) { v.rays = 2, v.cut = v.linear = v.layered = true; });
    also([](WarpVariant& v) { v.channels = v.map = v.unaligned = true; });
    also([](WarpVariant& v) { v.several_rest_frames = v.stars = true, v.rest_frames = 4, v.coefficients.reflected = 12; });
    also([](WarpVariant& v) { v.reproject = v.turning = v.stars = true; });
    also([](WarpVariant& v) { v.globes = 9, v.stars = v.map = true; });
    also([](WarpVariant& v) { v.globes = 9, v.rays = 2, v.several_rest_frames = v.reproject = true; });
    also([](WarpVariant& v) { v.several_rest_frames = true, v.rays = 2, v.rest_frames = 4; });
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

/// Compiles every shader for a card of the family, and ends the process: 0 if all of them do without spilled registers.
[[noreturn]] void compile_for(const char* family)
{
    int spilled = 0;
    try {
        const std::unique_ptr<Device> card = open_absent_card(family);
        Pipelines pipelines(*card);
        make_surfaces(pipelines);
        make_views(pipelines);
        make_pictures(pipelines);
        for (const auto& [pass, pipeline] : pipelines.made())
            for (const auto stage : {vk::ShaderStageFlagBits::eVertex, vk::ShaderStageFlagBits::eFragment})
                if (const auto figures = shader_statistics(*card, pipeline, stage);
                    !figures.contains("Spilled VGPRs") || figures.at("Spilled VGPRs") > 0 || figures.at("Instructions") < 1)
                    std::fprintf(stderr, "%s spills, or says nothing\n", pass.name), ++spilled;
        std::fprintf(stderr, "%zu pipelines\n", pipelines.count());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(2);
    }
    _exit(spilled > 0);
}

} // namespace

// In a process of its own, as it chooses the driver of the whole process.
TEST(AbsentCardDeathTest, CompilesEveryShader)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    for (const char* family : card_families) {
        EXPECT_EXIT(compile_for(family), ::testing::ExitedWithCode(0), "^[0-9]* pipelines") << family;
        if (!testing::all_cases())
            break; // of the other families with every case
    }
}

} // namespace starbow::absent_card_gpu_test
