// The inset's telescope: its field, and where it looks.
#include "config/model/angles.h"
#include "config/model/inset_view.h"
#include <gtest/gtest.h>

namespace starbow::inset_view_test {
namespace {

TEST(BesideTest, TheTelescopesFieldHoldsTheFrontHalfOfTheSkyAndIsSteady)
{
    EXPECT_EQ(telescope_fov_deg(0, 0), 60);
    EXPECT_EQ(telescope_fov_deg(std::sqrt(15), 0), 30); // gamma 4: 28.96 degrees
    EXPECT_EQ(telescope_fov_deg(100, 0), 1.5); // 1.146
    EXPECT_NEAR(telescope_fov_deg(1e4, 0), 0.015, 1e-9);
    double before = 0, changes = 0;
    for (double u = 0.01; u < 1e5; u *= 1.001) {
        const double field = telescope_fov_deg(u, before), needed = std::min(2 * std::atan(1 / u) / degree, 60.0);
        ASSERT_GT(field, 0.69 * needed) << u;
        ASSERT_LT(field, 1.75 * needed + 0.01) << u;
        changes += field != before;
        before = field;
    }
    EXPECT_LT(changes, 35); // of seven decades, five a decade
    // A flight that trembles about any speed keeps one field.
    for (double u = 0.3; u < 100; u *= 1.07) {
        const double field = telescope_fov_deg(u, 0);
        for (const double part : {0.97, 1.03, 0.95, 1.05})
            EXPECT_EQ(telescope_fov_deg(u * part, field), field) << u;
    }
}

TEST(BesideTest, TheTelescopeLooksWhereTheShipFliesAndStaysUpright)
{
    Shot shot;
    shot.u = {3, 0, -4};
    shot.exposure_ev = -3;
    for (const glm::dquat& cockpit : {glm::dquat(1, 0, 0, 0), glm::angleAxis(2.0, glm::dvec3(0, 1, 0)),
             glm::angleAxis(std::atan2(-3, 4) + pi, glm::dvec3(0, 1, 0))}) { // the last looks back
        shot.ship_from_cockpit = cockpit;
        const Shot through = inset_shot(shot, InsetView::telescope, 5);
        EXPECT_LT(glm::distance(through.ship_from_cockpit * glm::dvec3(0, 0, -1), glm::dvec3(0.6, 0, -0.8)), 1e-9);
        EXPECT_GT((through.ship_from_cockpit * glm::dvec3(0, 1, 0)).y, 0.999);
        EXPECT_EQ(through.exposure_ev, -3);
        EXPECT_EQ(through.u, shot.u);
    }
    shot.u = glm::dvec3(0);
    EXPECT_EQ(inset_shot(shot, InsetView::telescope, 0).ship_from_cockpit, shot.ship_from_cockpit);
}

} // namespace
} // namespace starbow::inset_view_test
