// A docent's directions: each command changes its own and no other, and all of them are forgotten together.
#include "input/command.h"
#include "runtime/visit/docent.h"
#include <gtest/gtest.h>

namespace docent_test {

using namespace starbow;

TEST(DocentTest, FadesToBlackAndBack)
{
    Docent docent;
    EXPECT_TRUE(docent.apply_command({.kind = CommandKind::fade, .on = true}));
    double before = 0;
    for (int i = 0; i < 200; ++i) {
        docent.advance(0.01);
        EXPECT_GE(docent.fade(), before);
        before = docent.fade();
    }
    EXPECT_EQ(docent.fade(), 1) << "after two seconds";
    docent.apply_command({.kind = CommandKind::fade});
    docent.advance(0.75);
    EXPECT_NEAR(docent.fade(), 0.5, 1e-12);
    docent.advance(5);
    EXPECT_EQ(docent.fade(), 0);
}

TEST(DocentTest, TakesItsOwnCommandsAndForgetsThemAll)
{
    for (const CommandRule& rule : command_rules()) {
        Docent docent;
        const bool own = docent.apply_command(
            {.kind = rule.kind, .on = true, .number = 7, .text = "Look to the left", .effect = rule.effect});
        const int changed = docent.fades() + docent.holds() + docent.restarts() + (docent.exposure_ev() == 7)
            + (docent.max_gamma() == 7) + (docent.caption() == "Look to the left");
        EXPECT_EQ(changed, own ? 1 : 0) << rule.name;
        docent.refusal = "no";
        docent.forget();
        EXPECT_FALSE(docent.fades() || docent.holds() || docent.restarts() || docent.max_gamma()) << rule.name;
        EXPECT_EQ(docent.exposure_ev(), 0);
        EXPECT_TRUE(docent.caption().empty() && docent.refusal.empty());
    }
}

} // namespace docent_test
