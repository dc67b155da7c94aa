// The table of reflected surroundings against closed forms and plain sums over all directions.
#include "runtime/light/gloss.h"
#include "shaders/shared_structs.h"
#include <cmath>
#include <gtest/gtest.h>

namespace starbow::gloss_test {
namespace {

constexpr double pi_ = 3.14159265358979;

double part_of(int i) { return double(i) / (GLOSS_TABLE - 1); }

/// Calls each(direction, solid angle) for 400 x 800 directions above z = 0.
template <typename Each> void each_direction(Each each)
{
    constexpr int rows = 400;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < 2 * rows; ++j) {
            const double polar = 0.5 * pi_ * (i + 0.5) / rows, turn = pi_ * (j + 0.5) / rows;
            each(glm::dvec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)),
                std::sin(polar) * 0.5 * pi_ / rows * pi_ / rows);
        }
}

TEST(GlossTable, AMirrorReflectsAllAndFresnelsPartAsWhite)
{
    // Near the horizon even the least roughness shows: the first column is left out.
    for (int i = 2; i < GLOSS_TABLE; ++i) {
        const double grazing = std::pow(1 - part_of(i), 5);
        EXPECT_NEAR(double(gloss_table()[std::size_t(i)].metal), 1 - grazing, 0.004) << i;
        EXPECT_NEAR(double(gloss_table()[std::size_t(i)].white), grazing, 0.004) << i;
        const double height = 2 * part_of(i) - 1, up = std::max(height, 0.0);
        EXPECT_NEAR(double(gloss_table()[std::size_t(i)].above), up * up * (3 - 2 * up), 0.004) << i;
    }
}

TEST(GlossTable, RoughSurfacesReflectTheSumOverAllDirections)
{
    for (int row : {10, 20, 31})
        for (int column : {4, 15, 31}) {
            const double square = std::pow(part_of(row), 4), cosine = part_of(column);
            const glm::dvec3 eye(std::sqrt(1 - cosine * cosine), 0, cosine);
            double metal = 0, white = 0, grazing_mean = 0;
            each_direction([&](const glm::dvec3& light, double angle) {
                const glm::dvec3 h = glm::normalize(eye + light);
                const double grazing = std::pow(1 - glm::dot(eye, h), 5);
                // The standard's own forms: the distribution, and the height-correlated shadowing (Heitz 2014).
                const double D = square / (pi_ * std::pow(h.z * h.z * (square - 1) + 1, 2));
                const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1 + square * (1 / (c * c) - 1)) - 1); };
                const double G = 1 / (1 + lambda(eye.z) + lambda(light.z));
                const double part = D * G / (4 * eye.z) * angle;
                metal += part * (1 - grazing), white += part * grazing;
                grazing_mean += grazing * light.z / pi_ * angle;
            });
            const GlossTexel& texel = gloss_table()[std::size_t(row) * GLOSS_TABLE + std::size_t(column)];
            EXPECT_NEAR(double(texel.metal), metal, 0.002) << row << ' ' << column;
            EXPECT_NEAR(double(texel.white), white, 0.002) << row << ' ' << column;
            EXPECT_NEAR(double(texel.grazing), grazing_mean, 0.002) << column;
            EXPECT_LE(texel.metal + texel.white, 1.0f) << "more light than there is";
        }
}

TEST(GlossTable, TheUpperAndTheLowerSkyShareTheRest)
{
    for (int row = 0; row < GLOSS_TABLE; ++row)
        for (int column = 0; column < GLOSS_TABLE; ++column) {
            const auto above = [&](int at) { return gloss_table()[std::size_t(row) * GLOSS_TABLE + std::size_t(at)].above; };
            EXPECT_LE(above(column) + above(GLOSS_TABLE - 1 - column), 1.0001f);
            if (column > 0) {
                EXPECT_GE(above(column), above(column - 1) - 1e-4f) << row << ' ' << column;
            }
        }
}

} // namespace
} // namespace starbow::gloss_test
