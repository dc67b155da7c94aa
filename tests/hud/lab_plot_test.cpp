// The laboratory's plots: the theory's curves against boosts in 33 digits, the points of flights against school formulas,
// and what is drawn in both languages.
#include "runtime/hud/lab_plot.h"
#include "tests/support/lab_flight.h"
#include "tests/support/quad.h"
#include <gtest/gtest.h>

namespace lab_plot_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr double deg = 3.14159265358979323846 / 180;
constexpr Plot plots[] = {Plot::doppler, Plot::length, Plot::clock};

std::vector<PlotPoint> points_of(Plot plot, const std::vector<LabLine>& lines)
{
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < lines.size(); ++i)
        add_points(points, plot, i > 0 ? &lines[i - 1] : nullptr, lines[i]);
    return points;
}

/// Past the clocks at half the speed of light, a line every half second, with the outer clocks marked.
const std::vector<LabLine>& passing()
{
    static const std::vector<LabLine> lines = [] {
        LabFlight lab("clocks", "clocks-passing");
        lab.mark(0, lab.clock_near({-10, 0, 0}));
        lab.mark(1, lab.clock_near({10, 0, 0}));
        lab.wait(10, 0.5);
        return lab.lines();
    }();
    return lines;
}

} // namespace

TEST(LabPlot, TheCurveOfDIsThatOfABoost)
{
    for (const double u : {0.0, 0.2, 0.57735, 3.873, 100.0, 1e6})
        for (double angle = 0; angle <= 180; angle += 7.5) {
            const quad::Light light = quad::world_from_camera(
                {quad::Q(sinq(quad::Q(angle) * quad::pi / 180)), 0, quad::Q(cosq(quad::Q(angle) * quad::pi / 180))},
                {0, 0, u});
            EXPECT_NEAR(doppler_theory(u, angle * deg) / double(light.D), 1, 1e-13) << u << ' ' << angle;
        }
    // Length and clocks: the time part of a boost of the unit of time.
    for (const double u : {0.0, 0.2, 0.57735, 3.873, 100.0, 1e6})
        EXPECT_NEAR(contraction_theory(u) * double(quad::boosted({0, 0, u}, {1, {0, 0, 0}}).t), 1, 1e-14);
    // The drawn curves, point by point.
    for (const glm::dvec2& p : theory_curve(Plot::length, 0))
        EXPECT_NEAR(p.y, std::sqrt(1 - p.x * p.x), 1e-8);
    for (const glm::dvec2& p : theory_curve(Plot::doppler, 0.75))
        EXPECT_NEAR(p.y, 0.8 / (1 - 0.6 * std::cos(p.x * deg)), 1e-12);
}

TEST(LabPlot, TheDopplerFactorsOfAFlightLieOnTheCurve)
{
    const std::vector<PlotPoint> points = points_of(Plot::doppler, passing());
    long read = 0, by_eye = 0;
    for (const PlotPoint& point : points) {
        EXPECT_NEAR(point.gamma_beta, 0.5 / std::sqrt(0.75), 1e-9);
        EXPECT_NEAR(point.theory, std::sqrt(0.75) / (1 - 0.5 * std::cos(point.x * deg)), 1e-11);
        // The log has 12 digits. A clock's ticks are counted over half a second, in which D bends by less than 1e-4.
        EXPECT_NEAR(point.deviation(), 0, point.by_eye ? 1e-4 : 1e-10);
        ++(point.by_eye ? by_eye : read);
    }
    EXPECT_EQ(read, 20 * 3); // the crosshair and two marks
    EXPECT_EQ(by_eye, 19 * 2);
}

TEST(LabPlot, LengthsAndClocksOfAFlightLieOnTheCurve)
{
    long seen = 0;
    for (const PlotPoint& point : points_of(Plot::length, passing())) {
        EXPECT_NEAR(point.x, 0.5, 1e-9);
        EXPECT_NEAR(point.theory, std::sqrt(0.75), 1e-9);
        if (point.by_eye) {
            ++seen;
            EXPECT_NEAR(point.y, 0.87, 0.06); // at the first instant 17.485 of 20 (docs/lab.md)
        } else {
            EXPECT_NEAR(point.deviation(), 0, 1e-9);
        }
    }
    EXPECT_EQ(seen, 20);
    EXPECT_NEAR(points_of(Plot::length, {passing()[0]})[1].y, 17.47 / 20, 0.02);
    const std::vector<PlotPoint> rates = points_of(Plot::clock, passing());
    ASSERT_EQ(rates.size(), 19u);
    for (const PlotPoint& point : rates)
        EXPECT_NEAR(point.y, std::sqrt(0.75), 1e-9);
}

// A pair that lies askew: only its part along the motion is contracted, and only that part is a point.
TEST(LabPlot, OfAnObliqueLengthThePartAlongTheMotionCounts)
{
    LabFlight lab("clocks", "clocks-passing");
    const auto pair = [&](glm::dvec3 first, glm::dvec3 second) {
        lab.mark(0, {.at = first}), lab.mark(1, {.at = second});
        lab.log();
        return points_of(Plot::length, {lab.lines().back()});
    };
    const auto askew = pair({0, 0, 0}, {4, 3, 0});
    ASSERT_EQ(askew.size(), 2u);
    EXPECT_NEAR(askew[0].y, std::sqrt(0.75), 1e-9);
    EXPECT_TRUE(pair({0, 0, 0}, {0, 3, 0}).empty()); // across the motion
    EXPECT_TRUE(pair({0, 0, 0}, {0, 0, 0}).empty());
}

// Lines of two flights, before and after a stop, or with a mark that was set anew give no rate.
TEST(LabPlot, OnlyStraightFlightGivesRates)
{
    LabFlight lab("clocks", "clocks-passing");
    lab.mark(0, lab.clock_near({0, 0, 0}));
    lab.log(), lab.wait(0.2), lab.log();
    EXPECT_EQ(points_of(Plot::clock, lab.lines()).size(), 1u);
    lab.press(controls_with(Switches{Switch::stop}));
    lab.log();
    EXPECT_EQ(points_of(Plot::clock, lab.lines()).size(), 1u);
    lab.wait(0.2), lab.mark(0, lab.clock_near({5, 0, 0})), lab.log();
    const auto points = points_of(Plot::doppler, lab.lines());
    EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const PlotPoint& p) { return p.by_eye; }), 1);
    // At rest there is no direction of motion, and D has no angle.
    EXPECT_EQ(points_of(Plot::doppler, {lab.lines().back()}).size(), 0u);
    LabFlight other("clocks", "clocks-rest");
    other.log(), other.wait(0.2), other.log();
    std::vector<LabLine> two = lab.lines();
    two.push_back(other.lines()[1]);
    EXPECT_FALSE(straight_on(two[two.size() - 2], two.back()));
    // Without aberration the picture is none of a flight's.
    LabFlight off("clocks", "clocks-passing");
    off.press(controls_with(Switches{Switch::aberration}));
    off.mark(0, off.clock_near({0, 0, 0})), off.log(), off.wait(0.2), off.log();
    for (Plot plot : plots)
        EXPECT_TRUE(points_of(plot, off.lines()).empty());
}

TEST(LabPlot, TheAxesHoldCurvesAndPoints)
{
    for (const double u : {0.0, 0.577, 3.873, 1e3}) {
        const PlotAxes axes = plot_axes(Plot::doppler, {}, {u});
        for (const glm::dvec2& p : theory_curve(Plot::doppler, u)) {
            EXPECT_GE(axes.across(p.x), 0);
            EXPECT_LE(axes.across(p.x), 1);
            EXPECT_GE(axes.up(p.y), -1e-9);
            EXPECT_LE(axes.up(p.y), 1 + 1e-9);
        }
        EXPECT_NEAR(axes.up(1), 0.5, 1e-12);
        EXPECT_GE(axes.y_ticks.size(), 3u);
        EXPECT_LE(axes.y_ticks.size(), 14u);
    }
    const PlotAxes long_seen = plot_axes(Plot::length, {{0.8, 2.7, 0.6, 1.33, true}}, {});
    EXPECT_LT(long_seen.up(2.7), 1);
    EXPECT_LE(long_seen.y_ticks.size(), 11u);
    EXPECT_LE(plot_axes(Plot::length, {{0.8, 2.7e5, 0.6, 1.33, true}}, {}).y_ticks.size(), 11u);
    for (const double y : {5e-324, 1.7e308}) {
        const PlotAxes wide = plot_axes(Plot::doppler, {{90, y, 1, 1, true}}, {});
        EXPECT_TRUE(std::isfinite(wide.y_high) && wide.y_low > 0 && wide.y_ticks.size() >= 5) << y;
    }
    const std::vector<double> speeds = plot_speeds({{0, 1, 1, 0.5}, {0, 1, 1, 0.5001}, {0, 1, 1, 2}, {0, 1, 1, 3}}, 2);
    EXPECT_EQ(speeds, (std::vector<double>{3, 2}));
}

TEST(LabPlot, DeviationsAreThoseOfAPocketCalculator)
{
    // 10 %, -10 % and 30 %: mean 10 %, spread 20 %.
    const std::vector<PlotPoint> points = {{0, 1.1, 1}, {0, 1.8, 2}, {0, 1.3, 1}, {0, 9, 1, 0, true}};
    const Deviation read = deviation_of(points, false), seen = deviation_of(points, true);
    EXPECT_EQ(read.count, 3);
    EXPECT_EQ(seen.count, 1);
    EXPECT_NEAR(read.mean, 0.1, 1e-15);
    EXPECT_NEAR(read.spread, 0.2, 1e-15);
    EXPECT_NEAR(seen.mean, 8, 1e-15);
    EXPECT_EQ(seen.spread, 0);
    EXPECT_EQ(deviation_of({}, false).count, 0);
}

// No letter is cut off, in either language; a point that comes changes the picture at its place.
TEST(LabPlot, LettersStayOnThePlateAndPointsAreDrawn)
{
    const Typesetter typesetter;
    for (const char* language : {"en", "de"})
        for (int width : {300, 800, 1600})
            for (Plot plot : plots)
                for (const bool full : {false, true}) {
                    const std::vector<PlotPoint> points = full ? points_of(plot, passing()) : std::vector<PlotPoint>();
                    const Panel panel = draw_lab_plot(typesetter, words(language), plot, points, 0.577, width);
                    ASSERT_EQ(panel.size, glm::ivec2(width, int(width * plot_aspect)));
                    for (int y = 0; y < panel.size.y; ++y)
                        for (int x = 0; x < width; ++x) {
                            const bool edge = x < width / 100 || x >= width - width / 100 || y == 0 || y == panel.size.y - 1;
                            ASSERT_TRUE(!edge || panel.texels[2 * (std::size_t(y) * width + x)] < 128)
                                << language << ' ' << width << ' ' << plot_names[std::size_t(plot)] << ' ' << x << ' ' << y;
                        }
                }
    const auto lit = [&](const std::vector<PlotPoint>& points) {
        const Panel panel = draw_lab_plot(typesetter, words(), Plot::clock, points, 0.5, 800);
        // The field is 0.13 to 0.95 of the width and 0.20 to 0.765 of the height; 0.5 and 0.866 of 1.1 on its axes.
        const int x = int(800 * (0.13 + 0.5 * 0.82)), y = int(496 * (0.765 - 0.565 * 0.6 / 1.1));
        return int(panel.texels[2 * (std::size_t(y) * 800 + std::size_t(x))]);
    };
    EXPECT_LT(lit({}), 60);
    EXPECT_GT(lit({{0.5, 0.6, 0.866, 0.577}}), 240);
}

} // namespace lab_plot_test
