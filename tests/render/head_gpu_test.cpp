// A head that moves while the exhibit flies sees what a layout with the head there from the start shows.
#include "displays/projections/wall.h"
#include "tests/support/stage.h"

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
    OffscreenRenderer stage = renderer(avenue().world, layout, false);
    stage.frame().move_head(head);
    return stage.picture(flown())[0];
}

/// How many of the RGBA8 pixels differ by more than 2 of 255 in a channel: the projections differ in their last bits.
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

TEST_P(HeadMethods, AMovedHeadIsAnotherEye)
{
    const dvec3 by(0.25, -0.15, 0.3);
    const auto still = seen(walled(dvec3(0), GetParam()), {});
    const auto moved = seen(walled(dvec3(0), GetParam()), {by});
    const int pixels = 240 * 90;
    EXPECT_GT(differing(still, moved), pixels / 4); // it moved at all
    EXPECT_LE(differing(moved, seen(walled(by, GetParam()), {})), pixels / 1000);
}

TEST_P(HeadMethods, AMovedHeadGoesBack)
{
    OffscreenRenderer stage = renderer(avenue().world, walled(dvec3(0), GetParam()), false);
    const auto before = stage.picture(flown())[0];
    stage.frame().move_head({dvec3(0.2, 0.1, -0.3), glm::angleAxis(0.7, dvec3(0, 1, 0))});
    (void)stage.picture(flown());
    stage.frame().move_head({});
    EXPECT_EQ(differing(before, stage.picture(flown())[0]), 0);
}

// Upside down, the right eye is where the left was.
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

// A visitor who walks around behind a wall's plane leaves it as it was; the others go on.
TEST(HeadTest, BehindAWallItStaysAsItWas)
{
    Layout layout = one_view(wall, {120, 90});
    const auto still = seen(layout, {});
    const auto behind = seen(layout, {dvec3(0, 0, -1.5)}); // half a metre behind
    EXPECT_EQ(still.size(), behind.size());
    EXPECT_EQ(differing(still, behind), 0) << "the world is light-seconds large: 1.5 m are nothing in it";
}
