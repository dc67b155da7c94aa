#include "gpu_environment.h"
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace starbow::gpu_test {
namespace {

::testing::Environment* const gpu_environment = ::testing::AddGlobalTestEnvironment(new GpuEnvironment);

} // namespace

void GpuEnvironment::SetUp()
{
#ifdef __GLIBC__
    // A software device allocates with malloc. Memory filled with 0x7e is NaN in fp16 and 8e37 in float, so that a read
    // of memory that was never written shows in the picture.
    mallopt(M_PERTURB, 0x81);
#endif
    context = std::make_unique<RenderContext>(testing::source_dir() / "config/scenes/avenue.json",
        Device::Options{.validation = true, .name = device_options(false).name});
}

void GpuEnvironment::TearDown()
{
    if (!context)
        return;
    context->device.device.waitIdle();
    expect_no_complaints(context->device);
    context.reset();
}

void GpuEnvironment::expect_no_complaints(const Device& device)
{
    for (const std::string& complaint : device.complaints)
        ADD_FAILURE() << "validation: " << complaint;
}

WithoutStars::WithoutStars() { put_stars(avenue().world, {}); }
WithoutStars::~WithoutStars() { put_stars(avenue().world, stars_in_depth(*avenue().world.scene.stars)); }

Quality test_quality()
{
    return within(
        device(), {.texels_per_pixel = 1.25, .max_texels_per_pixel = 8, .cube_samples = 4, .lod_shading_texels = 2});
}

OffscreenRenderer renderer(const GpuWorld& world, const Layout& layout, bool measured)
{
    return OffscreenRenderer(device(), pipelines(), world, layout, test_quality(), measured);
}

const std::vector<float>& Numbers::channel(const std::string& name) const
{
    for (const auto& [own, values] : channels)
        if (own == name)
            return values;
    throw std::runtime_error("no channel " + name);
}

} // namespace starbow::gpu_test
