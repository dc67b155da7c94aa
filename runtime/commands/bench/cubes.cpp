#include "cubes.h"
#include "config/model/angles.h"
#include "config/model/one_view.h"
#include "config/model/shipped.h"
#include "runtime/commands/timing.h"
#include "runtime/render/offscreen.h"
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

Shot flight(const Shot& start, double gamma)
{
    Shot shot = start;
    if (gamma > 1) {
        shot.position.z = -8;
        shot.u = {0, 0, -std::sqrt((gamma - 1) * (gamma + 1))};
    }
    shot.exposure_ev = gamma > 1 ? -3 : 0;
    return shot;
}

} // namespace

void bench_cubes(RenderContext& context, const GpuWorld& starless, int rounds)
{
    Device& device = context.device;
    const glm::ivec2 size(1024);
    const Layout dome_layout = one_view(Fisheye{.aperture_deg = 180, .tilt_deg = 30}, size);
    // Its middle's pixels are as wide as the dome's, pi / 1024.
    const double half_deg = glm::degrees(std::atan(pi / 2));
    const Layout window_layout = one_view(Planar{2 * half_deg}, size);
    Quality quality = default_quality(device, false);
    quality.texels_per_pixel = 1;
    quality.max_texels_per_pixel = 6;

    std::printf(
        "\nA dome of 1024x1024 with all effects, a texel for each pixel, beside a plain picture of 1024x1024 whose middle "
        "is as fine; six full\nfaces as fine as the finest image of the plan for 800x600, beside that plan's images; "
        "milliseconds\n%-10s%8s%8s%8s%26s%8s%8s%8s%26s\n",
        "", "dome", "plain", "ratio", "(with stars", "plan", "faces", "ratio", "(Mtexel");
    for (double gamma : {1.0, 4.0, 100.0}) {
        const Shot shot = flight(context.world.scene.start, gamma);
        OffscreenRenderer dome(device, context.pipelines, starless, dome_layout, quality, false);
        OffscreenRenderer starry(device, context.pipelines, context.world, dome_layout, quality, false);
        OffscreenRenderer window(device, context.pipelines, starless, window_layout, quality, false);
        Layout desk = load_layout(shipped_file("layouts", "desk"));
        desk.outputs[0].size = {800, 600};
        OffscreenRenderer own(device, context.pipelines, starless, desk, default_quality(device, false), false);
        CubePass plain(device, context.pipelines, starless, default_quality(device, false), false);
        CubePass six(device, context.pipelines, starless, default_quality(device, false), false);
        for (OffscreenRenderer* renderer : {&dome, &starry, &window, &own})
            renderer->picture(shot); // leaves the target in a known layout
        const CubeMapPlan& plan = own.frame().plans()[0];
        double finest = 0, texels = 0;
        for (const PlannedImage& image : plan.images)
            finest = std::max(finest, image.texels_per_unit);
        const std::vector<CubeMapPlan> faces = full_faces(finest);
        for (const CubeMapPlan& part : faces)
            texels += double(part.atlas_size.x) * part.atlas_size.y;
        const bool draws_faces = texels < 2.5e8;
        const glm::dmat3 turn = motion_from_world(shot.u, shot.ship_from_cockpit);

        std::vector<double> times[5];
        for (int round = -1; round < rounds; ++round) {
            double ms[5] = {};
            auto frame = [&](OffscreenRenderer& renderer) {
                return milliseconds([&] {
                    device.now([&](vk::CommandBuffer c) {
                        const Target target = renderer.target(0);
                        make_writable(c, target);
                        renderer.frame().draw(c, shot, nullptr, std::span(&target, 1));
                    });
                });
            };
            ms[0] = frame(dome);
            ms[1] = frame(starry);
            ms[2] = milliseconds([&] {
                glm::dmat3 straight;
                const PlannedImage image = window.frame().passes().plain_image(shot, straight);
                plain.prepare_plain(image, {0, shot.position, shot.time, straight});
                device.now([&](vk::CommandBuffer c) {
                    make_writable(c, window.target(0));
                    plain.record_plain(c, window.target(0));
                });
            });
            ms[3] = milliseconds([&] {
                own.frame().update(shot, nullptr);
                device.now([&](vk::CommandBuffer c) { own.frame().draw_cubes(c); });
            });
            if (draws_faces)
                ms[4] = milliseconds([&] {
                    const EyeEvent eye_event{0, shot.position, shot.time, turn};
                    for (const CubeMapPlan& part : faces) {
                        six.prepare(part, {&eye_event, 1}, 1);
                        device.now([&](vk::CommandBuffer c) { six.record(c); });
                    }
                });
            for (int i = 0; round >= 0 && i < 5; ++i)
                times[i].push_back(ms[i]);
        }
        double ms[5];
        for (int i = 0; i < 5; ++i)
            ms[i] = median(times[i]);
        std::printf("gamma %-4g%8.1f%8.1f%8.2f%14.1f,%8.2f )%11.1f", gamma, ms[0], ms[2], ms[0] / ms[2], ms[1],
            ms[1] / ms[2], ms[3]);
        if (draws_faces)
            std::printf("%8.1f%8.3f", ms[4], ms[3] / ms[4]);
        else
            std::printf("%8s%8s", "-", "-");
        std::printf("%12.2f of %.1f )\n", plan.texels * 1e-6, texels * 1e-6);
        std::fflush(stdout);
    }
}

} // namespace starbow
