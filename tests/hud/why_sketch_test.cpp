// The sketches of the pages that explain the picture are computed: their angles, crests and lengths obey the formulas.
#include "runtime/hud/hud.h"
#include "runtime/hud/why_sketch.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace why_sketch_test {

using namespace starbow;

namespace {

double length(const Stroke& s) { return glm::distance(s.from, s.to); }
double middle_radius(const Stroke& s) { return 0.5 * glm::length(s.from + s.to); }
/// From straight up.
double angle(const glm::dvec2& v) { return std::atan2(std::abs(v.x), v.y); }

} // namespace

TEST(WhySketch, RaysComeFromWhereAberrationPutsThem)
{
    const double beta = 0.8, gamma = 1 / std::sqrt(1 - beta * beta);
    std::vector<double> seen;
    for (const Stroke& s : why_sketch(Why::aberration, gamma * beta, 0))
        if (std::abs(length(s) - 0.8) < 1e-9)
            seen.push_back(angle(s.from));
    ASSERT_EQ(seen.size(), 24u);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const double world = 2 * M_PI * (double(i) + 0.5) / 24;
        EXPECT_NEAR(std::cos(seen[i]), (std::cos(world) + beta) / (1 + beta * std::cos(world)), 1e-9);
    }
}

TEST(WhySketch, CrestsAreAsFarApartAsTheyArrive)
{
    const double beta = 0.4, gamma = 1 / std::sqrt(1 - beta * beta);
    const std::vector<Stroke> strokes = why_sketch(Why::doppler, gamma * beta, 1.3);
    int checked = 0;
    for (std::size_t i = 0; i + 1 < strokes.size(); ++i) {
        const Stroke &a = strokes[i], &b = strokes[i + 1];
        if (std::abs(length(a) - 0.1) > 1e-9 || std::abs(length(b) - 0.1) > 1e-9)
            continue;
        const double theta = angle(a.from + a.to);
        if (std::abs(theta - angle(b.from + b.to)) > 1e-9)
            continue;
        const double D = 1 / (gamma * (1 - beta * std::cos(theta)));
        EXPECT_NEAR(middle_radius(b) - middle_radius(a), 0.16 / D, 1e-9);
        ++checked;
    }
    EXPECT_GT(checked, 40);
}

TEST(WhySketch, CrestsMoveToTheShip)
{
    // A twentieth of a second later each crest is nearer by the way of light, 0.35 of the square's half side in a second.
    constexpr double begin_s = 1.3, step_s = 0.05, way = 0.35 * step_s;
    const auto crests = [](double t_s) {
        std::vector<glm::dvec2> middles;
        for (const Stroke& s : why_sketch(Why::doppler, 0.4, t_s))
            if (std::abs(length(s) - 0.1) < 1e-9)
                middles.push_back(0.5 * (s.from + s.to));
        return middles;
    };
    const std::vector<glm::dvec2> later = crests(begin_s + step_s);
    int found = 0;
    for (const glm::dvec2& crest : crests(begin_s)) {
        const glm::dvec2 nearer = crest * (1 - way / glm::length(crest));
        if (glm::length(nearer) < 0.21) // it arrives
            continue;
        EXPECT_TRUE(std::any_of(
            later.begin(), later.end(), [&](const glm::dvec2& one) { return glm::distance(one, nearer) < 1e-9; }))
            << crest.x << ' ' << crest.y;
        ++found;
    }
    EXPECT_GT(found, 40);
}

TEST(WhySketch, AThingIsSeenWhereItsLightLeft)
{
    const double beta = 0.6, gamma = 1.25;
    for (double t = 0; t < 12; t += 0.37) {
        const std::vector<Stroke> strokes = why_sketch(Why::delay, gamma * beta, t);
        for (const Stroke& s : strokes)
            if (s.width == 0.01) { // from where it is to where it is seen
                const double flown = s.to.y - s.from.y, way = glm::length(s.to);
                EXPECT_NEAR(flown / beta, way, 1e-6); // thing and light need the same time
                EXPECT_NEAR(s.from.x, s.to.x, 1e-12);
            }
    }
}

TEST(WhySketch, TheSlantedWayOfLightIsAsFastAsTheStraightOne)
{
    const double beta = 0.6, gamma = 1.25;
    double way = 0;
    int pieces = 0;
    for (const Stroke& s : why_sketch(Why::dilation, gamma * beta, 5.9))
        if (s.width == 0.012 && std::abs(std::abs(s.to.y - s.from.y) - 0.1 * 0.35 / gamma) < 1e-9) {
            way += length(s);
            ++pieces;
        }
    ASSERT_GT(pieces, 10);
    EXPECT_NEAR(way / (0.1 * pieces), 0.35, 1e-9);
}

TEST(WhySketch, TheFlyingRodIsShorterByGamma)
{
    std::vector<double> rods;
    for (const Stroke& s : why_sketch(Why::length, std::sqrt(3.0), 0.8))
        if (s.width == 0.05)
            rods.push_back(length(s));
    ASSERT_EQ(rods.size(), 2u);
    EXPECT_NEAR(rods[0] / rods[1], 2, 1e-12);
}

TEST(WhySketch, EverySketchHoldsAtEverySpeed)
{
    for (int why = 1; why < int(why_names.size()); ++why)
        for (const double gamma_beta : {0.0, 1e-6, 0.1, 1.0, 30.0, 1e6})
            for (const double t : {0.0, 3.7, 5e4}) {
                Panel panel = plate({80, 80}, 4);
                const std::vector<Stroke> strokes = why_sketch(Why(why), gamma_beta, t);
                EXPECT_FALSE(strokes.empty());
                EXPECT_LT(strokes.size(), 2000u) << why_names[std::size_t(why)] << " " << gamma_beta;
                for (const Stroke& s : strokes)
                    for (const double x : {s.from.x, s.from.y, s.to.x, s.to.y, s.width, s.strength})
                        ASSERT_TRUE(std::isfinite(x) && std::abs(x) < 3);
                draw_strokes(panel, strokes, {40, 40}, 36);
                long lit = 0;
                for (std::size_t i = 0; i < panel.texels.size(); i += 2)
                    lit += panel.texels[i] > 60;
                EXPECT_GT(lit, 20) << why_names[std::size_t(why)] << " " << gamma_beta << " " << t;
            }
}

} // namespace why_sketch_test
