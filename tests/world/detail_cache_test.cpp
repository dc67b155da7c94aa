// Levels of detail that were kept are those that are made.
#include "config/model/shipped.h"
#include "runtime/world/detail.h"
#include "runtime/world/detail_cache.h"
#include "tests/support/files.h"
#include "tests/support/gltf_fixture.h"

namespace starbow::gltf_test::detail_cache_test {
namespace {

using DetailCacheTest = GltfTest;

void expect_equal(const World& a, const World& b)
{
    ASSERT_EQ(a.indices, b.indices);
    ASSERT_EQ(a.clusters.size(), b.clusters.size());
    for (std::size_t i = 0; i < a.clusters.size(); ++i)
        ASSERT_EQ(std::memcmp(&a.clusters[i], &b.clusters[i], sizeof(Cluster)), 0);
    ASSERT_EQ(a.primitives.size(), b.primitives.size());
    for (std::size_t i = 0; i < a.primitives.size(); ++i) {
        const Primitive &one = a.primitives[i], &other = b.primitives[i];
        ASSERT_EQ(one.clusters.first, other.clusters.first);
        ASSERT_EQ(one.clusters.count, other.clusters.count);
        ASSERT_EQ(one.coarser.size(), other.coarser.size());
        for (std::size_t k = 0; k < one.coarser.size(); ++k) {
            const DetailLevel &level = one.coarser[k], &same = other.coarser[k];
            ASSERT_EQ(level.first_index, same.first_index);
            ASSERT_EQ(level.index_count, same.index_count);
            ASSERT_EQ(level.error, same.error);
            ASSERT_EQ(level.shading, same.shading);
            ASSERT_EQ(level.apart, same.apart);
            ASSERT_EQ(level.clusters.first, same.clusters.first);
            ASSERT_EQ(level.clusters.count, same.clusters.count);
        }
    }
}

std::vector<std::filesystem::path> kept_in(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
    return files;
}

TEST_F(DetailCacheTest, KeptLevelsAreTheMadeOnes)
{
    const char* file = starbow::testing::all_cases() ? "scenes/twins/twins.glb" : "scenes/light-clock/light-clock.glb";
    const World bare = load_world(starbow::testing::source_dir() / file);
    World made = bare;
    double part = 0;
    add_detail_levels(made, [&](double done) {
        EXPECT_GE(done, part);
        EXPECT_LE(done, 1);
        part = done;
    });
    EXPECT_GT(part, 0.5);
    ASSERT_FALSE(made.clusters.empty());
    World first = bare, second = bare, none = bare, small = bare;
    EXPECT_TRUE(add_kept_detail_levels(first, folder, {}, 0));
    expect_equal(first, made);
    ASSERT_EQ(kept_in(folder).size(), 1u);
    EXPECT_FALSE(add_kept_detail_levels(second, folder, {}, 0));
    expect_equal(second, made);
    EXPECT_FALSE(add_kept_detail_levels(none, {}, {}, 0));
    expect_equal(none, made);
    EXPECT_FALSE(add_kept_detail_levels(small, folder, {}, bare.indices.size() + 1));
    EXPECT_EQ(kept_in(folder).size(), 1u);
    World missing = bare;
    const std::filesystem::path in_the_way = kept_in(folder).at(0) / "none";
    EXPECT_FALSE(add_kept_detail_levels(missing, in_the_way, {}, 0)) << "a folder that can't be made";
    expect_equal(missing, made);
    // Another world has another file.
    World other = bare;
    other.vertices[0].position.x += 1e-3f;
    EXPECT_TRUE(add_kept_detail_levels(other, folder, {}, 0));
    EXPECT_EQ(kept_in(folder).size(), 2u);
}

} // namespace
} // namespace starbow::gltf_test::detail_cache_test
