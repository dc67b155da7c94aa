#include "layout.h"
#include "config/json/whole_file.h"
#include "config/model/one_view.h"
#include "config/model/shipped.h"
#include "runtime/commands/median.h"
#include "runtime/render/disparity.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/render_context.h"
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <unistd.h>

namespace starbow {
namespace {

double pixels_of(const Layout& layout)
{
    double sum = 0;
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (const View& view : views_of(layout, output, layout.outputs[output].size))
            sum += double(view.size.x) * view.size.y;
    return sum;
}

/// The timed stages of a layout: indices of layout_stage_names.
struct LayoutStage {
    enum { plan_and_cull, cubes, warps, finishes, whole_frame, metering, count };
};
const char* const layout_stage_names[LayoutStage::count]
    = {"plan and cull", "cube passes", "warp passes", "finish passes", "whole frame", "metering"};

/// One layout to time among others.
struct LayoutCase {
    std::string name;
    std::unique_ptr<OffscreenRenderer> renderer;
    std::vector<double> times[LayoutStage::count];
    double ms(int stage) const { return median(times[stage]); }

    void round(Device& device, const Shot& shot, bool counts)
    {
        PassTimer timer(device, *renderer);
        double ms[LayoutStage::count];
        ms[LayoutStage::plan_and_cull] = timer.update(shot);
        ms[LayoutStage::cubes] = timer.cubes();
        ms[LayoutStage::warps] = timer.warp();
        ms[LayoutStage::finishes] = timer.finish();
        ms[LayoutStage::metering] = timer.metering();
        ms[LayoutStage::whole_frame] = timer.frame(shot);
        for (int i = 0; counts && i < LayoutStage::count; ++i)
            times[i].push_back(ms[i]);
    }
};

/// Times cases in turn within each round, so that the machine's other work falls on all alike.
void time_layouts(RenderContext& context, std::vector<LayoutCase>& cases, const Shot& shot, int rounds)
{
    for (int round = -2; round < rounds; ++round)
        for (LayoutCase& one : cases)
            one.round(context.device, shot, round >= 0);
}

LayoutCase make_case(RenderContext& context, const std::string& name, const Layout& layout)
{
    LayoutCase one;
    one.name = name;
    one.renderer = std::make_unique<OffscreenRenderer>(
        context.device, context.pipelines, context.world, layout, default_quality(context.device, false), false);
    one.renderer->frame().meter(true); // as the exhibit flies
    return one;
}

void bench_kinds(RenderContext& context, const Shot& shot, int rounds)
{
    constexpr glm::ivec2 size(800, 600);
    // The same window bent by a mesh that bends nothing, and the fisheye whose circle covers the whole picture: every pixel
    // shows something in all of them.
    const std::filesystem::path file
        = std::filesystem::temp_directory_path() / ("starbow-bench-" + std::to_string(::getpid()) + ".data");
    write_whole(file, "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n");
    Layout mesh = one_view(Planar{90}, size);
    mesh.outputs[0].viewports[0].warp = Warp{file};
    Lens lens;
    lens.fov_y_deg = 90;
    for (int i = 0; i < 3; ++i)
        lens.colours[std::size_t(i)].k = {0.1 + 0.01 * i, 0, 0, 0};
    Fisheye fisheye{.aperture_deg = 110, .tilt_deg = 90, .diameter = 5.0 / 3};
    std::vector<LayoutCase> cases;
    cases.push_back(make_case(context, "planar", one_view(Planar{90}, size)));
    cases.push_back(make_case(context, "fisheye", one_view(fisheye, size)));
    cases.push_back(make_case(context, "mesh", mesh));
    cases.push_back(make_case(context, "lens, three colours", one_view(lens, size)));
    std::filesystem::remove(file);
    time_layouts(context, cases, shot, rounds);
    std::printf("\nThe warp pass by kind of display, 800x600:\n");
    for (const LayoutCase& one : cases)
        std::printf("  %-22s %7.2f ms  %6.1f ns per pixel  %5.2f of planar\n", one.name.c_str(), one.ms(LayoutStage::warps),
            one.ms(LayoutStage::warps) * 1e6 / (size.x * size.y),
            one.ms(LayoutStage::warps) / cases[0].ms(LayoutStage::warps));
}

void bench_viewports(RenderContext& context, const Shot& shot, int rounds)
{
    // The same directions twice: a window of 1600 x 600 whole, and as eight windows of 400 x 300.
    const double half_y = 30, unit = std::tan(glm::radians(half_y)) / 300;
    auto angle = [&](double pixels) { return glm::degrees(std::atan(pixels * unit)); };
    Layout whole = one_view(Planar{60}, {1600, 600}), eight = whole;
    eight.outputs[0].viewports.clear();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) {
            Planar part;
            part.sides = Sides{angle(400 * x - 800), angle(400 * x - 400), angle(-300 * y), angle(300 - 300 * y)};
            eight.outputs[0].viewports.push_back({.rect = {0.25 * x, 0.5 * y, 0.25, 0.5}, .projection = part});
        }
    std::vector<LayoutCase> cases;
    cases.push_back(make_case(context, "one viewport", whole));
    cases.push_back(make_case(context, "eight viewports", eight));
    time_layouts(context, cases, shot, rounds);
    std::printf("\nEight viewports of 400x300 that share an eye, beside one of 1600x600:\n");
    for (const LayoutCase& one : cases)
        std::printf("  %-22s %7.2f ms whole frame  %7.2f ms warp  %5.2f of one\n", one.name.c_str(),
            one.ms(LayoutStage::whole_frame), one.ms(LayoutStage::warps),
            one.ms(LayoutStage::whole_frame) / cases[0].ms(LayoutStage::whole_frame));
}

void bench_stereo(RenderContext& context, const Shot& shot, int rounds)
{
    Layout stereo = one_view(Planar{60}, {1600, 600});
    stereo.outputs[0].packing = Packing::side_by_side;
    stereo.stereo.by_light = true;
    Layout turning = one_view(Fisheye{.aperture_deg = 180, .tilt_deg = 30}, {1200, 600});
    turning.outputs[0].packing = Packing::side_by_side;
    turning.stereo = stereo.stereo;
    turning.stereo.method = StereoMethod::reprojected;
    Layout still_dome = turning, turned = turning;
    turned.stereo.turning = true;
    still_dome.stereo.method = StereoMethod::exact;

    struct Method {
        const char* name;
        StereoMethod method;
    };
    std::vector<LayoutCase> cases;
    std::vector<Layout> layouts;
    for (Method m : {Method{"exact", StereoMethod::exact}, Method{"reprojected", StereoMethod::reprojected},
             Method{"shared", StereoMethod::shared}}) {
        layouts.push_back(stereo);
        layouts.back().stereo.method = m.method;
        cases.push_back(make_case(context, m.name, layouts.back()));
    }
    layouts.push_back(still_dome);
    cases.push_back(make_case(context, "dome, exact", still_dome));
    layouts.push_back(turned);
    cases.push_back(make_case(context, "dome, turning", turned));
    time_layouts(context, cases, shot, rounds);
    // Errors at the quality of stills, where the depth map is as fine as the picture.
    const Quality quality = default_quality(context.device, true);
    auto measured = [&](const Layout& layout) {
        return std::make_unique<OffscreenRenderer>(context.device, context.pipelines, context.world, layout, quality, true);
    };
    std::printf("\nTwo eyes of 800x600 (domes 600x600), %.4g scene units apart:\n",
        stereo.stereo.separation_m
            * stereo.stereo.units_per_m(context.world.scene.unit_m, context.world.scene.light_speed_m_s));
    std::printf("  %-22s %10s %8s %9s   %s\n", "", "frame, ms", "of exact", "warp, ms",
        "disparity error, pixels: median, 99 %, most; hidden wrongly");
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::unique_ptr<OffscreenRenderer> tested = measured(layouts[i]);
        const bool turns = layouts[i].stereo.turning;
        Layout exact_layout = layouts[i];
        exact_layout.stereo.method = StereoMethod::exact;
        const std::unique_ptr<OffscreenRenderer> exact = turns ? nullptr : measured(exact_layout);
        const Disparity off = disparity(*tested, exact.get(), shot, 0, context.world.scene);
        const std::size_t base = i < 3 ? 0 : 3;
        std::printf("  %-22s %10.2f %8.2f %9.2f   %8.3f %8.3f %8.2f  %6.2f %%\n", cases[i].name.c_str(),
            cases[i].ms(LayoutStage::whole_frame),
            cases[i].ms(LayoutStage::whole_frame) / cases[base].ms(LayoutStage::whole_frame),
            cases[i].ms(LayoutStage::warps), off.median, off.high, off.most, 100 * off.hidden);
    }
}

} // namespace

void bench_layout(const std::string& name, const std::string& shot_name, int rounds)
{
    const Layout layout = load_layout(shipped_file("layouts", name));
    const std::filesystem::path shot_file = shipped_file("shots", shot_name);
    const Shot shot = load_shot(shot_file);
    RenderContext context(scene_of(shot, shot_file), device_options(false));
    std::printf(
        "%s; layout %s, shot %s; medians of %d rounds\n\n", context.device.name(), name.c_str(), shot_name.c_str(), rounds);

    // Compiling the maps: without a cache, and from a folder that holds them.
    const std::filesystem::path folder
        = std::filesystem::temp_directory_path() / ("starbow-bench-" + std::to_string(::getpid()));
    auto compile_all = [&](MapStore store) {
        return milliseconds([&] {
            for (std::size_t output = 0; output < layout.outputs.size(); ++output)
                compile_output(store, layout, output, layout.outputs[output].size);
        });
    };
    const double cold = compile_all(MapStore(std::filesystem::path()));
    compile_all(MapStore(folder));
    const double warm = compile_all(MapStore(folder));
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    const double pixels = pixels_of(layout);
    std::printf("  %-22s %10.1f ms  (%.1f ns per pixel), %.1f ms from the cache\n", "direction maps", cold,
        cold * 1e6 / pixels, warm);

    std::vector<LayoutCase> cases;
    cases.push_back(make_case(context, name, layout));
    time_layouts(context, cases, shot, rounds);
    const LayoutCase& own = cases.front();
    for (int i = 0; i < LayoutStage::count; ++i)
        std::printf("  %-22s %10.2f ms  %6.1f ns per pixel\n", layout_stage_names[i], own.ms(i), own.ms(i) * 1e6 / pixels);
    double texels = 0;
    std::size_t images = 0;
    for (const CubeMapPlan& plan : own.renderer->frame().plans())
        texels += plan.texels, images += plan.images.size();
    std::printf("  %-22s %10.2f Mpixel, %.2f texels each in %zu images of %zu cube maps, %.1f MiB of images\n", "drawn",
        pixels * 1e-6, texels / pixels, images, own.renderer->frame().plans().size(),
        double(own.renderer->frame().memory()) / (1 << 20));
    std::fflush(stdout);
    bench_kinds(context, shot, rounds);
    std::fflush(stdout);
    bench_viewports(context, shot, rounds);
    std::fflush(stdout);
    bench_stereo(context, shot, std::max(3, rounds / 3));
}

} // namespace starbow
