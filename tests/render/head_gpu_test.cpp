// A head that moves during the exhibit sees the same as in a layout with the eye there from the start.
#include "displays/projections/wall.h"
#include "tests/support/gpu_environment.h"

namespace head_gpu_test {

using namespace starbow;
using namespace starbow::gpu_test;

namespace {

const Wall wall{{-0.8, -0.6, -1}, {0.8, -0.6, -1}, {-0.8, 0.6, -1}};

Layout walled(const dvec3& eye_m, StereoMethod method, Packing packing = Packing::side_by_side)
{
    Layout layout = one_view(wall, {240, 90});
    layout.outputs[0].packing = packing;
    layout.outputs[0].viewports[0].eye_m = eye_m;
    layout.stereo = {.method = method, .separation_m = 0.065, .hyper_stereo = 1.5e8};
    return layout;
}

Shot flown() { return shot_at({0, 0, 1}, {0, 0, -u_of_gamma(2)}, {0, 0, -1}); }

std::vector<std::uint8_t> seen(const Layout& layout, const Head& head)
{
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    offscreen.frame().move_head(head);
    return offscreen.picture(flown())[0];
}

/// Counts RGBA8 pixels that differ by more than 2 of 255 in a channel, because the projections differ in their last bits.
int differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b)
{
    int count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        bool same = true;
        for (int c = 0; c < 3; ++c)
            same = same && std::abs(int(a[i + c]) - b[i + c]) <= 2;
        count += !same;
    }
    return count;
}

} // namespace

class HeadMethods : public ::testing::TestWithParam<StereoMethod> { };

TEST_P(HeadMethods, AMovedHeadEqualsAnEyeThere)
{
    const dvec3 by(0.25, -0.15, 0.3);
    const auto still = seen(walled(dvec3(0), GetParam()), {});
    const auto moved = seen(walled(dvec3(0), GetParam()), {by});
    const int pixels = 240 * 90;
    EXPECT_GT(differing(still, moved), pixels / 4); // the picture must change
    EXPECT_LE(differing(moved, seen(walled(by, GetParam()), {})), pixels / 1000);
}

TEST_P(HeadMethods, AHeadThatReturnsSeesTheFirstPicture)
{
    OffscreenRenderer offscreen = renderer(avenue().world, walled(dvec3(0), GetParam()), false);
    const auto before = offscreen.picture(flown())[0];
    offscreen.frame().move_head({dvec3(0.2, 0.1, -0.3), glm::angleAxis(0.7, dvec3(0, 1, 0))});
    (void)offscreen.picture(flown());
    offscreen.frame().move_head({});
    EXPECT_EQ(differing(before, offscreen.picture(flown())[0]), 0);
}

// Upside down, the right eye is at the left eye's place.
TEST_P(HeadMethods, ATurnedHeadTurnsItsEyes)
{
    const auto still = seen(walled(dvec3(0), GetParam()), {});
    const auto turned = seen(walled(dvec3(0), GetParam()), {dvec3(0), glm::angleAxis(M_PI, dvec3(0, 0, 1))});
    std::vector<std::uint8_t> exchanged(still.size());
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 240; ++x)
            for (int c = 0; c < 4; ++c)
                exchanged[4 * (240 * y + x) + c] = still[4 * (240 * y + (x + 120) % 240) + c];
    EXPECT_GT(differing(still, exchanged), 1000); // the eyes see different pictures
    EXPECT_LE(differing(turned, exchanged), 240 * 90 / 1000);
}

INSTANTIATE_TEST_SUITE_P(
    Stereo, HeadMethods, ::testing::Values(StereoMethod::shared, StereoMethod::exact, StereoMethod::reprojected));

// A head behind a wall's plane leaves the view as it was.
TEST(HeadTest, BehindAWallTheViewStaysAsItWas)
{
    Layout layout = one_view(wall, {120, 90});
    const auto still = seen(layout, {});
    const auto behind = seen(layout, {dvec3(0, 0, -1.5)}); // half a metre behind the wall
    EXPECT_EQ(still.size(), behind.size());
    EXPECT_EQ(differing(still, behind), 0) << "the world is light-seconds large: 1.5 m change nothing in it";
}

} // namespace head_gpu_test
