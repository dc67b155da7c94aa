// The stars' glare in shown pictures against rays, which add it up by themselves: on every kind of display, at rest and in
// flight, for one eye and for two; one sky on every display; and none in what is measured.
#include "config/model/angles.h"
#include "runtime/images/picture_errors.h"
#include "runtime/light/srgb.h"
#include "runtime/reference/reference.h"
#include "tests/support/small_world.h"

namespace starbow::gpu_test::glare_gpu_test {
namespace {

/// A star of a magnitude in the world's direction n.
Star star_at(const dvec3& n, double magnitude, double temperature_K = 5772)
{
    return {glm::transpose(world_from_equatorial({0, 0})) * glm::normalize(n), magnitude, temperature_K};
}

const Json stars_member{{"catalogue", "none.txt"}, {"brightness_arcmin2", 500}};

/// A world of nothing but stars; a square lies below.
struct StarWorld {
    explicit StarWorld(const std::vector<Star>& stars)
        : stars_(stars)
    {
        Doc doc;
        quad(doc, {0, -50, 0}, {1e-4, 0, 0}, {0, 0, -1e-4}, unlit(doc, {0, 0, 0}));
        Json sky = stars_member;
        sky["catalogue"] = testing::write_text("few_stars.txt", "0 0 3000 65 -\n").string();
        world.emplace(open_world("glare", doc, {{"stars", sky}}));
        put_stars(*world, stars);
        rays = open_reference_world(testing::scratch("glare.json"));
    }
    ReferenceInput input() const { return {rays.world, rays.scene, stars_}; }

    std::optional<GpuWorld> world;
    ReferenceWorld rays;

private:
    std::vector<Star> stars_;
};

const std::vector<Star> few = {star_at({0, 0, -1}, -1.5, 9900), star_at({0.2, 0.1, -1}, 0, 9600),
    star_at({-0.25, 0.05, -1}, 0.5, 3600), star_at({-0.1, -0.2, -1}, 2, 12000), star_at({0.3, -0.15, -1}, 4),
    star_at({0.1, 0.25, -1}, 5.5), star_at({0.103, 0.25, -1}, 1)};

TEST(Glare, PicturesAreThoseOfTheRaysOnEveryDisplay)
{
    StarWorld sky(few);
    Lens lens;
    lens.colours[0].k = {0.10, 0.02, 0, 0};
    lens.colours[1].k = {0.12, 0.02, 0, 0};
    lens.colours[2].k = {0.14, 0.02, 0, 0};
    struct Case {
        const char* name;
        Projection projection;
        ivec2 size;
    };
    for (const Case& display : {Case{"planar", Planar{60}, {320, 240}}, {"telescope", Planar{8}, {240, 240}},
             {"fisheye", Fisheye{180, 0}, {400, 400}}, {"equirectangular", Equirectangular{}, {480, 240}},
             {"cylinder", Cylinder{}, {480, 153}}, {"cube", CubeFaces{}, {1200, 200}}, {"lens", lens, {300, 300}}})
        for (const double beta : {0.0, 0.8})
            for (const double ev : {0.0, 5.0}) {
                const Layout layout = one_view(display.projection, display.size);
                Shot shot = shot_at({0, 0, 0}, u_of_beta(beta) * dvec3(0, 0, -1), {0, 0, -1});
                shot.effects = {};
                shot.exposure_ev = ev;
                OffscreenRenderer live = renderer(*sky.world, layout);
                const auto drawn = live.picture(shot)[0];
                const Reference truth = reference(sky.input(), layout, shot, 0, {.samples = 1});
                const auto right = shown(truth);
                ASSERT_EQ(drawn.size(), right.size());
                int most = 0, lit = 0;
                for (std::size_t i = 0; i < drawn.size(); ++i) {
                    // Live glare ends before the edge of a cube's face; it goes on across it in the rays' picture.
                    const bool faces = std::holds_alternative<CubeFaces>(display.projection);
                    const int more = int(drawn[i]) - int(right[i]), off = faces ? std::max(more, 0) : std::abs(more);
                    most = std::max(most, off), lit += right[i] > 4 && i % 4 == 0;
                }
                std::printf(
                    "  %-16s beta %.1f, EV %g: %d pixels lit, at most %d of 255 apart\n", display.name, beta, ev, lit, most);
                EXPECT_GT(lit, 20) << display.name;
                EXPECT_LE(most, 3) << display.name << ' ' << beta << ' ' << ev; // of rounding and fp16
            }
}

/// The linear light of a picture at an angle beside the middle, by the inverse of the tone curve's straight part.
double light_beside(const std::vector<std::uint8_t>& bytes, const Layout& layout, double angle_deg)
{
    const ivec2 size = layout.outputs[0].size;
    const auto* planar = std::get_if<Planar>(&layout.outputs[0].viewports[0].projection);
    const double off = planar ? std::tan(angle_deg * degree) / std::tan(0.5 * planar->fov_y_deg * degree) * 0.5 * size.y
                              : angle_deg / 180 * size.y;
    const double at = 0.5 * size.x + off - 0.5;
    const auto pixel = [&](int x) {
        return light_of_srgb(bytes[4 * (std::size_t(size.y / 2) * std::size_t(size.x) + std::size_t(x)) + 1] / 255.0);
    };
    return std::lerp(pixel(int(at)), pixel(int(at) + 1), at - std::floor(at));
}

// A desk, a fine desk and a dome show one star's glow as bright at the same angle.
TEST(Glare, IsAsWideOnEveryDisplay)
{
    StarWorld sky({star_at({0, 0, -1}, -1.5)});
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.exposure_ev = 4;
    const auto beside = [&](const Projection& projection, ivec2 size, double angle_deg) {
        const Layout layout = one_view(projection, size);
        OffscreenRenderer live = renderer(*sky.world, layout);
        return light_beside(live.picture(shot)[0], layout, angle_deg);
    };
    for (const double angle : {0.8, 1.5}) {
        const double desk = beside(Planar{45}, {800, 600}, angle), fine = beside(Planar{45}, {1600, 1200}, angle),
                     dome = beside(Fisheye{180, 90}, {2048, 2048}, angle);
        std::printf("  at %.1f degrees: desk %.4f, fine desk %.4f, dome %.4f of white\n", angle, desk, fine, dome);
        EXPECT_GT(desk, 0.01);
        EXPECT_NEAR(fine / desk, 1, 0.1); // the last glow before its end is counted off, and a pixel is 0.05 degrees
        EXPECT_NEAR(dome / desk, 1, 0.1);
    }
}

TEST(Glare, MeasuredLightHasNone)
{
    StarWorld sky({star_at({0, 0, -1}, -3)});
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.exposure_ev = 6;
    const Layout layout = one_view(Planar{20}, {120, 120});
    OffscreenRenderer live = renderer(*sky.world, layout);
    const Numbers numbers(live, shot);
    const Channels rays = channels(reference(sky.input(), layout, shot, 0, {.samples = 1}));
    int lit = 0;
    for (int i = 0; i < numbers.count(); ++i) {
        lit += numbers.light(i).g > 0;
        EXPECT_NEAR(numbers.light(i).g, rays[1].second[std::size_t(i)], 0.003 * numbers.light(i).g + 1e-9);
    }
    EXPECT_LE(lit, 16);
}

} // namespace
} // namespace starbow::gpu_test::glare_gpu_test
