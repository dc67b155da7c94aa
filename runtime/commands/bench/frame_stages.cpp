#include "frame_stages.h"
#include "avenue.h"
#include "bodies.h"
#include "config/model/shipped.h"
#include "cubes.h"
#include "flight.h"
#include "runtime/commands/median.h"
#include "runtime/hud/hud.h"
#include "runtime/render/baselines.h"
#include "runtime/render/pass_timer.h"
#include "spectra.h"
#include "worlds.h"
#include <cstdio>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

/// The timed stages of a frame: indices of frame_stage_names.
struct FrameStage {
    enum Index {
        plan_and_cull,
        cubes,
        warp,
        hud,
        whole_frame,
        plain_frame,
        look_up,
        metering,
        geometry,
        colour,
        stars,
        count
    };
};
const char* const frame_stage_names[FrameStage::count] = {"plan and cull", "cube pass", "warp pass", "head-up display",
    "whole frame", "plain frame", "look-up pass", "metering", "warp, geometry alone", "warp, with colour", "stars"};

struct StageTimes {
    std::string name;
    std::array<double, FrameStage::count> ms{}; ///< medians
    double texels_per_pixel = 0;
    std::size_t images = 0, triangles = 0;
    double megabytes = 0;
};

/// A ratio of two stages: robust against a machine whose speed drifts.
struct StageRatio {
    const char *label, *key;
    FrameStage::Index over, under;
    int digits;
    double of(const StageTimes& times) const { return times.ms[over] / times.ms[under]; }
};
constexpr StageRatio ratios[] = {
    {"frame / plain", "frame_over_plain", FrameStage::whole_frame, FrameStage::plain_frame, 2},
    {"warp / look-up", "warp_over_lookup", FrameStage::warp, FrameStage::look_up, 2},
    {"  geometry alone", "geometry_over_lookup", FrameStage::geometry, FrameStage::look_up, 2},
    {"  with colour", "colour_over_lookup", FrameStage::colour, FrameStage::look_up, 2},
    {"metering / frame", "metering_over_frame", FrameStage::metering, FrameStage::whole_frame, 3},
};

StageTimes time_stages(
    Avenue& avenue, BareLookupBaseline& lookup, const Layout& layout, const Shot& shot, const std::string& name, int rounds)
{
    RenderContext& context = avenue.context;
    const Quality quality = default_quality(context.device, false);
    const auto renderer_of = [&](const GpuWorld& world) {
        return OffscreenRenderer(context.device, context.pipelines, world, layout, quality, false);
    };
    OffscreenRenderer renderer = renderer_of(context.world);
    const Panel panel = Typesetter().draw(
        readings(ship_at(shot), context.world.scene, shot.effects), words_in("en"), renderer.frame().views().hud_width());
    renderer.frame().meter(true); // as the exhibit flies
    renderer.picture(shot, &panel); // warms every cache
    // Without Doppler and headlight effect a pixel's light needs geometry alone: colour and strength are those at rest.
    Shot grey = shot;
    grey.effects = grey.effects.without(Effect::doppler).without(Effect::headlight);
    OffscreenRenderer geometry_renderer = renderer_of(avenue.starless), colour_renderer = renderer_of(avenue.starless);
    geometry_renderer.picture(grey);
    colour_renderer.picture(shot);
    PlainPictureBaseline plain(context.device, context.pipelines, context.world, quality, renderer);
    PassTimer timer(context.device, renderer), geometry_timer(context.device, geometry_renderer),
        colour_timer(context.device, colour_renderer);

    // All stages in turn within each round, so that the machine's other work falls on all alike.
    std::array<std::vector<double>, FrameStage::count> times;
    for (int round = -2; round < rounds; ++round) {
        std::array<double, FrameStage::count> ms{};
        ms[FrameStage::plan_and_cull] = timer.update(shot, &panel);
        ms[FrameStage::cubes] = timer.cubes();
        ms[FrameStage::warp] = timer.warp();
        ms[FrameStage::geometry] = geometry_timer.warp();
        ms[FrameStage::colour] = colour_timer.warp();
        ms[FrameStage::stars] = timer.stars();
        ms[FrameStage::look_up] = lookup.ms(renderer);
        ms[FrameStage::metering] = timer.metering();
        ms[FrameStage::hud] = timer.hud();
        ms[FrameStage::whole_frame] = timer.frame(shot, &panel);
        ms[FrameStage::plain_frame] = plain.ms(shot);
        for (std::size_t i = 0; round >= 0 && i < FrameStage::count; ++i)
            times[i].push_back(ms[i]);
    }
    StageTimes result{.name = name};
    result.triangles = renderer.frame().triangles();
    result.megabytes = double(renderer.frame().memory()) / (1 << 20);
    for (std::size_t i = 0; i < FrameStage::count; ++i)
        result.ms[i] = median(times[i]);
    for (const CubeMapPlan& plan : renderer.frame().plans()) {
        result.texels_per_pixel += plan.texels / plan.pixels;
        result.images += plan.images.size();
    }
    return result;
}

void print(const std::vector<StageTimes>& results, double megapixels)
{
    std::printf("%-22s", "");
    for (const StageTimes& r : results)
        std::printf("%12s", r.name.c_str());
    const auto row = [&](const char* name, int digits, auto value) {
        std::printf("\n%-22s", name);
        for (const StageTimes& r : results)
            std::printf("%12.*f", digits, double(value(r)));
    };
    for (std::size_t i = 0; i < FrameStage::count; ++i)
        row(frame_stage_names[i], 2, [&](const StageTimes& r) { return r.ms[i]; });
    for (const StageRatio& ratio : ratios)
        row(ratio.label, ratio.digits, [&](const StageTimes& r) { return ratio.of(r); });
    row("warp, Mpixel/s", 1, [&](const StageTimes& r) { return 1e3 * megapixels / r.ms[FrameStage::warp]; });
    row("frames/s", 1, [](const StageTimes& r) { return 1e3 / r.ms[FrameStage::whole_frame]; });
    row("texels per pixel", 2, [](const StageTimes& r) { return r.texels_per_pixel; });
    row("images", 0, [](const StageTimes& r) { return r.images; });
    row("triangles sent", 0, [](const StageTimes& r) { return r.triangles; });
    row("device images, MiB", 1, [](const StageTimes& r) { return r.megabytes; });
    std::printf("\n");
}

nlohmann::ordered_json json_of(const std::vector<StageTimes>& results)
{
    nlohmann::ordered_json json;
    for (const StageTimes& r : results) {
        for (std::size_t i = 0; i < FrameStage::count; ++i)
            json["milliseconds"][r.name][frame_stage_names[i]] = r.ms[i];
        json["texels_per_pixel"][r.name] = r.texels_per_pixel;
        for (const StageRatio& ratio : ratios)
            json["ratios"][ratio.key][r.name] = ratio.of(r);
    }
    return json;
}

} // namespace

nlohmann::ordered_json bench_frame_stages(int rounds, bool all)
{
    const glm::ivec2 size(800, 600);
    const Layout layout = window_of(size);
    Avenue avenue;
    BareLookupBaseline lookup(avenue.context.device, avenue.context.pipelines);
    std::printf("%s; avenue at %dx%d, all effects on; medians of %d rounds, milliseconds\n\n", avenue.context.device.name(),
        size.x, size.y, rounds);
    std::vector<StageTimes> results;
    for (const auto& [name, gamma] : bench_speeds) {
        const Shot shot = along_avenue(avenue.context.world.scene.start, gamma);
        results.push_back(time_stages(avenue, lookup, layout, shot, name, rounds));
        std::fprintf(stderr, "%s measured\n", name);
    }
    print(results, 1e-6 * size.x * size.y);
    const auto levels = bench_spectra(avenue.context, layout, rounds);
    if (!all)
        return {};

    nlohmann::ordered_json json = json_of(results);
    json["device"] = avenue.context.device.name();
    for (std::size_t i = 1; i < levels.size(); ++i)
        json["ratios"]["spectral_levels"][spectral_level_names[i]] = {{"cube", levels[i][0]}, {"warp", levels[i][1]}};
    for (const auto& [name, ratio] : bench_cubes(rounds))
        json["ratios"]["dome_over_plain"][name] = ratio;
    json["ratios"]["first_velocity"] = bench_bodies(rounds);
    for (const auto& [shot, ms] : bench_worlds(rounds))
        json["worlds"][shot + "_ms"] = ms;
    const FlightTimes flight = bench_flight();
    json["flight"] = {{"longest_ms", flight.longest_ms}, {"p50_ms", flight.p50_ms}, {"p99_ms", flight.p99_ms}};
    return json;
}

} // namespace starbow
