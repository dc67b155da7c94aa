// A visitor's choices by commands and by switches.
#include "input/exhibit_state.h"
#include <gtest/gtest.h>

namespace choices_test {

using namespace starbow;

// Each command changes one choice or none, and the guide's window expects the same of it.
TEST(ChoicesTest, ACommandChangesItsOwnChoice)
{
    int choosing = 0;
    for (const CommandRule& rule : command_rules()) {
        const Command command{.kind = rule.kind,
            .on = true,
            .number = 2,
            .text = rule.kind == CommandKind::inset     ? "telescope"
                : rule.kind == CommandKind::information ? "guide"
                : rule.kind == CommandKind::comparison  ? "galilean"
                                                        : "de",
            .effect = rule.effect};
        Choices choices;
        const bool chooses = apply(choices, command);
        choosing += chooses;
        EXPECT_EQ(chooses, choices != Choices()) << rule.name;
        EXPECT_EQ(static_cast<const Choices&>(after(ExhibitState(), command)), choices) << rule.name;
        const int changed = (choices.language == "de") + (choices.information == Information::guide)
            + (choices.inset == InsetView::telescope) + choices.range + choices.sky_names + choices.filter
            + choices.one_button + choices.left_handed;
        EXPECT_EQ(changed, chooses) << rule.name;
    }
    EXPECT_EQ(choosing, 8);
}

TEST(ChoicesTest, SwitchesLeadThroughAllValuesAndBack)
{
    Choices choices;
    int displays = 0, pictures = 0;
    do {
        apply(choices, Switches{Switch::information});
        ++displays;
    } while (choices != Choices() && displays < 100);
    do {
        apply(choices, Switches{Switch::inset});
        ++pictures;
    } while (choices != Choices() && pictures < 100);
    EXPECT_EQ(displays, 3);
    EXPECT_GT(pictures, 2);
    EXPECT_LT(pictures, 100);
    apply(choices, Switches{Switch::range});
    EXPECT_TRUE(choices.range);
    apply(choices, Switches{Switch::sky_names});
    EXPECT_TRUE(choices.sky_names);
    apply(choices, Switches{Switch::filter});
    EXPECT_TRUE(choices.filter);
    apply(choices, Switches{Switch::range, Switch::doppler, Switch::filter, Switch::sky_names});
    EXPECT_EQ(choices, Choices());
}

} // namespace choices_test
