// A builder's keys in the exhibit, and what of them outlasts a visit.
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "runtime/exhibit/alignment_mode.h"
#include "tests/support/controls.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace alignment_mode_gpu_test {

using namespace starbow;
using starbow::testing::controls_with;

TEST(AlignmentMode, TheWayHomeEndsAVisitorsTestPattern)
{
    for (const Pattern first : {Pattern::none, Pattern::grid}) {
        AlignmentMode alignment(first);
        Layout layout = load_layout(shipped_file("layouts", "desk"));
        const Layout kept = layout;
        EXPECT_FALSE(alignment.apply(controls_with(Switches{Switch::pattern}), layout, kept));
        EXPECT_NE(alignment.pattern(), first);
        alignment.apply({}, layout, kept);
        EXPECT_NE(alignment.pattern(), first);
        alignment.apply(controls_with(Switches{Switch::home}), layout, kept);
        EXPECT_EQ(alignment.pattern(), first);
    }
}

namespace {

/// A layout's file with a corner to pull, and a tablet that pulls it.
struct Tablet {
    std::filesystem::path file = starbow::testing::write_text("tablet.json", R"({ "outputs": [{ "name": "wall",
        "viewports": [{ "projection": { "type": "planar" }, "quad": { "upper_right": [0.9, 0.1] } }] }] })");
    Layout kept = load_layout(file), layout = kept;
    AlignmentMode alignment;

    /// Gives a command, and returns its refusal.
    std::string give(const std::vector<std::string>& words, bool changes)
    {
        try {
            alignment.queue(command_of(words), layout);
        } catch (const InputError& error) {
            return error.what();
        }
        EXPECT_EQ(alignment.apply({}, layout, kept), changes) << words[0];
        return "";
    }
    glm::dvec2 corner() const { return layout.outputs[0].viewports[0].quad->upper_right; }
    glm::dvec2 in_file() const { return load_layout(file).outputs[0].viewports[0].quad->upper_right; }
};

const glm::dvec2 before(0.9, 0.1), pulled(0.89, 0.105);

} // namespace

TEST(AlignmentMode, ATabletPullsACornerAndTakesItBack)
{
    Tablet tablet;
    EXPECT_NE(tablet.give({"move", "1", "0"}, false).find("no grip is chosen yet"), std::string::npos);
    EXPECT_NE(tablet.give({"move-back"}, false).find("nothing has been moved"), std::string::npos);
    EXPECT_NE(tablet.give({"grip", "wall, tilt"}, false).find("one of its own, such as \"wall, yaw\""), std::string::npos);
    EXPECT_EQ(tablet.give({"grip", "wall, upper right corner"}, false), "");
    EXPECT_EQ(tablet.alignment.grip_says(), "0.9, 0.1");
    // A ring stands where the picture's corner is: 30 degrees up, and to the right by the window's aspect, 4 by 3.
    ASSERT_TRUE(tablet.alignment.handle());
    const glm::dvec3 corner(std::tan(glm::radians(30.0)) * 4 / 3, std::tan(glm::radians(30.0)), -1);
    EXPECT_LT(glm::distance(*tablet.alignment.handle(), glm::normalize(corner)), 1e-12);
    EXPECT_EQ(tablet.give({"move", "-40", "0"}, true), "");
    EXPECT_EQ(tablet.give({"move", "0", "20"}, true), "");
    EXPECT_LT(glm::distance(tablet.corner(), pulled), 1e-12);
    EXPECT_EQ(tablet.alignment.grip_says(), "0.89, 0.105");
    // The saved picture, then the builder's. A repeated command changes nothing.
    tablet.give({"as-saved", "on"}, true);
    tablet.give({"as-saved", "on"}, false);
    EXPECT_TRUE(tablet.alignment.as_saved());
    EXPECT_EQ(tablet.corner(), before);
    tablet.give({"as-saved", "off"}, true);
    tablet.give({"as-saved", "off"}, false);
    EXPECT_LT(glm::distance(tablet.corner(), pulled), 1e-12);
    // One move after the other is taken back, and what nobody has moved stays.
    tablet.give({"grip", "wall, yaw"}, false);
    EXPECT_FALSE(tablet.alignment.handle()) << "a turn has no place in the picture";
    tablet.give({"move", "10", "0"}, true);
    EXPECT_NEAR(std::get<Planar>(tablet.layout.outputs[0].viewports[0].projection).turn.yaw_deg, 1, 1e-12);
    tablet.give({"move-back"}, true);
    tablet.give({"move-back"}, true);
    EXPECT_LT(glm::distance(tablet.corner(), glm::dvec2(pulled.x, before.y)), 1e-12);
    tablet.give({"move-back"}, true);
    EXPECT_LT(glm::distance(tablet.corner(), before), 1e-12);
    EXPECT_TRUE(changes(tablet.kept, tablet.layout).empty());
}

TEST(AlignmentMode, ALayoutWithoutNumbersHasNoneToTurn)
{
    Layout layout;
    layout.outputs.resize(1);
    layout.outputs[0].viewports = {{.projection = Wall{{-1, -1, -2}, {1, -1, -2}, {-1, 1, -2}}}};
    const Layout kept = layout;
    ASSERT_TRUE(adjustables(layout).empty());
    AlignmentMode alignment;
    Controls controls;
    controls.choose = 1, controls.turn_by = 10;
    EXPECT_FALSE(alignment.apply(controls, layout, kept));
    EXPECT_NE(alignment.says().find("no number to change"), std::string::npos);
    EXPECT_THROW(alignment.queue(command_of(std::vector<std::string>{"grip", "a"}), layout), InputError);
}

TEST(AlignmentMode, AKeyWhileTheSavedPictureIsShownTurnsTheBuilders)
{
    Tablet tablet;
    tablet.give({"grip", "wall, upper right corner"}, false);
    tablet.give({"move", "-40", "20"}, true);
    tablet.give({"as-saved", "on"}, true);
    Controls controls;
    controls.turn_by = 5; // of the first number, the yaw
    EXPECT_TRUE(tablet.alignment.apply(controls, tablet.layout, tablet.kept));
    EXPECT_FALSE(tablet.alignment.as_saved());
    EXPECT_LT(glm::distance(tablet.corner(), pulled), 1e-12);
    EXPECT_NEAR(std::get<Planar>(tablet.layout.outputs[0].viewports[0].projection).turn.yaw_deg, 0.5, 1e-12);
}

TEST(AlignmentMode, AMoveThatCantBeShownIsNoMove)
{
    Tablet tablet;
    tablet.give({"grip", "wall, upper right corner"}, false);
    tablet.give({"move", "-40", "20"}, true);
    const Layout shown = tablet.layout;
    tablet.give({"move", "-2000", "0"}, true);
    tablet.layout = shown; // as the exhibit does
    EXPECT_EQ(tablet.alignment.refuse("/my/wall.json:2: /outputs/0/viewports/0: folds the picture; less is right"),
        "This folds the picture; less is right");
    tablet.give({"move-back"}, true);
    EXPECT_LT(glm::distance(tablet.corner(), before), 1e-12);
    EXPECT_NE(tablet.give({"move-back"}, false), "");
}

TEST(AlignmentMode, ATabletKeepsTheBuildersPictureAndNotTheOneThatIsCompared)
{
    Tablet tablet;
    tablet.give({"grip", "wall, upper right corner"}, false);
    tablet.give({"move", "-40", "20"}, true);
    tablet.give({"as-saved", "on"}, true);
    EXPECT_EQ(tablet.in_file(), before);
    tablet.give({"keep"}, true);
    EXPECT_TRUE(tablet.alignment.says().starts_with("Saved in ")) << tablet.alignment.says();
    EXPECT_FALSE(tablet.alignment.as_saved());
    EXPECT_LT(glm::distance(tablet.in_file(), pulled), 1e-12);
    EXPECT_LT(glm::distance(tablet.corner(), pulled), 1e-12);
    // A move while the saved picture is shown goes on from the builder's.
    tablet.give({"as-saved", "on"}, true);
    tablet.give({"move", "40", "-20"}, true);
    EXPECT_LT(glm::distance(tablet.corner(), before), 1e-12);
    // Another file: its corner of the same name stays where it is.
    tablet.give({"as-saved", "on"}, true);
    tablet.layout.file = "other.json";
    tablet.layout.outputs[0].viewports[0].quad->upper_right = {0.5, 0.2};
    tablet.alignment.reset_moves();
    tablet.give({"as-saved", "off"}, false);
    EXPECT_EQ(tablet.corner(), glm::dvec2(0.5, 0.2));
    EXPECT_NE(tablet.give({"move-back"}, false), "");
}

} // namespace alignment_mode_gpu_test
