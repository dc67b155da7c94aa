// The instruments that have a scale alone: what an eye that finds line or step on the drawn panel reads there is the truth,
// within the stated uncertainty.
#include "runtime/hud/lab_panel.h"
#include "runtime/hud/lab_scales.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace lab_scales_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const Typesetter& typesetter()
{
    static const Typesetter letters;
    return letters;
}

int at(const Panel& panel, int x, double down)
{
    return panel.texels[2 * (std::size_t(down * panel.size.y) * std::size_t(panel.size.x) + std::size_t(x))];
}

/// Columns with the middles of ticks in the row of long ones, below the strip.
std::vector<double> tick_columns(const Panel& panel, double down)
{
    std::vector<double> columns;
    for (int x = 1; x + 1 < panel.size.x; ++x)
        if (const int before = at(panel, x - 1, down), here = at(panel, x, down), after = at(panel, x + 1, down);
            here > 100 && here >= before && here > after)
            columns.push_back(x + 0.5 + 0.5 * double(after - before) / 255);
    return columns;
}

} // namespace

// Reads the line between the two numbered ticks around it, as a student does: by the logarithm, with the column of the
// brightest light.
TEST(LabScales, TheSpectrumsLineIsReadAtItsWavelength)
{
    const glm::ivec2 size(1200, 240);
    for (const double nm : {69.85, 120., 317.5, 399.9, 400.1, 550., 635.085, 799., 4330., 21000.}) {
        SCOPED_TRACE(nm);
        const Panel panel = draw_spectroscope(typesetter(), words(), nm, size);
        const LabScale scale = spectroscope_scale(nm);
        EXPECT_GE(nm, scale.low * 1.09);
        EXPECT_LE(nm, scale.high / 1.09);
        double weight = 0, sum = 0;
        for (int x = 0; x < size.x; ++x)
            if (const double bright = at(panel, x, 0.45); bright > 60)
                weight += bright - 60, sum += (bright - 60) * (x + 0.5);
        ASSERT_GT(weight, 0);
        std::vector<double> numbers;
        for (const LabScale::Tick& tick : scale.ticks)
            if (tick.rank == 2)
                numbers.push_back(tick.at);
        ASSERT_GE(numbers.size(), 2u);
        const std::vector<double> columns = tick_columns(panel, 0.62 + 0.105); // below the fifths' ends
        ASSERT_EQ(columns.size(), numbers.size());
        const double across = (sum / weight - columns.front()) / (columns.back() - columns.front());
        const double read = numbers.front() * std::pow(numbers.back() / numbers.front(), across);
        double step = scale.ticks[1].at - scale.ticks[0].at;
        EXPECT_NEAR(read, nm, step / 3) << "a third of a tick is the stated uncertainty";
        EXPECT_LT(step / nm, 0.03) << "a third of a tick is a hundredth of the wavelength at most";
    }
}

// The scale tells nothing of the wavelength but by its numbers: it is the same over a factor of 2.
TEST(LabScales, TheSpectrumsScaleStaysWhileTheLineMoves)
{
    const LabScale one = spectroscope_scale(401), other = spectroscope_scale(799);
    EXPECT_EQ(one.low, other.low);
    EXPECT_EQ(one.ticks.size(), other.ticks.size());
    EXPECT_NE(spectroscope_scale(801).low, one.low);
}

// The bar's grey lies between those of the two steps beside its light.
TEST(LabScales, ThePhotometersBarEqualsTheStepOfItsLight)
{
    const glm::ivec2 size(1200, 240);
    for (const double light : {0.00217, 0.1138, 0.5, 1., 3.3, 9.9, 488.}) {
        SCOPED_TRACE(light);
        const Panel panel = draw_photometer(typesetter(), words(), light, size);
        const LabScale scale = photometer_scale(light);
        const int bar = at(panel, size.x / 2, 0.38);
        int nearest = 0;
        for (int x = 60; x < size.x - 60; ++x)
            if (std::abs(at(panel, x, 0.55) - bar) < std::abs(at(panel, nearest, 0.55) - bar) || nearest == 0)
                nearest = x;
        int last = nearest;
        while (at(panel, last + 1, 0.55) == at(panel, nearest, 0.55))
            ++last;
        // The step's middle, by the strip's ends.
        const double part = (0.5 * (nearest + last + 1) - 0.04 * size.x) / (0.92 * size.x);
        const double read = scale.low * std::pow(scale.high / scale.low, part);
        EXPECT_NEAR(read / light, 1, 0.07) << "half a step is 6 %, and a pixel";
    }
    EXPECT_EQ(draw_photometer(typesetter(), words(), 0, size).size, size);
}

// With scales alone no panel and no page tells a figure of the theory, whatever the instruments read.
TEST(LabScales, ByEyeThePanelIsTheSameForEveryReading)
{
    Measured first, second;
    first.aim.seen_nm = 601, second.aim.seen_nm = 700;
    for (Measured* m : {&first, &second})
        m->observer.u = {0, 0, -0.7};
    first.aim.from_motion_rad = 0.3, second.aim.from_motion_rad = 1.1;
    first.aim.ray.D = 0.9, second.aim.ray.D = 0.8;
    for (std::size_t overlay = 1; overlay < overlay_names.size(); ++overlay)
        for (std::size_t why = 0; why < why_names.size(); ++why) {
            const Overlay shown = Overlay(overlay);
            if (why == 0 && shown == Overlay::photometer)
                continue;
            LabView view{shown, {0.5, 100, 2}, Why(why), true};
            if (shown == Overlay::spectrum) // after a reading its sentence is in the strip's place
                view.by_eye_says = "x";
            const auto texels
                = [&](const Measured& m) { return draw_lab_panel(typesetter(), words(), m, view, 500).texels; };
            EXPECT_EQ(texels(first), texels(second)) << overlay_names[overlay] << ' ' << why_names[why];
            view.by_eye = false, view.by_eye_says.clear();
            if (why == 0) {
                EXPECT_NE(texels(first), texels(second)) << overlay_names[overlay];
            }
        }
}

} // namespace lab_scales_test
