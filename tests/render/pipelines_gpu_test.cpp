// Pipelines that no frame uses are released beyond a bound, and the device gives their memory back. Those of an earlier
// start come from a whole file alone.
#include "tests/support/damage.h"
#include "tests/support/effects.h"
#include "tests/support/small_world.h"
#include <cstdlib>
#include <fstream>
#include <unistd.h>

namespace starbow::gpu_test::pipelines_gpu_test {
namespace {

/// The memory of this process that is in use, bytes.
double resident()
{
    long all = 0, pages = 0;
    std::ifstream("/proc/self/statm") >> all >> pages;
    return double(pages) * double(sysconf(_SC_PAGESIZE));
}

/// A visitor's effects, one after another, again and again, as a loop of frames draws them. The device has no validation
/// layers, because they have a memory of their own.
TEST(Pipelines, StayWithinTheirBoundAndSoDoesTheMemory)
{
    Device quiet({.name = device_options(false).name});
    Pipelines own(quiet);
    Doc doc;
    quad(doc, {0, 0, -10}, {3, 0, 0}, {0, 3, 0}, unlit(doc, {0.5, 0.5, 0.5}));
    testing::write_text("grey.gltf", doc.text());
    const SceneFile file = load_scene_file(
        testing::write_text("grey.json", Json{{"gltf", "grey.gltf"}, {"unit_m", 1}, {"sky", smooth_sky}}.dump()));
    const GpuWorld world = upload(quiet, own, load_world(file), file, {});
    OffscreenRenderer renderer(quiet, own, world, one_view(Planar{60}, {32, 24}), default_quality(quiet, false), false);
    Shot shot = shot_at({0, 0, 0}, {0, 0, 0}, {0, 0, -1});
    shot.u = {0, 0, -2}; // at rest no effect shows, and none needs a pipeline
    constexpr std::size_t most = 4;
    const auto fly_round = [&] {
        for (int off = 0; off < 4; ++off) {
            shot.effects = testing::effects_of(!(off & 1), !(off & 2), !(off & 4));
            own.release_old(most);
            renderer.picture(shot);
            EXPECT_LE(own.kept(), most + 3) << "before the next turn the frame's new ones come on top";
        }
    };
    fly_round();
    const std::size_t made = own.count();
    const double settled = resident();
    for (int round = 0; round < 2; ++round)
        fly_round();
    // A frame uses the pipelines of the cube map and of the view; the view's are the effects'.
    EXPECT_GE(own.count(), made + 2 * 3) << "the effects need more pipelines than are kept";
    std::printf("%zu pipelines made, %zu kept; memory %.1f MB, then %.1f MB\n", own.count(), own.kept(), settled / 1e6,
        resident() / 1e6);
    EXPECT_LT(resident(), 1.01 * settled);
}

TEST(Pipelines, OfADamagedFileNoneReachesTheDriver)
{
    const std::filesystem::path folder = testing::scratch("pipelines-cache");
    const char* const set = std::getenv("STARBOW_CACHE");
    const std::string before = set ? set : "";
    setenv("STARBOW_CACHE", folder.c_str(), 1);
    EXPECT_TRUE(kept_pipelines(device().properties).empty());
    device().save_pipelines();
    const std::filesystem::path file = std::filesystem::directory_iterator(folder)->path();
    const std::string whole = testing::read_text(file);
    const std::vector<std::uint8_t> right = device().cache.getData();
    EXPECT_FALSE(right.empty());
    EXPECT_TRUE(kept_pipelines(device().properties) == right);
    testing::for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        testing::write_bytes(file, damaged);
        EXPECT_TRUE(kept_pipelines(device().properties).empty()) << how;
    });
    // A start with a damaged file writes it again.
    Device({.name = device_options(false).name}).save_pipelines();
    EXPECT_FALSE(kept_pipelines(device().properties).empty());
    before.empty() ? unsetenv("STARBOW_CACHE") : setenv("STARBOW_CACHE", before.c_str(), 1);
}

} // namespace
} // namespace starbow::gpu_test::pipelines_gpu_test
