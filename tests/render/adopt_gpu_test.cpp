// A change that the device has no room for leaves the renderer as it was.
#include "config/json/error.h"
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

} // namespace starbow::gpu_test::adopt_gpu_test
