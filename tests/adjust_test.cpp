// What a builder turns on site: every number found, turned in whole steps within the range its file may have, kept.
#include "config/adjust.h"
#include "tests/files.h"
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

using namespace starbow;

namespace {

const Adjustable& named(const std::vector<Adjustable>& all, const std::string& name)
{
    for (const Adjustable& one : all)
        if (one.name == name)
            return one;
    throw std::runtime_error("no " + name);
}

} // namespace

TEST(Adjust, EveryShippedLayoutKeepsWhatWasTurned)
{
    // A copy of the folder, so that the files that layouts name are found.
    const std::filesystem::path folder
        = std::filesystem::temp_directory_path() / ("starbow-adjust-" + std::to_string(::getpid()));
    struct Gone {
        const std::filesystem::path& folder;
        ~Gone() { std::filesystem::remove_all(folder); }
    } gone{folder};
    std::filesystem::copy(
        starbow::testing::source_dir() / "config/layouts", folder, std::filesystem::copy_options::recursive);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json")
            continue;
        SCOPED_TRACE(entry.path().filename().string());
        const Layout before = load_layout(entry.path());
        const std::vector<Adjustable> all = adjustables(before);
        ASSERT_FALSE(all.empty());
        Layout turned = before;
        std::set<std::string> pointers;
        for (const Adjustable& one : all) {
            EXPECT_TRUE(pointers.insert(one.pointer).second) << one.pointer;
            turned = adjusted(turned, one, 3);
            EXPECT_NEAR(value_of(turned, one) - value_of(before, one), 3 * one.step, 1e-9) << one.name;
        }
        EXPECT_EQ(changes(before, turned).size(), all.size());
        EXPECT_TRUE(changes(before, before).empty());

        std::ifstream stream(entry.path());
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        for (const Change& change : changes(before, turned))
            text = patched("layout", text, change);
        std::ofstream(entry.path()) << text;
        const Layout after = load_layout(entry.path());
        for (const Adjustable& one : all)
            EXPECT_EQ(value_of(after, one), value_of(turned, one)) << one.name;
    }
}

TEST(Adjust, StaysInTheRangeAndOnWholeSteps)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].name = "dome";
    layout.outputs[0].viewports = {{.projection = Fisheye{.tilt_deg = 29.97}}};
    layout.blend.ramps = true;
    const std::vector<Adjustable> all = adjustables(layout);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, tilt"), 1), named(all, "dome, tilt")), 30.07);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, tilt"), 1e6), named(all, "dome, tilt")), 180);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "blend, power"), -1e6), named(all, "blend, power")), 0.1);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, rotation"), -10), named(all, "dome, rotation")), -1);
}
