// The small picture is warped from the cube map of the frame's own views. It must be the picture of its own shot, and the
// frame's own picture must stay.
#include "config/model/beside.h"
#include "shaders/physics/physics.h"
#include "tests/support/small_world.h"
#include <algorithm>

namespace starbow::gpu_test::inset_gpu_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::array kinds = {Beside::at_rest, Beside::aberration, Beside::doppler, Beside::headlight};
constexpr int width = 160;
constexpr ivec2 size(width, int(width* Inset::aspect));

Bytes inset_of(OffscreenRenderer& whole)
{
    const Image& picture = whole.frame().inset_picture();
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

/// Errors of a picture in steps of 255.
struct Errors {
    double mean = 0, rms = 0;
    int worst = 0;
    double beyond = 0; ///< the part of all pixels that differ by more than 24 steps: edges beside their place
};
Errors errors(const Bytes& a, const Bytes& b)
{
    Errors sum;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int off = std::abs(int(a[i + c]) - int(b[i + c]));
            sum.mean += off, sum.rms += double(off) * off;
            worst = std::max(worst, off);
        }
        sum.worst = std::max(sum.worst, worst);
        sum.beyond += worst > 24;
    }
    const double count = 0.75 * double(a.size());
    sum.mean /= count, sum.rms = std::sqrt(sum.rms / count), sum.beyond /= 0.25 * double(a.size());
    return sum;
}

/// The shot's event for an eye at a place of the cockpit, metres.
Shot at_eye(Shot shot, const dvec3& eye_m, double hyper_stereo, double unit_m)
{
    const dvec3 offset = shot.ship_from_cockpit * (eye_m * (hyper_stereo / unit_m));
    shot.position += physics::eye_place(shot.u, offset);
    shot.time += physics::eye_time(shot.u, offset);
    return shot;
}

Layout shipped(const std::string& name)
{
    return load_layout(starbow::testing::source_dir() / "config/layouts" / (name + ".json"));
}

/// A shipped layout with small outputs.
Layout small(const std::string& name, int longest)
{
    Layout layout = shipped(name);
    for (Output& output : layout.outputs) {
        const double part = double(longest) / std::max(output.size.x, output.size.y);
        output.size = ivec2(dvec2(output.size) * part);
    }
    return layout;
}

/// The small picture in flight beside that of its own shot, drawn alone: both are compared with a fine one.
void compare(const GpuWorld& world, const Layout& layout, Shot ship, const Quality& quality, double more_mean)
{
    OffscreenRenderer whole(device(), pipelines(), world, layout, quality, false);
    const Layout alone = one_view(Planar{Inset::fov_y_deg}, size);
    OffscreenRenderer own(device(), pipelines(), world, alone, quality, false);
    OffscreenRenderer fine(device(), pipelines(), world, alone, reference_quality(), false);
    for (OffscreenRenderer* one : {&whole, &own})
        one->frame().repeatable(true);
    const std::vector<Bytes> bare = whole.picture(ship);
    for (const Beside kind : kinds) {
        const Shot shot = starbow::beside(ship, kind, 0.5);
        whole.frame().show_inset(shot, width);
        const std::vector<Bytes> with = whole.picture(ship);
        int changed = 0, most = 0;
        for (std::size_t output = 0; output < bare.size(); ++output)
            for (std::size_t i = 0; i < bare[output].size(); ++i) {
                const int off = std::abs(int(bare[output][i]) - int(with[output][i]));
                changed += off > 0, most = std::max(most, off);
            }
        EXPECT_LE(most, 3);
        std::printf("changed %d most %d  ", changed, most);
        const Bytes shared = inset_of(whole);
        const ViewState& first = whole.frame().views().probed_view();
        Shot event = at_eye(ship, first.cube_m, layout.stereo.hyper_stereo, world.scene.unit_m);
        event = starbow::beside(event, kind, 0.5);
        const Bytes wanted = fine.picture(event)[0], apart = own.picture(event)[0];
        const Errors now = errors(shared, wanted), before = errors(apart, wanted);
        SCOPED_TRACE(std::string(name_of(kind)) + ": mean " + std::to_string(now.mean) + " beside "
            + std::to_string(before.mean) + ", rms " + std::to_string(now.rms) + " beside " + std::to_string(before.rms)
            + ", beyond " + std::to_string(now.beyond) + " beside " + std::to_string(before.beyond));
        std::printf("%-11s mean %.3f / %.3f  rms %.2f / %.2f  beyond %.4f / %.4f  worst %d / %d\n", name_of(kind), now.mean,
            before.mean, now.rms, before.rms, now.beyond, before.beyond, now.worst, before.worst);
        EXPECT_LE(now.mean, before.mean + more_mean);
    }
}

} // namespace

TEST(InsetGpuTest, TheAvenueAtEverySpeed)
{
    for (const double gamma : {1.0, 1.1, 4.0, 100.0})
        for (const bool coloured : {false, true})
            for (const double look : {0.0, 0.6, 3.0}) {
                Shot ship = shot_at({0.3, 0.1, -8}, {0, 0, -u_of_gamma(gamma)}, {std::sin(look), 0.05, -std::cos(look)});
                ship.effects.doppler = ship.effects.headlight = coloured;
                ship.exposure_ev = coloured && gamma > 10 ? -8 : 0;
                SCOPED_TRACE(std::to_string(gamma) + " " + std::to_string(look));
                std::printf("gamma %g, looks %g, coloured %d\n", gamma, look, coloured);
                compare(avenue().world, small("desk", 400), ship, test_quality(), 0.5);
            }
}

TEST(InsetGpuTest, EveryLayout)
{
    Shot ship = shot_at({0.3, 0.1, -8}, {0, 0, -u_of_gamma(4)});
    ship.effects.doppler = ship.effects.headlight = true;
    for (const std::string name : {"desk", "dome", "stereo", "headset", "alice-bob"}) {
        std::printf("%s\n", name.c_str());
        SCOPED_TRACE(name);
        compare(avenue().world, small(name, 480), ship, test_quality(), 0.5);
    }
}

TEST(InsetGpuTest, LiveQualities)
{
    Shot ship = shot_at({0.3, 0.1, -8}, {0, 0, -u_of_gamma(4)});
    for (const std::string name : {"balanced", "draft", "fine"}) {
        std::printf("%s\n", name.c_str());
        SCOPED_TRACE(name);
        const Quality quality = load_quality(starbow::testing::source_dir() / "config/qualities" / (name + ".json"));
        compare(avenue().world, shipped("desk"), ship, within(device(), quality), 0.5);
    }
}

TEST(InsetGpuTest, MovingBodies)
{
    for (const std::string name : {"twins-out", "twins-turn", "gamow-cycling", "train-far"}) {
        std::printf("%s\n", name.c_str());
        SCOPED_TRACE(name);
        Shot ship = load_shot(starbow::testing::source_dir() / "config/shots" / (name + ".json"));
        const GpuWorld world = upload_scene(
            *GpuEnvironment::context, load_scene(starbow::testing::source_dir() / "config/scenes" / (ship.scene + ".json")));
        compare(world, small("desk", 400), ship, test_quality(), 0.5);
        device().device.waitIdle();
    }
}

TEST(InsetGpuTest, BesideAComparison)
{
    for (const Comparison comparison : {Comparison::galilean, Comparison::no_light_delay}) {
        Shot ship = shot_at({0.3, 0.1, -8}, {0, 0, -u_of_gamma(4)});
        ship.effects.comparison = comparison;
        ship.effects.false_colours = true;
        std::printf("comparison %d\n", int(comparison));
        compare(avenue().world, small("desk", 400), ship, test_quality(), 0.5);
    }
}

} // namespace starbow::gpu_test::inset_gpu_test
