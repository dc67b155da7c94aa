// The scale of the instruments' false colours, as the shaders have it, to people with another colour vision.
#include "runtime/light/colour_difference.h"
#include "shaders/tone.h"
#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace false_colours_test {

using namespace starbow;

namespace {

constexpr int steps = 6;

/// A matrix as it is printed, row by row.
glm::dmat3 rows(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    return glm::transpose(glm::dmat3(a, b, c));
}

struct Vision {
    const char* name;
    glm::dmat3 seen; ///< of linear Rec. 709 light
};

/// How dichromats see, of linear light. Machado, Oliveira and Fernandes, "A physiologically-based model for simulation of
/// color vision deficiency", IEEE TVCG 15 (2009), table of severity 1.0; and Viénot, Brettel and Mollon, "Digital video
/// colourmaps for checking the legibility of displays by dichromats", Color Research and Application 24 (1999).
std::vector<Vision> visions()
{
    const glm::dmat3 cones = rows({17.8824, 43.5161, 4.11935}, {3.45565, 27.1554, 3.86714}, {0.0299566, 0.184309, 1.46709});
    const auto vienot = [&](const glm::dmat3& lost) { return glm::inverse(cones) * lost * cones; };
    return {{"normal", glm::dmat3(1)},
        {"deuteranopia, Machado",
            rows({0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881})},
        {"protanopia, Machado",
            rows({0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998})},
        {"tritanopia, Machado",
            rows({1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900})},
        {"deuteranopia, Vienot", vienot(rows({1, 0, 0}, {0.494207, 0, 1.24827}, {0, 0, 1}))},
        {"protanopia, Vienot", vienot(rows({0, 2.02344, -2.52581}, {0, 1, 0}, {0, 0, 1}))}};
}

/// CIE L*a*b* of linear Rec. 709 light on a screen whose white is D65.
glm::dvec3 lab(const glm::dvec3& light)
{
    const glm::dmat3 xyz = rows({0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505});
    return cielab(xyz * light, xyz * glm::dvec3(1));
}

} // namespace

TEST(FalseColoursTest, TheSimulationsKeepGreysAndConfuseWhatDichromatsConfuse)
{
    for (const Vision& vision : visions())
        EXPECT_LT(ciede2000(lab(glm::dvec3(0.5)), lab(glm::clamp(vision.seen * glm::dvec3(0.5), 0.0, 1.0))), 1)
            << vision.name;
    // A red and a green that differ by far are hardly two colours to a deuteranope.
    const glm::dvec3 red(0.45, 0.18, 0.05), green(0.22, 0.28, 0.05);
    EXPECT_GT(ciede2000(lab(red), lab(green)), 25);
    for (const Vision& vision : visions())
        if (std::string(vision.name).starts_with("deuteranopia")) {
            EXPECT_LT(
                ciede2000(lab(glm::clamp(vision.seen * red, 0.0, 1.0)), lab(glm::clamp(vision.seen * green, 0.0, 1.0))), 8)
                << vision.name;
        }
}

TEST(FalseColoursTest, EverybodyTellsNeighbouringStepsOfTheScaleApart)
{
    for (const Vision& vision : visions())
        for (int i = 0; i < steps; ++i) {
            const auto seen = [&](int at) {
                return lab(glm::clamp(vision.seen * tone_double::scale_colour(double(at) / steps), 0.0, 1.0));
            };
            EXPECT_GE(ciede2000(seen(i), seen(i + 1)), 10) << vision.name << ", steps " << i << " and " << i + 1;
            EXPECT_LT(seen(i + 1).x, seen(i).x - 5)
                << vision.name << ": farther is darker"; // L*, to a screen without colours
        }
}

TEST(FalseColoursTest, TheScaleHasNoBreaks)
{
    for (int i = 0; i < 600; ++i)
        EXPECT_LT(ciede2000(lab(tone_double::scale_colour(i / 600.0)), lab(tone_double::scale_colour((i + 1) / 600.0))), 1)
            << i;
    EXPECT_EQ(tone_double::scale_colour(-1), tone_double::scale_colour(0));
    EXPECT_NEAR(glm::distance(tone_double::scale_colour(2), tone_double::scale_colour(1)), 0, 1e-12);
}

} // namespace false_colours_test
