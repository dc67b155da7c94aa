// After a warm-up a visitor's flight finds all its pipelines. The warm-up draws insets, the flight large ones: the
// test is that both have plans of the same kinds.
#include "config/model/shipped.h"
#include "runtime/render/warm_up.h"
#include "runtime/shadow/add_shadows.h"
#include "runtime/world/worldline.h"
#include "tests/support/gpu_environment.h"

namespace starbow::gpu_test::warm_up_gpu_test {
namespace {

struct Place {
    const char *scene, *layout;
    glm::ivec2 size;
};
std::ostream& operator<<(std::ostream& out, const Place& place) { return out << place.scene << " on " << place.layout; }

class WarmUpIn : public ::testing::TestWithParam<Place> { };

TEST_P(WarmUpIn, AFlightAfterItMakesNoPipeline)
{
    const Place& place = GetParam();
    const SceneFile scene = load_scene_file(shipped_file("scenes", place.scene));
    Pipelines own(device());
    World made = load_world(scene);
    add_shadows(made, scene, map_cache_folder());
    const GpuWorld world = upload(device(), own, std::move(made), scene, {});
    Layout layout = load_layout(shipped_file("layouts", place.layout));
    layout.outputs[0].size = place.size;
    const Quality quality = within(device(), load_quality(shipped_file("qualities", "balanced")));
    OffscreenRenderer offscreen(device(), own, world, layout, quality, false);
    offscreen.frame().meter(true);
    {
        WarmUp warm_up(device(), own, world, layout, quality, scene.start, offscreen.target(0).format, true, 0);
        std::size_t steps = 0;
        while (warm_up.step(nullptr))
            ASSERT_LE(++steps, warm_up.steps());
    }
    std::size_t before = own.count();
    Shot shot = scene.start;
    const auto fly = [&](double gamma, const Effects& effects, Overlay overlay) {
        shot.u = shot.ship_from_cockpit * glm::dvec3(0, 0, -std::sqrt(gamma * gamma - 1));
        shot.effects = effects;
        offscreen.frame().measure({});
        if (overlay != Overlay::off)
            offscreen.frame().measure(Measuring{.probes = {{glm::dvec3(0, 0, -1)}}, .over = {.overlay = overlay}});
        offscreen.picture(shot);
        EXPECT_EQ(own.count() - std::exchange(before, own.count()), 0u)
            << "gamma " << gamma << ", overlay " << int(overlay) << ", effects " << effects[Effect::aberration]
            << effects[Effect::doppler] << effects[Effect::headlight] << effects[Effect::false_colours]
            << int(effects.comparison);
    };
    for (double gamma : {1.0, 1.01, 1.2, 2.0, 4.0, 20.0, 100.0})
        for (const Effects& effects : {Effects{}, Effects{}.without(Effect::aberration), Effects{}.without(Effect::doppler),
                 Effects{}.without(Effect::headlight), Effects{.on = {}}, Effects{.comparison = Comparison::galilean},
                 Effects{.comparison = Comparison::no_light_delay}, Effects{}.with(Effect::false_colours)})
            fly(gamma, effects, Overlay::off);
    offscreen.frame().range(RangeCurve());
    for (double gamma : {1.0, 1.01, 1.2, 2.0, 4.0, 20.0, 100.0})
        fly(gamma, {}, Overlay::off);
    offscreen.frame().range({});
    for (double gamma : {1.0, 4.0})
        for (Overlay overlay : drawn_overlays)
            fly(gamma, {}, overlay);
}

INSTANTIATE_TEST_SUITE_P(Places, WarmUpIn,
    ::testing::Values(Place{"avenue", "desk", {480, 360}}, Place{"avenue", "dome", {256, 256}},
        Place{"twins", "desk", {320, 240}}, Place{"avenue", "stereo", {400, 150}}));

} // namespace
} // namespace starbow::gpu_test::warm_up_gpu_test
