// llvmpipe takes a number that decides a branch for a constant and compiles the shader again for each draw, where that makes
// the shader much shorter, and keeps every copy until the pipeline's end (Mesa 22.3; shaders/shared.h has the remedy). This
// file stands in for a function of LLVM that starts each compilation, and counts.
#include "runtime/shadow/add_shadows.h"
#include "tests/support/gpu_environment.h"
#include <atomic>
#include <dlfcn.h>
#include <link.h>
#include <string_view>

namespace {

std::atomic<long> compilations = 0;

/// The library that the driver has loaded.
void* llvm()
{
    std::string path;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* to) {
            const bool found = std::string_view(info->dlpi_name).find("/libLLVM") != std::string_view::npos;
            if (found)
                *static_cast<std::string*>(to) = info->dlpi_name;
            return int(found);
        },
        &path);
    return path.empty() ? nullptr : dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
}

} // namespace

extern "C" [[gnu::visibility("default")]] void* LLVMModuleCreateWithNameInContext(const char* name, void* context)
{
    using Create = void* (*)(const char*, void*);
    static const Create create = reinterpret_cast<Create>(dlsym(llvm(), "LLVMModuleCreateWithNameInContext"));
    ++compilations;
    return create(name, context);
}

namespace starbow::gpu_test::recompiles_gpu_test {
namespace {

/// Worlds with several rest frames, passing lamps, blinking and animated bodies, clocks. The driver may compile whatever it
/// wants the first time, and nothing the second.
TEST(Recompiles, AFlightThatWasDrawnBeforeCompilesNothing)
{
    if (!device().on_processor())
        GTEST_SKIP() << "this driver does not compile by LLVM's C interface";
    for (const std::string name : {"gamow", "light-clock", "clocks"}) {
        SCOPED_TRACE(name);
        const SceneFile scene = load_scene_file(testing::source_dir() / "config/scenes" / (name + ".json"));
        World made = load_world(scene);
        add_shadows(made, scene, map_cache_folder());
        const GpuWorld world = upload(device(), pipelines(), std::move(made), scene, {});
        OffscreenRenderer offscreen(
            device(), pipelines(), world, one_view(Planar{60}, {48, 32}), default_quality(device(), false), false);
        const auto draw = [&](Comparison comparison, Overlay overlay, double at) {
            Shot shot = scene.start;
            shot.u = {0.1 * at, 0, -0.5 - 0.2 * at};
            shot.time += 0.3 * at;
            shot.effects.comparison = comparison;
            Measuring measuring;
            measuring.over.overlay = overlay;
            offscreen.frame().measure(measuring);
            offscreen.picture(shot);
        };
        const auto fly = [&] {
            for (int at = 0; at < 6; ++at)
                draw(Comparison::none, Overlay::off, at);
            for (int at = 0; at < 3; ++at)
                draw(Comparison::no_light_delay, Overlay::off, at);
            for (const Overlay overlay : {Overlay::aim, Overlay::grid, Overlay::distance})
                for (int at = 0; at < 3; ++at)
                    draw(Comparison::none, overlay, at);
        };
        fly();
        const long before = compilations;
        EXPECT_GT(before, 0) << "the count sees this driver's compilations";
        fly();
        EXPECT_EQ(compilations - before, 0);
    }
}

} // namespace
} // namespace starbow::gpu_test::recompiles_gpu_test
