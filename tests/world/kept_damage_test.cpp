// Levels of detail and skies from a damaged file are those that are made without one, and the file is written again.
#include "runtime/world/detail.h"
#include "runtime/world/detail_cache.h"
#include "runtime/world/sky_cache.h"
#include "tests/support/damage.h"
#include "tests/support/gltf_fixture.h"

namespace starbow::gltf_test::kept_damage_test {
namespace {

using starbow::testing::for_each_damage, starbow::testing::read_text, starbow::testing::write_bytes;
using KeptDamageTest = GltfTest;

/// Everything that makes a world's levels, as bytes.
std::string levels_of(const World& world)
{
    std::string all;
    const auto add
        = [&](const auto&... values) { (all.append(reinterpret_cast<const char*>(&values), sizeof values), ...); };
    const auto add_level = [&](const DetailLevel& level) {
        add(level.first_index, level.index_count, level.error, level.shading, level.apart, level.clusters.first,
            level.clusters.count);
    };
    const auto add_group
        = [&](const PieceGroup& group) { add(group.low, group.high, group.error, group.shading, group.apart); };
    for (const std::uint32_t index : world.indices)
        add(index);
    for (const Cluster& cluster : world.clusters)
        add(cluster);
    for (const Primitive& primitive : world.primitives) {
        add(primitive.clusters.first, primitive.clusters.count, primitive.pieces.first, primitive.pieces.count);
        for (const DetailLevel& level : primitive.coarser)
            add_level(level);
    }
    for (const DetailPiece& piece : world.pieces) {
        add(piece.low, piece.high);
        add_level(piece.triangles), add_group(piece.own), add_group(piece.coarser);
    }
    return all;
}

/// A hilly square of triangles.
World hills(int side)
{
    World world;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            Vertex vertex{};
            vertex.position = {float(x), float(y), 0.02f * float((x * x + 3 * y) % 5)};
            vertex.normal = {0, 0, 1};
            world.vertices.push_back(vertex);
        }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto at = std::uint32_t(y * (side + 1) + x), above = std::uint32_t(at + std::uint32_t(side) + 1);
            for (const std::uint32_t index : {at, at + 1, above, at + 1, above + 1, above})
                world.indices.push_back(index);
        }
    world.materials.resize(1);
    Primitive primitive{};
    primitive.index_count = std::uint32_t(world.indices.size());
    primitive.material = 0;
    world.primitives.push_back(primitive);
    return world;
}

std::filesystem::path only_file(const std::filesystem::path& folder)
{
    return std::filesystem::directory_iterator(folder)->path();
}

TEST_F(KeptDamageTest, LevelsOfDetailAreMadeAgain)
{
    const std::filesystem::path cache = folder / "cache";
    const World bare = hills(6);
    World made = bare;
    add_detail_levels(made);
    ASSERT_FALSE(made.primitives[0].coarser.empty());
    World first = bare;
    ASSERT_TRUE(add_kept_detail_levels(first, cache, {}, 0));
    const std::filesystem::path file = only_file(cache);
    const std::string whole = read_text(file), right = levels_of(made);
    const std::uint64_t key = levels_key(bare);
    World untouched = bare;
    int count = 0;
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        EXPECT_FALSE(read_kept_levels(file, key, untouched)) << how;
        EXPECT_TRUE(untouched.pieces.empty() && untouched.clusters.empty() && untouched.primitives[0].coarser.empty()
            && untouched.indices == bare.indices)
            << how;
        if (++count % 997 != 0 && damaged.size() <= whole.size())
            return;
        World again = bare;
        EXPECT_TRUE(add_kept_detail_levels(again, cache, {}, 0)) << how;
        EXPECT_TRUE(levels_of(again) == right) << how;
        EXPECT_TRUE(read_text(file) == whole) << how;
    });
    write_bytes(file, whole);
    World last = bare;
    EXPECT_FALSE(add_kept_detail_levels(last, cache, {}, 0));
    EXPECT_TRUE(levels_of(last) == right);
}

TEST_F(KeptDamageTest, ASkyIsPaintedAgain)
{
    const std::filesystem::path cache = folder / "cache", catalogue = folder / "stars.txt", panorama = folder / "sky.png";
    StarSky sky = *load_scene_file(starbow::testing::source_dir() / "config/scenes/avenue.json").stars;
    Bytes texels;
    for (int i = 0; i < 8 * 4 * 4; ++i)
        texels.push_back(i % 4 == 3 ? 255 : std::uint8_t(7 * i));
    const Bytes picture = png(8, 4, texels);
    write_bytes(panorama, std::string(picture.begin(), picture.end()));
    std::ofstream(catalogue) << "4567890 1234567 250 65 -\n";
    sky.catalogue = catalogue, sky.milky_way->panorama = panorama;
    sky.in_depth = 1; // no star is painted, so that the picture stays small
    const Texture right = load_sky(sky, {});
    ASSERT_EQ(right.rgba.size(), 8u * 4 * 4);
    load_sky(sky, cache);
    const std::filesystem::path file = only_file(cache);
    const std::string whole = read_text(file);
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        const Texture again = load_sky(sky, cache);
        EXPECT_TRUE(again.size == right.size && again.rgba == right.rgba) << how;
        EXPECT_TRUE(read_text(file) == whole) << how;
    });
}

} // namespace
} // namespace starbow::gltf_test::kept_damage_test
