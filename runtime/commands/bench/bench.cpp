#include "bodies.h"
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "cubes.h"
#include "governor.h"
#include "input.h"
#include "layout.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/number.h"
#include "runtime/commands/timing.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "runtime/world/detail.h"
#include "scaling.h"
#include "spectra.h"
#include "stars.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

struct Options {
    int rounds = 25, seconds = 60;
    bool input = false;
    std::string json, layout, shot = "avenue-gamma4";
    bool stars = false, bodies = false, cubes = false, scaling = false, governor = false;
    std::string ladder = "ladder";
    double frame_budget_ms = 0;
};

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// A bare cube map of 512 texels a side, its look-up pass, and the set that both need.
struct Lookup {
    Image cube, no_map;
    vk::raii::DescriptorPool pool = nullptr;
    vk::raii::DescriptorSet set = nullptr;
    vk::raii::Sampler sampler = nullptr;

    Lookup(Device& device, Pipelines& pipelines)
    {
        cube = make_image(device,
            {light_format, {512, 512}, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, 1, 6,
                vk::SampleCountFlagBits::e1, true});
        device.now([&](vk::CommandBuffer commands) {
            transition(commands, cube, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eTransferDstOptimal,
                Stage::eTransfer, Access::eTransferWrite);
            commands.clearColorImage(*cube.image, vk::ImageLayout::eTransferDstOptimal,
                vk::ClearColorValue(std::array<float, 4>{0.2f, 0.3f, 0.5f, 1}),
                vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 6));
            transition(commands, cube, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
                vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
        });
        vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 2);
        pool = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
        set = std::move(device.device.allocateDescriptorSets({*pool, *pipelines.picture_set}).front());
        sampler = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear});
        const float zeros[4] = {};
        no_map = make_texture(device, exact_format, {1, 1}, std::as_bytes(std::span(zeros)), false);
        vk::DescriptorImageInfo map(*sampler, *no_map.view, vk::ImageLayout::eShaderReadOnlyOptimal);
        vk::DescriptorImageInfo info(*sampler, *cube.view, vk::ImageLayout::eShaderReadOnlyOptimal);
        device.device.updateDescriptorSets(
            {vk::WriteDescriptorSet(*set, 0, 0, vk::DescriptorType::eCombinedImageSampler, map),
                vk::WriteDescriptorSet(*set, 1, 0, vk::DescriptorType::eCombinedImageSampler, info)},
            {});
    }
};

const char* const stage_names[] = {"plan and cull", "cube pass", "warp pass", "head-up display", "whole frame",
    "plain frame", "look-up pass", "metering", "warp, geometry alone", "warp, with colour", "stars"};
constexpr int stage_count = 11;

struct Result {
    std::string name;
    double ms[stage_count];
    double texels_per_pixel;
    std::size_t images, triangles;
    double megabytes;
    double frame_over_plain() const { return ms[4] / ms[5]; }
    double warp_over_lookup() const { return ms[2] / ms[6]; }
    double geometry_over_lookup() const { return ms[8] / ms[6]; }
    double colour_over_lookup() const { return ms[9] / ms[6]; }
    double metering_over_frame() const { return ms[7] / ms[4]; }
};

/// starless: the same world without its stars.
Result measure(RenderContext& context, const GpuWorld& starless, Lookup& lookup, const Layout& layout, const Shot& shot,
    const std::string& name, int rounds)
{
    Device& device = context.device;
    OffscreenRenderer renderer(device, context.pipelines, context.world, layout, default_quality(device, false), false);
    CubePass plain(device, context.pipelines, context.world, default_quality(device, false), false);
    Panel panel = Typesetter().draw(
        readings(ship_at(shot), context.world.scene, shot.effects), words_in("en"), renderer.frame().views().hud_width());
    Target target = renderer.target(0);
    renderer.frame().meter(true); // as the exhibit flies
    renderer.picture(shot, &panel); // warms every cache and leaves the target in a known layout
    vk::Pipeline lookup_pipeline = context.pipelines.lookup(target.format);
    Shot grey = shot; // what its pixels see is where it would be, and as bright and coloured as at rest
    grey.effects.doppler = grey.effects.headlight = false;
    OffscreenRenderer geometry(device, context.pipelines, starless, layout, default_quality(device, false), false);
    OffscreenRenderer colour(device, context.pipelines, starless, layout, default_quality(device, false), false);
    geometry.picture(grey);
    colour.picture(shot);
    auto warp = [&](OffscreenRenderer& of) {
        return milliseconds([&] {
            device.now([&](vk::CommandBuffer c) {
                make_writable(c, of.target(0));
                of.frame().passes().warp_output(c, 0, of.target(0));
            });
        });
    };

    // Every stage in turn within each round, so that whatever else the machine does falls on all alike.
    std::vector<double> times[stage_count];
    for (int round = -2; round < rounds; ++round) {
        double ms[stage_count];
        ms[0] = milliseconds([&] { renderer.frame().update(shot, &panel); });
        ms[1] = milliseconds([&] { device.now([&](vk::CommandBuffer c) { renderer.frame().draw_cubes(c); }); });
        ms[2] = warp(renderer);
        ms[8] = warp(geometry);
        ms[9] = warp(colour);
        ms[10]
            = milliseconds([&] { device.now([&](vk::CommandBuffer c) { renderer.frame().passes().draw_stars(c, 0, 0); }); });
        ms[6] = milliseconds([&] {
            device.now([&](vk::CommandBuffer c) {
                make_writable(c, target);
                renderer.frame().passes().look_up(c, target, lookup_pipeline, *lookup.set);
            });
        });
        ms[7] = milliseconds([&] {
            device.now([&](vk::CommandBuffer c) { renderer.frame().draw_meter(c); });
            (void)renderer.frame().metered();
        });
        ms[3] = milliseconds([&] {
            device.now([&](vk::CommandBuffer c) {
                make_writable(c, target);
                renderer.frame().passes().draw_hud(c, 0, target);
            });
        });
        ms[4] = milliseconds([&] {
            device.now([&](vk::CommandBuffer c) {
                make_writable(c, target);
                renderer.frame().draw(c, shot, &panel, std::span(&target, 1));
            });
            (void)renderer.frame().metered();
        });
        ms[5] = milliseconds([&] {
            glm::dmat3 straight;
            PlannedImage image = renderer.frame().passes().plain_image(shot, straight);
            plain.prepare_plain(image, {0, shot.position, shot.time, straight});
            device.now([&](vk::CommandBuffer c) {
                make_writable(c, target);
                plain.record_plain(c, target);
            });
        });
        for (int i = 0; round >= 0 && i < stage_count; ++i)
            times[i].push_back(ms[i]);
    }
    Result result{name, {}, 0, 0, renderer.frame().triangles(), double(renderer.frame().memory()) / (1 << 20)};
    for (int i = 0; i < stage_count; ++i)
        result.ms[i] = median(times[i]);
    for (const CubeMapPlan& plan : renderer.frame().plans()) {
        result.texels_per_pixel += plan.texels / plan.pixels;
        result.images += plan.images.size();
    }
    return result;
}

int bench(const Options& options)
{
    if (options.input)
        return bench_input(options.layout, options.seconds);
    if (options.stars)
        return bench_stars(options.rounds);
    if (options.bodies)
        return bench_bodies(options.rounds);
    if (options.governor)
        return bench_governor(options.ladder, options.frame_budget_ms, options.seconds);
    if (options.scaling)
        return bench_scaling(options.rounds);
    if (!options.layout.empty())
        return bench_layout(options.layout, options.shot, options.rounds);
    if (!options.json.empty())
        check_writable(options.json);
    Layout layout = load_layout(shipped_file("layouts", "desk"));
    layout.outputs[0].size = {800, 600};
    RenderContext context(shipped_file("scenes", "avenue"), device_options(false));
    World world = load_world(context.world.scene.gltf);
    add_detail_levels(world);
    const GpuWorld starless
        = upload(context.device, context.pipelines, std::move(world), context.world.scene, {}, context.world.spectra.level);
    if (options.cubes) {
        bench_cubes(context, starless, options.rounds);
        return 0;
    }
    Lookup lookup(context.device, context.pipelines);
    std::printf("%s; avenue at 800x600, all effects on; medians of %d rounds, milliseconds\n\n",
        context.device.properties.deviceName.data(), options.rounds);
    std::vector<Result> results;
    struct Case {
        const char* name;
        double gamma;
    };
    for (Case c : {Case{"rest", 1}, Case{"gamma4", 4}, Case{"gamma100", 100}}) {
        Shot shot = context.world.scene.start;
        if (c.gamma > 1) {
            shot.position.z = -8;
            shot.u = {0, 0, -std::sqrt((c.gamma - 1) * (c.gamma + 1))};
        }
        shot.exposure_ev = c.gamma > 1 ? -3 : 0;
        results.push_back(measure(context, starless, lookup, layout, shot, c.name, options.rounds));
        std::fprintf(stderr, "%s measured\n", c.name);
    }
    std::printf("%-22s", "");
    for (const Result& r : results)
        std::printf("%12s", r.name.c_str());
    for (int i = 0; i < stage_count; ++i) {
        std::printf("\n%-22s", stage_names[i]);
        for (const Result& r : results)
            std::printf("%12.2f", r.ms[i]);
    }
    auto line = [&](const char* name, const char* format, auto value) {
        std::printf("\n%-22s", name);
        for (const Result& r : results)
            std::printf(format, value(r));
    };
    line("frame / plain", "%12.2f", [](const Result& r) { return r.frame_over_plain(); });
    line("warp / look-up", "%12.2f", [](const Result& r) { return r.warp_over_lookup(); });
    line("  geometry alone", "%12.2f", [](const Result& r) { return r.geometry_over_lookup(); });
    line("  with colour", "%12.2f", [](const Result& r) { return r.colour_over_lookup(); });
    line("metering / frame", "%12.3f", [](const Result& r) { return r.metering_over_frame(); });
    line("warp, Mpixel/s", "%12.1f", [](const Result& r) { return 0.48e3 / r.ms[2]; });
    line("frames/s", "%12.1f", [](const Result& r) { return 1e3 / r.ms[4]; });
    line("texels per pixel", "%12.2f", [](const Result& r) { return r.texels_per_pixel; });
    line("images", "%12zu", [](const Result& r) { return r.images; });
    line("triangles sent", "%12zu", [](const Result& r) { return r.triangles; });
    line("device images, MiB", "%12.1f", [](const Result& r) { return r.megabytes; });
    std::printf("\n");
    const auto levels = bench_spectra(context, layout, options.rounds);

    if (!options.json.empty()) {
        nlohmann::ordered_json json;
        json["device"] = context.device.properties.deviceName.data();
        for (const Result& r : results) {
            for (int i = 0; i < stage_count; ++i)
                json["milliseconds"][r.name][stage_names[i]] = r.ms[i];
            json["texels_per_pixel"][r.name] = r.texels_per_pixel;
            json["ratios"]["frame_over_plain"][r.name] = r.frame_over_plain();
            json["ratios"]["geometry_over_lookup"][r.name] = r.geometry_over_lookup();
            json["ratios"]["colour_over_lookup"][r.name] = r.colour_over_lookup();
            json["ratios"]["metering_over_frame"][r.name] = r.metering_over_frame();
        }
        json["ratios"]["warp_over_lookup"] = results[1].warp_over_lookup();
        for (std::size_t i = 1; i < levels.size(); ++i)
            json["ratios"]["spectral_levels"][spectral_level_names[i]] = {{"cube", levels[i][0]}, {"warp", levels[i][1]}};
        std::filesystem::path folder = std::filesystem::path(options.json).parent_path();
        std::error_code error; // told by the stream
        if (!folder.empty())
            std::filesystem::create_directories(folder, error);
        std::ofstream stream(options.json);
        stream << json.dump(2) << "\n";
        if (!stream.flush())
            throw InputError(options.json, "", "can't be written; give a file in a folder that can be");
    }
    return 0;
}

} // namespace

void add_bench(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<Options>();
    CLI::App* command
        = app.add_subcommand("bench", "Times the stages of a frame, and two ratios measured in turn in the same run.");
    command->add_option("--rounds", options->rounds, "How often each stage is timed")
        ->check(whole_number(3, 10000))
        ->capture_default_str();
    command->add_option("--json", options->json, "Also write the figures to this file");
    command->add_option("--layout", options->layout,
        "Instead: this layout stage by stage, and displays compared with each other: kinds of projection, many viewports, "
        "stereo methods");
    command->add_option("--shot", options->shot, "With --layout: the shot to time")->capture_default_str();
    command->add_flag("--stars", options->stars, "Instead: what the stars cost, the avenue's own and a million");
    command->add_flag("--bodies", options->bodies, "Instead: what bodies that move cost, in view and out of it");
    command->add_flag("--cubes", options->cubes,
        "Instead: a dome beside a plain picture, and the planned images beside six full faces as fine");
    command->add_flag(
        "--scaling", options->scaling, "Instead: the cost of a pixel, a triangle and an object as they grow many");
    command->add_flag("--input", options->input,
        "Instead: in the exhibit's windows (on --layout), the time from a stick's report to the return of the present call "
        "that shows it");
    command->add_flag("--governor", options->governor,
        "Instead: how well a frame's time is held under a load that doubles and halves every 5 s");
    command->add_option("--ladder", options->ladder, "With --governor: the ladder")->capture_default_str();
    command->add_option(
        "--frame-budget-ms", options->frame_budget_ms, "With --governor: the time that is held [1.5 of the middle rung's]");
    command->add_option("--seconds", options->seconds, "With --input and --governor: how long")
        ->check(whole_number(1, 3600))
        ->capture_default_str();
    command->footer("Examples:\n  starbow bench --json out/bench.json\n  starbow bench --input --seconds 60");
    command->callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

} // namespace starbow
