// A change that the device has no room for leaves the renderer as it was.
#include "config/json/error.h"
#include "runtime/render/pass_timer.h"
#include "tests/support/gpu_environment.h"

namespace starbow::gpu_test::adopt_gpu_test {

// A picture wider than the device allows fails in the middle of making the views' objects, as a lack of memory does.
TEST(Adopt, AFailedChangeLeavesThePictureAsItWas)
{
    // Its map of directions is an image on the device.
    Layout layout = one_view(Fisheye{180, 20}, {96, 96});
    OffscreenRenderer offscreen = renderer(avenue().world, layout, false);
    const Shot shot = shot_at({0, 0, 0}, {0, 0, -1}, {0, 0, -1});
    const auto before = offscreen.picture(shot);
    const int most = int(device().properties.limits.maxImageDimension2D);
    for (int attempt = 0; attempt < 2; ++attempt) {
        EXPECT_THROW(offscreen.frame().resize(0, {most + 2, 8}), InputError);
        EXPECT_EQ(offscreen.picture(shot), before);
    }
}

// The images grow with the largest plan; given back, they are as large as a new renderer's, and so is the picture.
TEST(Adopt, ReleasedImagesAreThoseOfTheNextPlan)
{
    const Layout layout = one_view(Planar{60}, {160, 120});
    const Shot shot = shot_at({0, 0, 0}, {0, 0, -1}, {0, 0, -1});
    Quality coarse = test_quality(), fine = coarse;
    coarse.texels_per_pixel = 0.5, coarse.max_texels_per_pixel = 1, fine.texels_per_pixel = 3;
    OffscreenRenderer offscreen(device(), pipelines(), avenue().world, layout, coarse, false);
    const auto small = offscreen.picture(shot);
    const vk::DeviceSize before = offscreen.frame().memory();
    offscreen.frame().repeatable(false); // as in an exhibit
    offscreen.frame().adopt(fine);
    PassTimer(device(), offscreen).frame(shot);
    const vk::DeviceSize grown = offscreen.frame().memory();
    EXPECT_GT(grown, before + before / 4);
    offscreen.frame().adopt(coarse);
    PassTimer(device(), offscreen).frame(shot);
    EXPECT_EQ(offscreen.frame().memory(), grown);
    offscreen.frame().release_images();
    PassTimer(device(), offscreen).frame(shot);
    EXPECT_EQ(offscreen.frame().memory(), before);
    offscreen.frame().repeatable(true);
    EXPECT_EQ(offscreen.picture(shot), small);
}

} // namespace starbow::gpu_test::adopt_gpu_test
