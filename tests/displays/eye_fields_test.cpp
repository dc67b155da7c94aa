// What an eye sees of a layout's pixels: solid angles against closed forms, and overlaps that count once.
#include "displays/check/eye_fields.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace eye_fields_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr double pi = 3.14159265358979324;
constexpr double half_degree = 0.5 * pi / 180;

Layout shipped(const std::string& name) { return load_layout(source_dir() / "config/layouts" / (name + ".json")); }

double sky(const EyeField& field)
{
    return std::accumulate(field.pixels.begin(), field.pixels.end(), 0.0,
        [](double sum, const EyePixel& pixel) { return sum + pixel.solid_angle_sr; });
}

} // namespace

TEST(EyeFieldsTest, AWindowAndADomeHaveTheirSolidAngles)
{
    const std::vector<EyeField> desk = eye_fields(seen_layout(shipped("desk"), half_degree));
    ASSERT_EQ(desk.size(), 1u);
    EXPECT_EQ(desk[0].eye, Eye::middle);
    // A rectangle from its axis: 4 asin(sin a sin b) for half angles whose tangents are tan 30 degrees and 4/3 of that.
    const double a = pi / 6, b = std::atan(4.0 / 3 * std::tan(pi / 6));
    EXPECT_NEAR(sky(desk[0]), 4 * std::asin(std::sin(a) * std::sin(b)), 0.003);

    const std::vector<EyeField> dome = eye_fields(seen_layout(shipped("dome"), half_degree));
    ASSERT_EQ(dome.size(), 1u);
    EXPECT_NEAR(sky(dome[0]), 2 * pi, 0.02);
    for (const EyePixel& pixel : dome[0].pixels) {
        ASSERT_NEAR(glm::length(pixel.direction), 1, 1e-6);
        ASSERT_LT(pixel.solid_angle_sr, 1.1 * half_degree * half_degree);
    }
}

TEST(EyeFieldsTest, NoPictureIsEnlarged)
{
    Layout desk = shipped("desk");
    EXPECT_EQ(seen_layout(desk, 1e-4).outputs[0].size, desk.outputs[0].size);
    const Layout coarse = seen_layout(desk, half_degree);
    EXPECT_NEAR(coarse.outputs[0].size.y, 60 / 0.5 * 1.1, 20); // the middle's pixels are the widest
    EXPECT_NEAR(double(coarse.outputs[0].size.x) / coarse.outputs[0].size.y, 4.0 / 3, 0.02);
}

TEST(EyeFieldsTest, WallsOfACaveAreAllTheSkyButOneSide)
{
    const std::vector<EyeField> cave = eye_fields(seen_layout(shipped("cave5"), 2 * half_degree));
    ASSERT_EQ(cave.size(), 1u);
    EXPECT_NEAR(sky(cave[0]), 4 * pi * 5 / 6, 0.05);
}

TEST(EyeFieldsTest, ProjectorsThatOverlapCountOnceAndAreUndimmed)
{
    const std::vector<EyeField> dome = eye_fields(seen_layout(shipped("dome2"), half_degree));
    ASSERT_EQ(dome.size(), 1u);
    EXPECT_NEAR(sky(dome[0]), 2 * pi, 0.08); // to the rim's pixels
    std::size_t outputs[2] = {0, 0};
    for (const EyePixel& pixel : dome[0].pixels) {
        ++outputs[pixel.output];
        ASSERT_EQ(pixel.factor, glm::dvec3(1));
    }
    EXPECT_GT(outputs[0], 1000u);
    EXPECT_GT(outputs[1], 1000u);
}

TEST(EyeFieldsTest, EachEyeOfAHeadsetOfAPairAndOfGlassesSeesItsOwn)
{
    for (const char* name : {"headset", "stereo", "passive-pair", "anaglyph", "tv3d"}) {
        const std::vector<EyeField> eyes = eye_fields(seen_layout(shipped(name), half_degree));
        ASSERT_EQ(eyes.size(), 2u) << name;
        EXPECT_EQ(eyes[0].eye, Eye::left) << name;
        EXPECT_EQ(eyes[1].eye, Eye::right) << name;
        EXPECT_NEAR(sky(eyes[0]), sky(eyes[1]), 0.02 * sky(eyes[0])) << name;
        EXPECT_GT(eyes[0].pixels.size(), 500u) << name;
    }
}

TEST(EyeFieldsTest, AnOperatorsWindowIsLeftOutAndTwoObserversAreTwoSkies)
{
    const Layout seen = seen_layout(shipped("operator-dome"), half_degree);
    ASSERT_EQ(seen.outputs.size(), 1u);
    EXPECT_EQ(eye_fields(seen).size(), 1u);
    EXPECT_EQ(eye_fields(seen_layout(shipped("alice-bob"), half_degree)).size(), 2u);
}

TEST(EyeFieldsTest, EveryShippedLayoutIsSeen)
{
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "config/layouts"))
        if (entry.path().extension() == ".json") {
            const std::vector<EyeField> fields = eye_fields(seen_layout(load_layout(entry.path()), 2 * half_degree));
            ASSERT_FALSE(fields.empty()) << entry.path();
            for (const EyeField& field : fields)
                EXPECT_GT(sky(field), 0.05) << entry.path();
        }
}

} // namespace eye_fields_test
