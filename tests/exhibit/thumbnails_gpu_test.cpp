// Small pictures of worlds, tours and views: one for each, named by its content, drawn once.
#include "config/model/shipped.h"
#include "runtime/exhibit/thumbnails.h"
#include "runtime/images/capture.h"
#include "tests/support/files.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace starbow::thumbnails_gpu_test {
namespace {

using namespace starbow::testing;

std::vector<Thumbnail> all_in(const std::filesystem::path& folder)
{
    return thumbnails(folder, words_in("en"), [](const std::string& why) { ADD_FAILURE() << why; });
}

} // namespace

TEST(Thumbnails, EveryWorldTourAndViewHasOneByItsContent)
{
    const std::vector<Thumbnail> all = all_in("/somewhere"), again = all_in("/somewhere");
    EXPECT_EQ(all.size(), shipped_names("scenes").size() + shipped_names("tours").size() + shipped_names("shots").size());
    std::set<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].file, again[i].file);
        EXPECT_TRUE(names.insert(all[i].kind + "/" + all[i].name).second);
    }
    const auto file_of = [&](const std::string& kind, const std::string& name) {
        return std::ranges::find_if(all, [&](const Thumbnail& one) { return one.kind == kind && one.name == name; })->file;
    };
    EXPECT_EQ(file_of("scene", "avenue"), file_of("shot", "start")); // the same picture
    EXPECT_NE(file_of("shot", "avenue-rest"), file_of("shot", "start")); // other effects
    EXPECT_NE(file_of("shot", "earth"), file_of("shot", "moon"));
    EXPECT_TRUE(thumbnails({}, words_in("en"), [](const std::string&) {}).empty());
}

/// Nobody waits for them: a name has none at first, and then its own.
TEST(Thumbnails, AReaderFindsThemOnceTheyAreWanted)
{
    std::promise<void> may_read;
    int reads = 0;
    ThumbnailReader reader([&] {
        may_read.get_future().wait();
        ++reads;
        return Thumbnails{{"scene/avenue", {{2, 1}, {1, 2, 3, 4, 5, 6}}}};
    });
    EXPECT_EQ(reader.find(""), nullptr);
    EXPECT_EQ(reader.find("scene/avenue"), nullptr);
    may_read.set_value();
    const SmallPicture* found = nullptr;
    while (!found)
        found = reader.find("scene/avenue");
    EXPECT_EQ(found->size, glm::ivec2(2, 1));
    EXPECT_EQ(reader.find("scene/nowhere"), nullptr);
    EXPECT_EQ(reader.find("scene/avenue"), found);
    EXPECT_EQ(reads, 1);
    EXPECT_EQ(ThumbnailReader({}).find("scene/avenue"), nullptr);
}

TEST(Thumbnails, TheyAreDrawnOnceAndShowSomething)
{
    const std::filesystem::path folder = scratch("thumbnails");
    std::filesystem::remove_all(folder);
    std::vector<Thumbnail> some = all_in(folder);
    std::erase_if(some, [](const Thumbnail& one) { return one.name != "start" && one.name != "chart-rest"; });
    ASSERT_EQ(some.size(), 2u);
    std::vector<std::string> shown;
    const auto show = [&](const Thumbnail& one, std::size_t before) {
        EXPECT_EQ(before, shown.size());
        shown.push_back(one.name);
    };
    EXPECT_EQ(draw_thumbnails(some, show), 2u);
    EXPECT_EQ(draw_thumbnails(some, show), 0u);
    EXPECT_EQ(shown.size(), 2u);
    for (const Thumbnail& one : some) {
        const std::string png = read_text(one.file);
        const auto number = [&](std::size_t at) {
            int value = 0;
            for (std::size_t i = 0; i < 4; ++i)
                value = 256 * value + std::uint8_t(png[at + i]);
            return value;
        };
        ASSERT_GT(png.size(), 4000u) << "a picture of one colour has a few hundred bytes";
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_EQ(glm::ivec2(number(16), number(20)), thumbnail_px); // IHDR
    }
}

} // namespace starbow::thumbnails_gpu_test
