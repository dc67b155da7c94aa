// A sky that was kept is the one that is painted, and a damaged file is none.
#include "runtime/world/sky_cache.h"
#include "tests/support/files.h"
#include "tests/support/gltf_fixture.h"
#include <random>

namespace starbow::gltf_test::sky_cache_test {
namespace {

using SkyCacheTest = GltfTest;

TEST_F(SkyCacheTest, AKeptSkyIsThePaintedOneAndADamagedFileIsPaintedAgain)
{
    const std::filesystem::path cache = folder / "cache";
    StarSky sky = *load_scene_file(starbow::testing::source_dir() / "config/scenes/avenue.json").stars;
    const std::filesystem::path catalogue = folder / "stars.txt";
    std::ofstream(catalogue) << "4567890 1234567 250 65 -\n100 -8900000 310 - -\n";
    sky.catalogue = catalogue;
    sky.in_depth = 0;
    const Texture painted = load_sky(sky, {});
    EXPECT_FALSE(std::filesystem::exists(cache));
    EXPECT_EQ(load_sky(sky, cache).rgba, painted.rgba);
    const auto files = [&] {
        std::vector<std::filesystem::path> all;
        for (const auto& entry : std::filesystem::directory_iterator(cache))
            all.push_back(entry.path());
        return all;
    };
    ASSERT_EQ(files().size(), 1u);
    const std::filesystem::path file = files()[0];
    const std::string whole = starbow::testing::read_text(file);
    EXPECT_EQ(load_sky(sky, cache).rgba, painted.rgba);

    // A texel that is changed together with the header's hash would be believed; a texel alone is not.
    std::mt19937 random(7);
    for (int n = 0; n < 3; ++n) {
        std::string damaged = whole;
        if (n == 0)
            damaged.resize(whole.size() - 1);
        else
            damaged[n == 1 ? random() % 40 : whole.size() / 2] ^= 4;
        starbow::testing::write_bytes(file, damaged);
        EXPECT_EQ(load_sky(sky, cache).rgba, painted.rgba) << n;
        EXPECT_EQ(starbow::testing::read_text(file), whole) << n;
    }

    // Other stars, another number of painted ones and another white have files of their own.
    std::ofstream(catalogue, std::ios::app) << "18000000 100 100 40 -\n";
    EXPECT_NE(load_sky(sky, cache).rgba, painted.rgba);
    sky.in_depth = 1;
    load_sky(sky, cache);
    sky.milky_way->peak_arcmin2 *= 2;
    load_sky(sky, cache);
    EXPECT_EQ(files().size(), 4u);

    const std::filesystem::path in_the_way = file / "none";
    EXPECT_EQ(load_sky(sky, in_the_way).size, painted.size) << "a folder that can't be made";
}

} // namespace
} // namespace starbow::gltf_test::sky_cache_test
