// A frame in the live loop allocates nothing. This file replaces operator new for all tests of this binary.
#include "tests/support/small_world.h"
#include <chrono>
#include <cstdlib>
#include <new>

namespace {

thread_local long* counted = nullptr; // not null while this thread's allocations are counted

}

// Not inline: otherwise GCC 12 warns that new and delete do not match.
[[gnu::noinline]] void* operator new(std::size_t size)
{
    if (counted)
        ++*counted;
    if (void* memory = std::malloc(size ? size : 1))
        return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace starbow::gpu_test::allocation_gpu_test {
namespace {

template <class Work> long allocations(Work&& work)
{
    long count = 0;
    counted = &count;
    work();
    counted = nullptr;
    return count;
}

/// A thousand objects are drawn on a flight of changing speed, as an exhibit draws them. The device has no validation
/// layers, because the count would include their allocations.
TEST(Allocations, AFrameTakesNothingFromTheHeap)
{
    Doc doc;
    const int grey = unlit(doc, {0.5, 0.5, 0.5});
    for (int i = 0; i < 1000; ++i)
        quad(doc, {i % 40 - 20.0, i / 40 - 12.0, -10.0 - i % 7}, {0.3, 0, 0}, {0, 0.3, 0}, grey);
    testing::write_text("thousand.gltf", doc.text());
    SceneFile file = load_scene_file(
        testing::write_text("thousand.json", Json{{"gltf", "thousand.gltf"}, {"unit_m", 1}, {"sky", smooth_sky}}.dump()));
    file.stars = avenue().world.scene.stars;
    Device quiet({.name = device_options(false).name});
    Pipelines quiet_pipelines(quiet);
    const GpuWorld world = upload(quiet, quiet_pipelines, load_world(file), file, stars_in_depth(*file.stars));
    OffscreenRenderer renderer(
        quiet, quiet_pipelines, world, one_view(Planar{60}, {320, 240}), default_quality(quiet, false), false);
    renderer.frame().repeatable(false); // as the exhibit flies: images only grow
    renderer.frame().meter(true);
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.effects = {};
    renderer.picture(shot);
    long prepare = 0, record = 0;
    double ms = 0;
    // Lists that are longer than ever before take memory once, for the last time in the second turn, as the flight goes on.
    constexpr int frames = 300, settled = 200;
    for (int i = 0; i < frames; ++i) {
        shot.u = {0, 0, -4 + 4 * std::cos(0.06 * i)};
        shot.position.z = -0.01 * i;
        const auto began = std::chrono::steady_clock::now();
        const long prepared = allocations([&] { renderer.frame().update(shot, nullptr); });
        ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count() / frames;
        long recorded = 0;
        quiet.now([&](vk::CommandBuffer commands) {
            const Target target = renderer.target(0);
            recorded = allocations([&] { renderer.frame().draw(commands, shot, nullptr, std::span(&target, 1)); });
        });
        if (i >= settled)
            prepare += prepared, record += recorded;
    }
    std::printf("  %.3f ms to prepare a frame of 1,000 objects\n", ms);
    EXPECT_EQ(prepare, 0) << "in a hundred frames";
    EXPECT_EQ(record, 0) << "in a hundred frames";
}

} // namespace
} // namespace starbow::gpu_test::allocation_gpu_test
