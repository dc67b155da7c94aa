// A heading that cannot be seen changes nothing in the picture, and slow flight in any direction shows what rays show.
#include "config/model/angles.h"
#include "runtime/images/picture_errors.h"
#include "runtime/reference/number_errors.h"
#include "runtime/reference/reference.h"
#include "runtime/world/observer.h"
#include "tests/support/gpu_environment.h"
#include "tests/support/layouts.h"

namespace steady_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;
using starbow::testing::all_cases;
using starbow::testing::small_shipped_layout;

namespace {

using Bytes = std::vector<std::uint8_t>;

double psnr(const Bytes& a, const Bytes& b)
{
    const ivec2 size(int(a.size() / 4), 1);
    return psnr_dB({size, a}, {size, b});
}

/// Directions of motion: along the view, aside, back, and close to one another.
const dvec3 headings[]
    = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, -0.48, -0.64}, {0.6, -0.49, -0.64}, {0.05, 0.998, 0.01}};

Shot along(const dvec3& heading, double beta)
{
    return shot_at({0.3, 0.7, 5}, glm::normalize(heading) * u_of_beta(beta), {0.3, 0.1, -1});
}

} // namespace

TEST(Steady, AHeadingAtAMillionthOfLightChangesNothing)
{
    std::vector<std::string> layouts = {"desk", "dome"};
    if (all_cases())
        layouts.insert(layouts.end(), {"headset", "stereo", "cave5"});
    for (const std::string& name : layouts)
        for (const std::string preset : {"draft", "balanced", "fine"}) {
            if (!all_cases() && name == "dome" && preset != "balanced")
                continue;
            const Quality quality
                = within(device(), load_quality(starbow::testing::source_dir() / "config/qualities" / (preset + ".json")));
            OffscreenRenderer live(device(), pipelines(), avenue().world, small_shipped_layout(name, 320), quality, false);
            std::vector<std::vector<Bytes>> pictures;
            pictures.push_back(live.picture(along({0, 0, -1}, 0)));
            for (const dvec3& heading : headings)
                pictures.push_back(live.picture(along(heading, 1e-6)));
            double worst = 1e9;
            for (const std::vector<Bytes>& a : pictures)
                for (const std::vector<Bytes>& b : pictures)
                    for (std::size_t i = 0; i < a.size(); ++i)
                        worst = std::min(worst, psnr(a[i], b[i]));
            std::printf("%s, %s: %.1f dB\n", name.c_str(), preset.c_str(), worst);
            // At 45 dB nobody sees a difference, even of pictures shown in turn.
            EXPECT_GT(worst, 45) << name << ", " << preset;
        }
}

TEST(Steady, ObliqueSlowFlightShowsWhatRaysShow)
{
    const ReferenceWorld rays = open_reference_world(starbow::testing::source_dir() / "config/scenes/avenue.json");
    std::vector<std::string> layouts = {"desk", "dome"};
    if (all_cases())
        layouts.insert(layouts.end(), {"headset", "stereo", "cave5"});
    for (const std::string& name : layouts)
        for (double beta : {0.3, 0.5})
            for (Comparison comparison : {Comparison::none, Comparison::galilean}) {
                if (!all_cases() && name == "dome" && (beta != 0.5 || comparison != Comparison::none))
                    continue;
                Shot shot = along({0.6, 0.48, 0.64}, beta);
                shot.effects = {.comparison = comparison};
                const Layout layout = small_shipped_layout(name, 160);
                OffscreenRenderer live = renderer(avenue().world, layout);
                const auto pictures = live.picture(shot);
                ASSERT_FALSE(observer_of(avenue().world.world, shot, {}).rest_frames[0].aligned());
                for (std::size_t output = 0; output < layout.outputs.size(); ++output) {
                    const Reference truth = reference(rays.input(), layout, shot, output, {.samples = 8});
                    const NumberErrors errors = number_errors(truth, live.numbers(shot, output), shot.u);
                    const double dB = psnr(pictures[output], shown(truth)), direction = quantile(errors.directions_px, 0.99),
                                 D = quantile(errors.doppler, 0.99);
                    std::printf("%s, %g c: %.1f dB, %.1e px, D %.1e\n", name.c_str(), beta, dB, direction, D);
                    EXPECT_TRUE(errors.finite);
                    // docs/accuracy.md promises a thousandth of a pixel and a millionth, in slow flight as in fast.
                    EXPECT_LT(direction, 1e-3) << name << " " << beta;
                    EXPECT_LT(D, 1e-6) << name << " " << beta;
                    EXPECT_GT(dB, 29) << name << " " << beta; // a picture off by one pixel has at most 20
                }
            }
}

} // namespace steady_gpu_test
