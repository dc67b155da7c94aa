// A kept direction map is the one that was compiled, or none.
#include "displays/compile/map_cache.h"
#include "tests/support/damage.h"

namespace map_cache_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

TEST(MapCache, NothingOfADamagedFileIsShown)
{
    const std::filesystem::path file = scratch("one.map");
    for (const int channels : {1, 3})
        for (const bool masked : {false, true}) {
            DirectionMap made;
            made.size = {3, 2}, made.channels = channels;
            for (int i = 0; i < 6 * channels; ++i)
                made.texels.emplace_back(0.1f * float(i), -1, 0.5f, i % 2);
            for (int i = 0; masked && i < 6; ++i)
                made.intensity.push_back(0.2f * float(i));
            ASSERT_TRUE(write_kept_map(file, 9, made));
            const auto kept = read_kept_map(file, 9, made.size);
            ASSERT_TRUE(kept);
            EXPECT_TRUE(kept->size == made.size && kept->channels == channels && kept->texels == made.texels
                && kept->intensity == made.intensity);
            EXPECT_FALSE(read_kept_map(file, 9, {2, 3}));
            EXPECT_FALSE(read_kept_map(file, 8, made.size));
            for_each_damage(read_text(file), [&](const std::string& damaged, const std::string& how) {
                write_bytes(file, damaged);
                EXPECT_FALSE(read_kept_map(file, 9, made.size)) << how;
            });
        }
    EXPECT_FALSE(write_kept_map(file / "none", 9, {}));
}

} // namespace
} // namespace map_cache_test
