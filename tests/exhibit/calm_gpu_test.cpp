// A calm exhibit in its pictures: whatever hands do, they make no more than three flashes in a second.
#include "config/model/shipped.h"
#include "displays/check/eye_fields.h"
#include "input/calm.h"
#include "runtime/exhibit/replay_renderer.h"
#include "runtime/exhibit/session.h"
#include "runtime/images/flashes.h"
#include "runtime/light/srgb.h"
#include "tests/support/chance_hands.h"
#include "tests/support/gpu_environment.h"

namespace calm_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;
using starbow::testing::ChanceHands;

constexpr double dt_s = 1. / 30;
constexpr std::int64_t frame_ns = 33'333'333;

/// The window of the exhibit, in pixels of 1.2 degrees.
Layout window()
{
    Planar planar;
    planar.fov_y_deg = 60;
    return seen_layout(one_view(planar, {320, 240}), 0.6 * 3.14159265 / 180);
}

/// Counts the flashes of all pictures by an exhibit's own session, whose hands are `hands`, in the world of `context`.
class Watched {
public:
    Watched(RenderContext& context, const std::string& scene, bool calm, const Flying& rules)
        : layout_(window())
        , renderer_(context.device, context.pipelines, context.world, layout_, quality(), false)
    {
        options_.content = content_of_scene(scene);
        options_.layout = layout_;
        options_.words = starbow::testing::words();
        options_.exposure.calm = calm;
        options_.rules = rules;
        options_.paced = false;
        const std::vector<EyeField> fields = eye_fields(layout_);
        for (const EyePixel& pixel : fields[0].pixels) {
            at_.push_back(pixel.at);
            pixels_.push_back({glm::vec3(pixel.direction), float(pixel.solid_angle_sr), 0});
        }
    }

    /// The changes in the worst second.
    int flashes(const std::function<Controls(double)>& hands, double seconds)
    {
        Session session(options_);
        FlashLimiter calm_hands;
        const Shot& start = options_.content.start;
        ReplayRenderer pictures(renderer_, Pattern::none, options_.exposure, start.exposure_ev, options_.words);
        pictures.meter(true);
        FlashCounter counter(pixels_, 1);
        std::optional<double> metered;
        std::vector<glm::vec3> light(pixels_.size());
        dimmest_ = 1, mean_ = 0;
        for (int frame = 0; frame < int(seconds / dt_s); ++frame) {
            RecordEntry entry{.dt_ns = frame_ns};
            entry.controls = hands(dt_s);
            entry.controls.set(Switch::range, false),
                entry.controls.set(Switch::quit, false); // its curve needs samples, and its own test has them
            if (options_.exposure.calm)
                entry.controls = calm_hands.let_through(entry.controls, dt_s);
            step(session, entry, {metered, renderer_.frame().surface_samples(), {}, renderer_.frame().samples_across()});
            dimmest_ = std::min(dimmest_, entry.light), mean_ += entry.light * dt_s / seconds;
            pictures.take(entry, session.flight());
            const auto picture = pictures.picture(session.flight(), start.scene, nullptr);
            metered = renderer_.frame().metered();
            for (std::size_t i = 0; i < at_.size(); ++i) {
                const std::uint8_t* rgb = &picture[0][4
                    * (std::size_t(at_[i].y) * std::size_t(layout_.outputs[0].size.x) + std::size_t(at_[i].x))];
                for (int c = 0; c < 3; ++c)
                    light[i][c] = float(light_of_srgb(rgb[c] / 255.));
            }
            counter.take(frame * frame_ns, light);
        }
        worst_ = counter.worst(FlashKind::general, 0);
        return std::max(worst_.changes, counter.worst(FlashKind::red, 0).changes);
    }
    Flashes worst_;
    double dimmest_ = 1, mean_ = 0;

private:
    static Quality quality()
    {
        Quality quality = default_quality(device(), true);
        quality.pixel_rays = 3, quality.texels_per_pixel = 3, quality.max_texels_per_pixel = 18;
        return quality;
    }

    Layout layout_;
    OffscreenRenderer renderer_;
    ExhibitOptions options_;
    std::vector<ivec2> at_;
    std::vector<SeenPixel> pixels_;
};

Flying fast()
{
    Flying rules;
    rules.max_gamma = 100;
    return rules;
}

/// A mouse that is dragged up and down six times a second.
std::function<Controls(double)> dragged()
{
    return [t = 0.](double dt) mutable {
        t += dt;
        Controls controls;
        controls.look_rad.y = std::sin(6.283 * 6.2 * t) > 0 ? 0.35 : -0.35;
        return controls;
    };
}

TEST(CalmPictures, ADraggedMouseFlashesOnlyWithoutCalm)
{
    EXPECT_GT(Watched(avenue(), "avenue", false, fast()).flashes(dragged(), 3), 2 * most_flashes);
    EXPECT_LE(Watched(avenue(), "avenue", true, fast()).flashes(dragged(), 4), 2 * most_flashes);
}

TEST(CalmPictures, HandsOfChanceMakeAtMostThreeFlashesInASecond)
{
    const unsigned int trials = starbow::testing::all_cases() ? 60 : 2;
    Watched watched(avenue(), "avenue", true, fast());
    for (unsigned int seed = 0; seed < trials; ++seed) {
        ChanceHands hands(seed);
        EXPECT_LE(watched.flashes([&](double dt) { return hands.next(dt); }, 6), 2 * most_flashes) << "seed " << seed;
        std::printf("  seed %u: %.1f flashes, %.2f of the light, at least %.2f\n", seed, watched.worst_.flashes(),
            watched.mean_, watched.dimmest_);
    }
    Watched without(avenue(), "avenue", false, fast());
    int most = 0;
    for (unsigned int seed = 1; seed < 3; ++seed) {
        ChanceHands hands(seed);
        most = std::max(most, without.flashes([&](double dt) { return hands.next(dt); }, 4));
    }
    EXPECT_GT(most, 2 * most_flashes);
}

TEST(CalmPictures, WhatDoesNotFlashKeepsItsLight)
{
    Watched watched(avenue(), "avenue", true, fast());
    EXPECT_EQ(watched.flashes([](double) { return Controls(); }, 2), 0);
    EXPECT_EQ(watched.dimmest_, 1) << "at rest";
    const std::vector<double> levers = starbow::testing::all_cases() ? std::vector{0.1, 0.3, 1.} : std::vector{0.3};
    for (const double lever : levers) {
        watched.flashes(
            [&](double) {
                Controls controls;
                controls.lever = lever;
                return controls;
            },
            6);
        std::printf("  lever %.1f: %.1f flashes, %.2f of the light, at least %.2f\n", lever, watched.worst_.flashes(),
            watched.mean_, watched.dimmest_);
    }
}

} // namespace calm_gpu_test
