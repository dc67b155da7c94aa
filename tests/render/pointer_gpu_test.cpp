// The guide's pointer in the picture: a ring of its size around its direction on a flat screen and on a dome, and nothing
// else.
#include "runtime/hud/pointer_ring.h"
#include "tests/support/gpu_environment.h"

namespace starbow::gpu_test::pointer_gpu_test {

TEST(PointerPicture, TheRingLiesAroundItsDirection)
{
    for (const auto& [projection, of] :
        {std::pair<Projection, ivec2>{Planar{60}, {640, 480}}, {Fisheye{180, 30}, {512, 512}}}) {
        OffscreenRenderer whole = renderer(avenue().world, one_view(projection, of), false);
        const Shot shot = shot_at({0, 0, -20}, {0, 0, -u_of_gamma(2.5)});
        const auto bare = whole.picture(shot)[0];
        const double degree_px = 8;
        const Panel ring = draw_pointer(1, degree_px);
        // Directions in which a flat screen stretches little: there its ring is as round as the screen shows any.
        for (const dvec3& to : {dvec3(0, 0, -1), dvec3(0.12, 0.08, -1), dvec3(-0.1, -0.12, -1)}) {
            const dvec3 towards = glm::normalize(to);
            const dvec2 half = 0.5 * dvec2(ring.size) * std::tan(glm::radians(1.0)) / degree_px;
            const Callout callout{.letters = &ring, .place = whole.frame().views().place_at(towards, half)};
            whole.frame().place({&callout, 1});
            const auto shown = whole.picture(shot)[0];
            double nearest = 1e9, farthest = 0, brightest = 0, at_deg = 0;
            int count = 0;
            for (int y = 0; y < of.y; ++y)
                for (int x = 0; x < of.x; ++x) {
                    const std::size_t i = 4 * (std::size_t(y) * of.x + x);
                    if (std::equal(bare.begin() + std::ptrdiff_t(i), bare.begin() + std::ptrdiff_t(i) + 3,
                            shown.begin() + std::ptrdiff_t(i)))
                        continue;
                    const auto direction = whole.frame().views().direction(0, dvec2(x, y) + 0.5);
                    ASSERT_TRUE(direction);
                    const double off_deg = glm::degrees(between(*direction, towards));
                    nearest = std::min(nearest, off_deg), farthest = std::max(farthest, off_deg);
                    if (shown[i] > brightest)
                        brightest = shown[i], at_deg = off_deg;
                    ++count;
                }
            EXPECT_GT(count, 30);
            EXPECT_GT(nearest, 0.5); // it is hollow, so that the thing is seen
            EXPECT_LT(farthest, 0.5 * pointer_deg + 0.5 + 0.4); // its soft edge, and a pixel of the dome
            EXPECT_NEAR(at_deg, 0.5 * pointer_deg - 0.15, 0.4);
            EXPECT_GT(brightest, 180);
        }
    }
}

} // namespace starbow::gpu_test::pointer_gpu_test
