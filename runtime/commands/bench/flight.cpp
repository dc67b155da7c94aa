#include "flight.h"
#include "avenue.h"
#include "config/model/shipped.h"
#include "runtime/hud/hud.h"
#include "runtime/operation/latency.h"
#include "runtime/operation/progress.h"
#include "runtime/render/pass_timer.h"
#include "runtime/render/warm_up.h"
#include "runtime/world/worldline.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace starbow {
namespace {

constexpr double frames_per_s = 10;

/// A part of the flight: what begins it, and how fast the ship is at its two ends.
struct Manoeuvre {
    std::string name;
    double seconds, from_gamma, to_gamma;
    std::function<void(Shot&, FrameRenderer&)> begin = [](Shot&, FrameRenderer&) {};
};

std::vector<Manoeuvre> manoeuvres(const Layout& layout)
{
    const auto effects = [](Effects on) { return [on](Shot& shot, FrameRenderer&) { shot.effects = on; }; };
    const auto overlay = [](Overlay which) {
        return [which](Shot&, FrameRenderer& frame) {
            frame.measure(Measuring{.probes = {{glm::dvec3(0, 0, -1)}}, .over = {.overlay = which}});
        };
    };
    Layout edited = layout;
    std::get<Planar>(edited.outputs[0].viewports[0].projection).fov_y_deg *= 0.9;
    std::vector<Manoeuvre> all = {{"at rest", 3, 1, 1}, {"take-off", 6, 1, 4}};
    for (const EffectEntry& one : all_effects)
        if (one.usual)
            all.push_back({std::string(one.name) + " off", 2, 4, 4, effects(Effects{}.without(one.which))});
    all.push_back({"all off", 2, 4, 4, effects({.on = {}})});
    all.push_back({"Galilean", 2, 4, 4, effects({.comparison = Comparison::galilean})});
    all.push_back({"no light delay", 2, 4, 4, effects({.comparison = Comparison::no_light_delay})});
    for (const EffectEntry& one : all_effects)
        if (!one.usual)
            all.push_back({dashed(one.name), 2, 4, 4, effects(Effects{}.with(one.which))});
    all.push_back({"all on", 2, 4, 4, effects({})});
    for (Overlay which : drawn_overlays)
        all.push_back({"overlay", 2, 4, 4, overlay(which)});
    all.push_back({"overlay off", 1, 4, 4, [](Shot&, FrameRenderer& frame) { frame.measure({}); }});
    all.push_back({"glow", 2, 4, 4, [](Shot&, FrameRenderer& frame) { frame.bloom(0.2); }});
    all.push_back({"glow off", 1, 4, 4, [](Shot&, FrameRenderer& frame) { frame.bloom(0); }});
    all.push_back({"on to gamma 100", 8, 4, 100});
    all.push_back({"back", 6, 100, 4});
    for (const char* shot : {"starbow", "avenue-rest", "gamma100"})
        all.push_back(
            {"a tour's cut", 1, 4, 4, [shot](Shot& to, FrameRenderer&) { to = load_shot(shipped_file("shots", shot)); }});
    all.push_back({"layout edited", 2, 4, 1, [edited](Shot&, FrameRenderer& frame) { frame.adopt(edited); }});
    all.push_back({"window made smaller", 2, 1, 1, [](Shot&, FrameRenderer& frame) { frame.resize(0, {640, 480}); }});
    return all;
}

} // namespace

FlightTimes bench_flight()
{
    RenderContext context(shipped_file("scenes", "avenue"), device_options(false));
    const Layout layout = window_of({800, 600});
    const Quality quality = default_quality(context.device, false);
    OffscreenRenderer renderer(context.device, context.pipelines, context.world, layout, quality, false);
    renderer.frame().meter(true);
    PassTimer timer(context.device, renderer);
    WarmUp at_rest(context.device, context.pipelines, context.world, layout, quality,
        along_avenue(context.world.scene.start, 1), renderer.target(0).format, true, 0);
    Typesetter typesetter;
    const std::vector<Manoeuvre> all = manoeuvres(layout);
    double seconds = 0, flown = 0;
    for (const Manoeuvre& one : all)
        seconds += one.seconds;
    std::printf(
        "\nA flight along the avenue at 800x600, %.0f frames a second for %.0f s, from an empty list of pipelines on; "
        "longest frame, milliseconds, and new pipelines\n",
        frames_per_s, seconds);
    Progress progress;
    Shot shot = along_avenue(context.world.scene.start, 1);
    std::vector<double> ms;
    for (const Manoeuvre& one : all) {
        one.begin(shot, renderer.frame());
        const bool cut = one.name == "a tour's cut";
        const std::size_t first = ms.size(), pipelines = context.pipelines.count();
        const double from = std::acosh(one.from_gamma), to = std::acosh(one.to_gamma);
        for (int i = 0; i < one.seconds * frames_per_s; ++i, flown += 1 / frames_per_s) {
            progress.show(one.name, flown / seconds);
            const double rapidity = from + (to - from) * i / (one.seconds * frames_per_s);
            if (!cut) {
                shot.u = {0, 0, -std::sinh(rapidity)};
                shot.exposure_ev = -3 * std::min(1.0, rapidity / 2);
                shot.position.z -= 0.02;
            }
            const Panel panel = typesetter.draw(readings(ship_at(shot), context.world.scene, shot.effects), words_in("en"),
                renderer.frame().views().hud_width());
            ms.push_back(timer.frame(shot, &panel));
            if (shot.u == glm::dvec3(0) && at_rest.ready()) // as the exhibit at rest
                ms.back() += milliseconds([&] { at_rest.step(&panel); });
        }
        std::printf("  %-22s%8.1f%8zu\n", one.name.c_str(), *std::max_element(ms.begin() + std::ptrdiff_t(first), ms.end()),
            context.pipelines.count() - pipelines);
    }
    const FlightTimes times{percentile(ms, 1), percentile(ms, 0.5), percentile(ms, 0.99)};
    const auto slow = std::count_if(ms.begin(), ms.end(), [](double one) { return one > 100; });
    std::printf("  longest %.1f, p99 %.1f, p50 %.1f; %td of %zu frames above 100 ms\n", times.longest_ms, times.p99_ms,
        times.p50_ms, slow, ms.size());
    return times;
}

} // namespace starbow
