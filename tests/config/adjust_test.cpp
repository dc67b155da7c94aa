// Alignment on site: every number is adjustable in whole steps within its range, and is kept in the file.
#include "config/model/adjust.h"
#include "tests/support/files.h"
#include <array>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

namespace adjust_test {

using namespace starbow;

namespace {

const Adjustable& named(const std::vector<Adjustable>& all, std::string_view name)
{
    for (const Adjustable& one : all)
        if (one.name == name)
            return one;
    throw std::runtime_error("no " + std::string(name));
}

} // namespace

TEST(Adjust, EveryShippedLayoutKeepsItsAdjustments)
{
    // The copy of the folder has the files that layouts name.
    const std::filesystem::path folder
        = std::filesystem::temp_directory_path() / ("starbow-adjust-" + std::to_string(::getpid()));
    struct RemovedAtEnd {
        const std::filesystem::path& folder;
        ~RemovedAtEnd() { std::filesystem::remove_all(folder); }
    } removed_at_end{folder};
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
            if (one.spots.size() > 1)
                continue;
            EXPECT_TRUE(pointers.insert(one.spots[0].pointer).second) << one.name;
            turned = adjusted(turned, one, 3);
            EXPECT_NEAR(value_of(turned, one) - value_of(before, one), 3 * one.step, 1e-9) << one.name;
        }
        EXPECT_EQ(changes(before, turned).size(), pointers.size());

        // Another machine, which has the same file, has the same layout by the numbers alone.
        const std::vector<TurnedNumber> numbers = turned_numbers(before, turned);
        EXPECT_EQ(numbers.size(), pointers.size());
        EXPECT_TRUE(turned_numbers(before, before).empty());
        const Layout there = with_turned(before, numbers);
        for (const Adjustable& one : all)
            EXPECT_EQ(value_of(there, one), value_of(turned, one)) << one.name;
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
    layout.hud.emplace();
    const std::vector<Adjustable> all = adjustables(layout);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, tilt"), 1), named(all, "dome, tilt")), 30.07);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, tilt"), 1e6), named(all, "dome, tilt")), 180);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "blend, power"), -1e6), named(all, "blend, power")), 0.1);
    for (const double end : {-90.0, 90.0})
        EXPECT_EQ(value_of(adjusted(layout, named(all, "head-up display, height"), int(end * 1000)),
                      named(all, "head-up display, height")),
            end);
    EXPECT_EQ(value_of(adjusted(layout, named(all, "dome, rotation"), -10), named(all, "dome, rotation")), -1);
}

TEST(Adjust, NumbersThatALayoutHasNotAreRefused)
{
    const Layout dome = load_layout(starbow::testing::source_dir() / "config/layouts/dome2.json");
    const std::size_t count = adjustables(dome).size();
    const auto said = [&](TurnedNumber number) {
        try {
            with_turned(dome, std::array{number});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::uint16_t place_of_left_tilt = 2; // after the whole dome's tilt and rotation
    EXPECT_EQ(said({place_of_left_tilt, 20}), "");
    EXPECT_EQ(said({place_of_left_tilt, 181}), "dome2: left, tilt can't become 181; a number from -180 to 180 is right");
    EXPECT_NE(said({place_of_left_tilt, std::nan("")}), "");
    EXPECT_EQ(
        said({0, 20}), "dome2: the number in place 0 can't be turned; a place below " + std::to_string(count) + " is right")
        << "the whole dome's is the sum of its projectors'";
    EXPECT_NE(said({std::uint16_t(count), 20}), "");
}

TEST(Adjust, ProjectorsOfOneDomeAreAdjustedTogether)
{
    const Layout before = load_layout(starbow::testing::source_dir() / "config/layouts/dome2.json");
    const std::vector<Adjustable> all = adjustables(before);
    const Layout turned = adjusted(before, named(all, "the whole dome, tilt"), 7);
    for (const char* each : {"left, tilt", "right, tilt"})
        EXPECT_NEAR(value_of(turned, named(all, each)) - value_of(before, named(all, each)), 0.7, 1e-9);
    EXPECT_EQ(changes(before, turned).size(), 2u);
    // After one is adjusted alone, they have no common tilt any more.
    const Layout apart = adjusted(before, named(all, "left, tilt"), 1);
    EXPECT_THROW(named(adjustables(apart), "the whole dome, tilt"), std::runtime_error);
    EXPECT_NO_THROW(named(adjustables(apart), "the whole dome, rotation"));
}

TEST(Adjust, HandlesAreNumbersOfTheFile)
{
    const std::filesystem::path file = starbow::testing::write_text("handles.json", R"({ "outputs": [{ "name": "wall",
        "viewports": [{ "projection": { "type": "planar" }, "quad": { "upper_right": [0.9, 0.1] },
        "grid": { "columns": 4, "rows": 3 } }] }] })");
    const Layout before = load_layout(file);
    const std::vector<Adjustable> all = adjustables(before);
    EXPECT_EQ(all.size(), 3u + 8 + 24) << "the turn, four corners, twelve handles";
    Layout turned = adjusted(before, named(all, "wall, upper right corner, to the right"), -4);
    turned = adjusted(turned, named(all, "wall, lower left corner, down"), 8);
    turned = adjusted(turned, named(all, "wall, handle 3.2, to the right"), 40);
    turned = adjusted(turned, named(all, "wall, handle 1.4, down"), -40);
    const Viewport& viewport = turned.outputs[0].viewports[0];
    EXPECT_NEAR(viewport.quad->upper_right.x, 0.899, 1e-12);
    EXPECT_NEAR(viewport.quad->lower_left.y, 1.002, 1e-12);
    EXPECT_NEAR(viewport.grid->right[9], 0.01, 1e-12);
    EXPECT_NEAR(viewport.grid->down[3], -0.01, 1e-12);
    // The file has neither the lower left corner nor any offset.
    EXPECT_EQ(changes(before, turned).size(), 4u);
    EXPECT_EQ(turned_numbers(before, turned).size(), 4u);
    patch_file(file, changes(before, turned));
    const Layout after = load_layout(file);
    for (const Adjustable& one : all)
        EXPECT_EQ(value_of(after, one), value_of(turned, one)) << one.name;
    const Layout there = with_turned(before, turned_numbers(before, turned));
    for (const Adjustable& one : all)
        EXPECT_EQ(value_of(there, one), value_of(turned, one)) << one.name;
}

TEST(Adjust, AGripIsANumberOrAPlace)
{
    const Layout before = load_layout(starbow::testing::write_text("grips.json", R"({ "outputs": [{ "name": "wall",
        "viewports": [{ "projection": { "type": "planar" }, "quad": {}, "grid": { "columns": 3, "rows": 3 } }] }] })"));
    const std::vector<Grip> all = grips(before);
    std::vector<std::string> names;
    for (const Grip& grip : all)
        names.push_back(grip.name);
    EXPECT_EQ(names,
        (std::vector<std::string>{"wall, yaw", "wall, pitch", "wall, roll", "wall, upper left corner",
            "wall, upper right corner", "wall, lower right corner", "wall, lower left corner", "wall, handle 1.1",
            "wall, handle 1.2", "wall, handle 1.3", "wall, handle 2.1", "wall, handle 2.2", "wall, handle 2.3",
            "wall, handle 3.1", "wall, handle 3.2", "wall, handle 3.3"}));
    const auto turn = [](const Layout& layout) { return std::get<Planar>(layout.outputs[0].viewports[0].projection).turn; };
    EXPECT_NEAR(turn(moved(before, all[0], 5, 0)).yaw_deg, 0.5, 1e-12);
    EXPECT_NEAR(turn(moved(before, all[1], 0, 5)).pitch_deg, -0.5, 1e-12) << "down is less";
    const Quad quad = *moved(before, all[5], -4, 8).outputs[0].viewports[0].quad;
    EXPECT_LT(glm::distance(quad.lower_right, glm::dvec2(0.999, 1.002)), 1e-12);
    EXPECT_EQ(all[5].numbers[1].unmoved, glm::dvec2(1, 1));
    EXPECT_EQ(all[12].numbers[0].unmoved, glm::dvec2(1, 0.5));
    EXPECT_FALSE(all[0].numbers[0].unmoved);
    const HandleGrid grid = *moved(before, all[11], -4, 8).outputs[0].viewports[0].grid;
    EXPECT_NEAR(grid.right[4], -0.001, 1e-12);
    EXPECT_NEAR(grid.down[4], 0.002, 1e-12);
}

TEST(Adjust, AdjustmentsOutlastAReload)
{
    const Layout kept = load_layout(starbow::testing::source_dir() / "config/layouts/dome2.json");
    const std::vector<Adjustable> all = adjustables(kept);
    const Adjustable &left = named(all, "left, rotation"), &right = named(all, "right, rotation"),
                     &power = named(all, "blend, power");
    const Layout turned = adjusted(adjusted(kept, left, 5), right, 3);
    // Meanwhile the file has another value for one of the two, and for the blend's power.
    const Layout fresh = adjusted(adjusted(kept, right, -2), power, 4), again = turned_again(fresh, kept, turned);
    EXPECT_EQ(value_of(again, left), value_of(turned, left));
    EXPECT_EQ(value_of(again, right), value_of(fresh, right));
    EXPECT_EQ(value_of(again, power), value_of(fresh, power));
    // The layout has another viewport in place of the adjusted one.
    Layout other = fresh;
    other.outputs.erase(other.outputs.begin());
    other.outputs[0].viewports[0].projection = Planar{};
    EXPECT_NO_THROW(turned_again(other, kept, turned));
    EXPECT_NO_THROW(changes(other, turned));
}

} // namespace adjust_test
