// The inset is warped from the cube map of the frame's own views. It must be the picture of its own shot, and the
// frame's own picture must stay.
#include "config/model/inset_view.h"
#include "shaders/physics/physics.h"
#include "tests/support/layouts.h"
#include "tests/support/small_world.h"
#include <algorithm>

namespace starbow::gpu_test::inset_gpu_test {
namespace {

using starbow::testing::small_shipped_layout;
using Bytes = std::vector<std::uint8_t>;
constexpr std::array kinds = {InsetView::at_rest, InsetView::aberration, InsetView::doppler, InsetView::headlight};
constexpr int width = 160;
constexpr ivec2 size(width, int(width* Inset::aspect));

Bytes inset_of(OffscreenRenderer& whole, std::size_t which = 0)
{
    const Image& picture = whole.frame().inset_picture(which);
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    device().now([&](vk::CommandBuffer commands) {
        transition(commands, picture, vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, {},
            vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    });
    const std::vector<std::byte> bytes = read_back(device(), picture, 4);
    const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    return {first, first + bytes.size()};
}

Quality reference_quality()
{
    return within(device(),
        {.texels_per_pixel = 3, .max_texels_per_pixel = 1000, .cube_samples = 8, .lod_error_texels = 0, .pixel_rays = 3});
}

/// Steps of 255 between two pictures.
struct Steps {
    double mean = 0;
    int most = 0;
};
Steps steps(const Bytes& a, const Bytes& b)
{
    Steps all;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const int off = std::abs(int(a[i]) - int(b[i]));
        all.mean += off / (0.75 * double(a.size())); // alpha is the same
        all.most = std::max(all.most, off);
    }
    return all;
}

/// The shot's event for an eye at a place of the cockpit, metres.
Shot at_eye(Shot shot, const dvec3& eye_m, const Stereo& stereo, const SceneFile& scene)
{
    const dvec3 offset = shot.ship_from_cockpit
        * (eye_m * ((stereo.by_light ? 0.5 * scene.light_speed_m_s : stereo.hyper_stereo) / scene.unit_m));
    shot.position += physics::eye_place(shot.u, offset);
    shot.time += physics::eye_time(shot.u, offset);
    return shot;
}

Layout shipped(const std::string& name)
{
    return load_layout(starbow::testing::source_dir() / "config/layouts" / (name + ".json"));
}

/// Compares the insets of a frame with those of their own shots, drawn alone from a cube map of their own, and the
/// frame's large picture with the one without them. shared: the inset comes from the large one's cube map; it must
/// then be about as near to a fine picture as one with a cube map of its own.
void compare(const GpuWorld& world, const Layout& layout, const Shot& ship, const Quality& quality, bool shared)
{
    OffscreenRenderer whole(device(), pipelines(), world, layout, quality, false);
    const Layout alone = one_view(Planar{inset_fov_deg}, size);
    OffscreenRenderer own(device(), pipelines(), world, alone, quality, false);
    OffscreenRenderer fine(device(), pipelines(), world, alone, reference_quality(), false);
    for (OffscreenRenderer* one : {&whole, &own})
        one->frame().repeatable(true);
    const std::vector<Bytes> bare = whole.picture(ship);
    for (const InsetView kind : kinds) {
        SCOPED_TRACE(name_of(kind));
        const dvec3 eye_m = whole.frame().views().probed_view().cube_m;
        const Shot event = at_eye(ship, eye_m, layout.stereo, world.scene);
        whole.frame().show_inset(starbow::inset_shot(ship, kind, 0.5), width);
        const std::vector<Bytes> with = whole.picture(ship);
        const Bytes shown = inset_of(whole), apart = own.picture(starbow::inset_shot(event, kind, 0.5))[0];
        if (shared) {
            const Bytes wanted = fine.picture(starbow::inset_shot(event, kind, 0.5))[0];
            // 0.3 to 0.45 where a pixel of the inset is some of the large one's; 1.35 where it is finer, in a
            // headset; 1.2 where one with a cube map of its own has several rays a pixel, too.
            const double bound = layout.file.stem() == "headset" || quality.pixel_rays > 1 ? 1.5 : 0.6;
            EXPECT_LT(steps(shown, wanted).mean, bound * steps(apart, wanted).mean) << layout.file;
            EXPECT_GT(steps(apart, wanted).mean, 0);
        } else {
            EXPECT_LE(steps(shown, apart).most, 1); // it was 0
        }
        // Under a limit of texels, the few beyond the large picture's edge move all others by a part of a texel.
        for (std::size_t output = 0; output < bare.size(); ++output)
            EXPECT_LT(steps(bare[output], with[output]).mean, shared && layout.file.stem() != "desk" ? 1 : 1e-9);
        whole.frame().drop_insets();
        EXPECT_EQ(whole.picture(ship), bare);
    }
}

Shot flying(double gamma, bool coloured, double look = 0)
{
    Shot ship = shot_at({0.3, 0.1, -8}, {0, 0, -u_of_gamma(gamma)}, {std::sin(look), 0.05, -std::cos(look)});
    ship.effects.on.set(Effect::doppler, coloured), ship.effects.on.set(Effect::headlight, coloured);
    ship.exposure_ev = coloured && gamma > 10 ? -8 : 0;
    return ship;
}

} // namespace

TEST(InsetGpuTest, TheAvenueAtEverySpeed)
{
    const bool all = starbow::testing::all_cases();
    for (const double gamma : {1.0, 1.1, 4.0, 100.0})
        for (const bool coloured : {false, true})
            for (const double look : {0.0, 0.6, 3.0}) {
                if (!all && (coloured != (gamma > 1.1) || (look == 0.6) != (gamma == 1)))
                    continue;
                SCOPED_TRACE(std::to_string(gamma) + " " + std::to_string(look));
                compare(avenue().world, small_shipped_layout("desk", 400), flying(gamma, coloured, look), test_quality(),
                    gamma == 1);
            }
}

TEST(InsetGpuTest, EveryLayout)
{
    for (const std::string name : {"desk", "dome", "stereo", "headset", "alice-bob"})
        for (const double gamma : {1.0, 4.0}) {
            SCOPED_TRACE(name + " " + std::to_string(gamma));
            compare(avenue().world, small_shipped_layout(name, 480), flying(gamma, true), test_quality(), gamma == 1);
        }
}

TEST(InsetGpuTest, LiveQualities)
{
    for (const std::string name : {"balanced", "draft", "fine"})
        for (const double gamma : {1.0, 4.0}) {
            SCOPED_TRACE(name + " " + std::to_string(gamma));
            const Quality quality = load_quality(starbow::testing::source_dir() / "config/qualities" / (name + ".json"));
            compare(avenue().world, shipped("desk"), flying(gamma, false), within(device(), quality), gamma == 1);
        }
}

TEST(InsetGpuTest, MovingBodies)
{
    for (const std::string name : {"twins-out", "twins-turn", "gamow-cycling", "train-far"}) {
        SCOPED_TRACE(name);
        const Shot ship = load_shot(starbow::testing::source_dir() / "config/shots" / (name + ".json"));
        const GpuWorld world = upload_scene(
            *GpuEnvironment::context, load_scene(starbow::testing::source_dir() / "config/scenes" / (ship.scene + ".json")));
        compare(world, small_shipped_layout("desk", 400), ship, test_quality(), false);
        device().device.waitIdle();
    }
}

TEST(InsetGpuTest, BesideAComparison)
{
    for (const Comparison comparison : {Comparison::galilean, Comparison::no_light_delay}) {
        Shot ship = flying(4, true);
        ship.effects.comparison = comparison;
        ship.effects.on.set(Effect::false_colours);
        compare(avenue().world, small_shipped_layout("desk", 400), ship, test_quality(), false);
    }
}

TEST(InsetGpuTest, ItFollowsEveryChangeOfTheFrame)
{
    // From rest to flight and back, through another quality, size and layout, and through a test pattern.
    const Layout layout = small_shipped_layout("desk", 400);
    OffscreenRenderer whole(device(), pipelines(), avenue().world, layout, test_quality(), false);
    whole.frame().repeatable(true);
    const auto shown = [&](const Shot& ship) {
        whole.frame().show_inset(starbow::inset_shot(ship, InsetView::doppler, 0), width);
        whole.picture(ship);
        return inset_of(whole);
    };
    const Shot resting = flying(1, true), fast = flying(4, true);
    const Bytes at_rest = shown(resting), in_flight = shown(fast);
    EXPECT_GT(steps(at_rest, in_flight).mean, 5);
    EXPECT_EQ(shown(resting), at_rest);
    Quality other = test_quality();
    other.cube_samples = 1;
    whole.frame().adopt(other);
    EXPECT_GT(steps(shown(fast), in_flight).most, 0);
    whole.frame().adopt(test_quality());
    EXPECT_EQ(shown(fast), in_flight);
    whole.frame().adopt(layout);
    EXPECT_EQ(shown(fast), in_flight);
    EXPECT_EQ(shown(resting), at_rest);
    whole.frame().show(Pattern::grid);
    whole.picture(resting);
    whole.frame().show(Pattern::none);
    EXPECT_EQ(shown(resting), at_rest);
    whole.frame().show_inset(starbow::inset_shot(fast, InsetView::doppler, 0), width / 2);
    whole.picture(fast);
    EXPECT_EQ(inset_of(whole).size(), in_flight.size() / 4);
    EXPECT_EQ(shown(fast), in_flight);
}

// At great gamma all the world is a patch of a few degrees: the telescope shows it as fine as a picture of its own would.
TEST(InsetGpuTest, TheTelescopeIsSharpAndTheLargePictureStays)
{
    const Layout layout = small_shipped_layout("desk", 400);
    for (const double gamma : {1.0, 4.0, 30.0, 100.0})
        for (const double look : {0.0, 0.4}) {
            const Shot ship = flying(gamma, true, look);
            const double fov_deg = telescope_fov_deg(u_of_gamma(gamma), 0);
            OffscreenRenderer whole(device(), pipelines(), avenue().world, layout, test_quality(), false);
            const Layout alone = one_view(Planar{fov_deg}, size);
            OffscreenRenderer own(device(), pipelines(), avenue().world, alone, test_quality(), false);
            OffscreenRenderer fine(device(), pipelines(), avenue().world, alone, reference_quality(), false);
            whole.frame().repeatable(true), own.frame().repeatable(true);
            const Shot event = at_eye(ship, whole.frame().views().probed_view().cube_m, layout.stereo, avenue().world.scene);
            const Bytes bare = whole.picture(ship)[0];
            whole.frame().show_inset(inset_shot(ship, InsetView::telescope, 0), width, fov_deg);
            const Bytes with = whole.picture(ship)[0], shown = inset_of(whole);
            const Shot through = inset_shot(event, InsetView::telescope, 0);
            if (gamma > 1) {
                EXPECT_NEAR((through.ship_from_cockpit * dvec3(0, 0, -1)).z, -1, 1e-9); // along the flight
            }
            const Bytes wanted = fine.picture(through)[0];
            const Steps off = steps(shown, wanted), apart = steps(own.picture(through)[0], wanted);
            std::printf("  gamma %g: %g degrees, %.2f steps from fine, its own picture %.2f; the large picture %.3f\n",
                gamma, fov_deg, off.mean, apart.mean, steps(bare, with).mean);
            // The images are cut for the large picture, too, and share its limit of texels: at gamma 100 that costs half of
            // the sharpness, below it costs nothing.
            EXPECT_LT(off.mean, (gamma > 50 ? 2.5 : 1.5) * apart.mean);
            EXPECT_LT(steps(bare, with).mean, 1);
        }
}

// Two that are compared: each is the picture that it would be alone, and the first may stay when the second goes.
TEST(InsetGpuTest, TwoInsetsAreTheSameAsEachAlone)
{
    const Layout layout = small_shipped_layout("desk", 400);
    const Shot ship = flying(2, true, 0);
    const Shot left = looking(ship, glm::normalize(dvec3(-0.3, 0.02, -1))),
               right = looking(ship, glm::normalize(dvec3(0.2, 0, -1)));
    OffscreenRenderer whole(device(), pipelines(), avenue().world, layout, test_quality(), false);
    whole.frame().repeatable(true);
    const auto alone = [&](const Shot& shot, double fov_deg) {
        whole.frame().drop_insets();
        whole.frame().show_inset(shot, width, fov_deg);
        whole.picture(ship);
        return inset_of(whole, 0);
    };
    const Bytes first = alone(left, 10), second = alone(right, 15);
    whole.frame().drop_insets();
    whole.frame().show_inset(left, width, 10, 0);
    whole.frame().show_inset(right, width, 15, 1);
    whole.picture(ship);
    // The plan of the common cube map serves both, so that a texel may lie elsewhere.
    EXPECT_LT(steps(inset_of(whole, 0), first).mean, 1.5);
    EXPECT_LT(steps(inset_of(whole, 1), second).mean, 1.5);
    EXPECT_GT(steps(first, second).mean, 4) << "they are two pictures";
    whole.frame().drop_insets(1);
    whole.picture(ship);
    EXPECT_LT(steps(inset_of(whole, 0), first).mean, 1.5);
}

} // namespace starbow::gpu_test::inset_gpu_test
