// A builder's keys in the exhibit, and what of them outlasts a visit.
#include "config/model/shipped.h"
#include "runtime/exhibit/alignment_mode.h"
#include "tests/support/controls.h"
#include <gtest/gtest.h>

namespace alignment_mode_gpu_test {

using namespace starbow;
using starbow::testing::controls_with;

TEST(AlignmentMode, TheWayHomeEndsAVisitorsTestPattern)
{
    for (const Pattern first : {Pattern::none, Pattern::grid}) {
        AlignmentMode alignment(first);
        Layout layout = load_layout(shipped_file("layouts", "desk"));
        EXPECT_FALSE(alignment.apply(controls_with(Switches{Switch::pattern}), layout));
        EXPECT_NE(alignment.pattern(), first);
        alignment.apply({}, layout);
        EXPECT_NE(alignment.pattern(), first);
        alignment.apply(controls_with(Switches{Switch::home}), layout);
        EXPECT_EQ(alignment.pattern(), first);
    }
}

} // namespace alignment_mode_gpu_test
