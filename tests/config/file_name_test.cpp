// Names of files in composed and decomposed letters are one name, and a wrong name leads to the nearest ones.
#include "config/json/error.h"
#include "config/json/file_name.h"
#include "config/json/whole_file.h"
#include "config/model/layout.h"
#include "tests/support/files.h"
#include <fstream>
#include <gtest/gtest.h>

namespace file_name_test {

using namespace starbow;
namespace fs = std::filesystem;

namespace {

/// A folder of its own, which is removed at the test's end.
struct Folder {
    fs::path path = fs::path(::testing::TempDir()) / ("starbow_names_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    void put(const std::string& name, const std::string& text = "x") const
    {
        fs::create_directories((path / name).parent_path());
        std::ofstream(path / name) << text;
    }
};

} // namespace

TEST(FileNameTest, ComposedAndDecomposedLettersAreOneName)
{
    const Folder folder;
    // Each pair by the Unicode Standard's own charts.
    const std::pair<std::string, std::string> names[] = {
        {"caf\u00e9.txt", "cafe\u0301.txt"}, {"M\u00fcnchen/Gr\u00f6\u00dfe.txt", "Mu\u0308nchen/Gro\u0308\u00dfe.txt"},
        {"\u1ea4.txt", "A\u0302\u0301.txt"}, // two marks on one letter
        {"\ud55c\uae00.txt", "\u1112\u1161\u11ab\u1100\u1173\u11af.txt"}, // Hangul
        {"\u30ac.txt", "\u30ab\u3099.txt"}, // Katakana
    };
    for (const auto& [composed, decomposed] : names)
        for (const auto& [stored, asked] : {std::pair(composed, decomposed), std::pair(decomposed, composed)}) {
            folder.put(stored, stored);
            EXPECT_EQ(as_stored(folder.path / asked), folder.path / stored);
            EXPECT_EQ(read_whole(folder.path / asked, 100, "a file"), stored);
            fs::remove_all(folder.path / *fs::path(stored).begin());
            EXPECT_EQ(as_stored(folder.path / asked), folder.path / asked) << "nothing is there";
        }
}

TEST(FileNameTest, AnExactNameComesFirst)
{
    const Folder folder;
    folder.put("\u00e9", "one"), folder.put("e\u0301", "two");
    EXPECT_EQ(read_whole(folder.path / "\u00e9", 100, "a file"), "one");
    EXPECT_EQ(read_whole(folder.path / "e\u0301", 100, "a file"), "two");
    EXPECT_EQ(as_stored(folder.path / "\xff\xfe"), folder.path / "\xff\xfe") << "bytes that are no UTF-8";
}

TEST(FileNameTest, AWrongNameLeadsToTheNearest)
{
    const Folder folder;
    folder.put("mask-left.png"), folder.put("mask-right.png"), folder.put("something else.csv");
    EXPECT_EQ(nearest_names(folder.path / "mask-lefr.png"), ", and the nearest name there is \"mask-left.png\"");
    EXPECT_EQ(nearest_names(folder.path / "MASK_left.png"), ", and the nearest name there is \"mask-left.png\"");
    EXPECT_EQ(nearest_names(folder.path / "zzzz.json"), "");
    EXPECT_EQ(nearest_names(folder.path / "no such folder" / "mask-left.png"), "");
    folder.put("layout.json", R"({ "outputs": [{ "name": "a", "viewports": [{ "projection": { "type": "planar" },
        "alpha_mask": "mask-lft.png" }] }] })");
    try {
        load_layout(folder.path / "layout.json");
        FAIL() << "the mask does not exist";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("and the nearest name there is \"mask-left.png\""), std::string::npos)
            << error.what();
    }
}

} // namespace file_name_test
