#include "cubes.h"
#include "avenue.h"
#include "config/model/angles.h"
#include "config/model/one_view.h"
#include "runtime/commands/median.h"
#include "runtime/render/baselines.h"
#include "runtime/render/pass_timer.h"
#include <cmath>
#include <cstdio>

namespace starbow {
namespace {

/// All directions at one density: a plan for each part of a face that a device draws at once.
std::vector<CubeMapPlan> full_faces(double texels_per_unit)
{
    constexpr int most = 4096;
    const int side = int(std::ceil(2 * texels_per_unit)), parts = (side + most - 1) / most;
    std::vector<CubeMapPlan> plans;
    for (int face = 0; face < 6; ++face)
        for (int j = 0; j < parts; ++j)
            for (int i = 0; i < parts; ++i) {
                auto edge = [&](int k) { return -1 + 2.0 * k / parts; };
                PlannedImage image{TILE_FRONT, face, {edge(i), edge(j)}, {edge(i + 1), edge(j + 1)},
                    glm::ivec2(side / parts), {0, 0}, texels_per_unit, 1};
                CubeMapPlan plan;
                plan.images = {image};
                plan.atlas_size = image.size;
                plan.finest_clip_level = {0};
                plans.push_back(plan);
            }
    return plans;
}

/// The renderers and yardsticks that one speed is timed with.
struct CubesCase {
    OffscreenRenderer dome, starry_dome, window, desk;
    CubePass faces_pass;
    PlainPictureBaseline plain;

    CubesCase(RenderContext& c, const GpuWorld& starless, const Layout& dome_layout, const Layout& window_layout,
        const Quality& quality)
        : dome(c.device, c.pipelines, starless, dome_layout, quality, false)
        , starry_dome(c.device, c.pipelines, c.world, dome_layout, quality, false)
        , window(c.device, c.pipelines, starless, window_layout, quality, false)
        , desk(c.device, c.pipelines, starless, window_of({800, 600}), default_quality(c.device, false), false)
        , faces_pass(c.device, c.pipelines, starless, default_quality(c.device, false), false)
        , plain(c.device, c.pipelines, starless, default_quality(c.device, false), window)
    {
    }
};

/// The timed stages of one speed: indices of its times.
struct CubesStage {
    enum { dome, starry_dome, plain, plan, faces, count };
};

/// Returns the starry dome's time over the plain picture's.
double time_speed(Avenue& avenue, CubesCase& one, const Shot& shot, double gamma, int rounds)
{
    Device& device = avenue.context.device;
    for (OffscreenRenderer* renderer : {&one.dome, &one.starry_dome, &one.window, &one.desk})
        renderer->picture(shot); // warms every cache
    const CubeMapPlan& plan = one.desk.frame().plans()[0];
    double finest = 0, texels = 0;
    for (const PlannedImage& image : plan.images)
        finest = std::max(finest, image.texels_per_unit);
    const std::vector<CubeMapPlan> faces = full_faces(finest);
    for (const CubeMapPlan& part : faces)
        texels += double(part.atlas_size.x) * part.atlas_size.y;
    const bool draws_faces = texels < 2.5e8;
    const EyeEvent eye_event{0, shot.position, shot.time, motion_from_world(shot.u, shot.ship_from_cockpit)};
    PassTimer dome(device, one.dome), starry_dome(device, one.starry_dome), desk(device, one.desk);

    std::vector<double> times[CubesStage::count];
    for (int round = -1; round < rounds; ++round) {
        double ms[CubesStage::count] = {};
        ms[CubesStage::dome] = dome.frame(shot);
        ms[CubesStage::starry_dome] = starry_dome.frame(shot);
        ms[CubesStage::plain] = one.plain.ms(shot);
        ms[CubesStage::plan] = desk.update(shot) + desk.cubes();
        if (draws_faces)
            ms[CubesStage::faces] = draw_plans_ms(device, one.faces_pass, faces, eye_event);
        for (int i = 0; round >= 0 && i < CubesStage::count; ++i)
            times[i].push_back(ms[i]);
    }
    double ms[CubesStage::count];
    for (int i = 0; i < CubesStage::count; ++i)
        ms[i] = median(times[i]);
    std::printf("gamma %-4g%8.1f%8.1f%8.2f%14.1f,%8.2f )%11.1f", gamma, ms[CubesStage::dome], ms[CubesStage::plain],
        ms[CubesStage::dome] / ms[CubesStage::plain], ms[CubesStage::starry_dome],
        ms[CubesStage::starry_dome] / ms[CubesStage::plain], ms[CubesStage::plan]);
    if (draws_faces)
        std::printf("%8.1f%8.3f", ms[CubesStage::faces], ms[CubesStage::plan] / ms[CubesStage::faces]);
    else
        std::printf("%8s%8s", "-", "-");
    std::printf("%12.2f of %.1f )\n", plan.texels * 1e-6, texels * 1e-6);
    std::fflush(stdout);
    return ms[CubesStage::starry_dome] / ms[CubesStage::plain];
}

} // namespace

std::map<std::string, double> bench_cubes(int rounds)
{
    const glm::ivec2 size(1024);
    const Layout dome_layout = one_view(Fisheye{.aperture_deg = 180, .tilt_deg = 30}, size);
    // The pixels in the middle of this window are as wide as the dome's, pi / 1024.
    const double half_deg = glm::degrees(std::atan(pi / 2));
    const Layout window_layout = one_view(Planar{2 * half_deg}, size);
    Avenue avenue;
    Quality quality = default_quality(avenue.context.device, false);
    quality.texels_per_pixel = 1;
    quality.max_texels_per_pixel = 6;

    std::printf(
        "\nA dome of 1024x1024 with all effects, a texel for each pixel, beside a plain picture of 1024x1024 whose middle "
        "is as fine; six full\nfaces as fine as the finest image of the plan for 800x600, beside that plan's images; "
        "milliseconds\n%-10s%8s%8s%8s%26s%8s%8s%8s%26s\n",
        "", "dome", "plain", "ratio", "(with stars", "plan", "faces", "ratio", "(Mtexel");
    std::map<std::string, double> ratios;
    for (const auto& [name, gamma] : bench_speeds) {
        CubesCase one(avenue.context, avenue.starless, dome_layout, window_layout, quality);
        ratios[name] = time_speed(avenue, one, along_avenue(avenue.context.world.scene.start, gamma), gamma, rounds);
    }
    return ratios;
}

} // namespace starbow
