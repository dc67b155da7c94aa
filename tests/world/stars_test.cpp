// The stars without a device: the catalogue, its reader, black bodies, and the sky's orientation.
#include "config/model/angles.h"
#include "runtime/light/spectrum.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include <cmath>

namespace stars_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

const std::filesystem::path catalogue = source_dir() / "scenes/stars/stars.txt";

double apart_deg(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

glm::dvec2 chromaticity(const glm::dvec3& xyz) { return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z); }

/// The value that star.vert's black_body() reads, in double: Rec. 709, linear.
glm::dvec3 from_table(double kelvin)
{
    static const std::vector<glm::vec4> table = black_body_table(eye());
    const double at = std::log2(kelvin / STAR_COLDEST) * STAR_STEPS_PER_OCTAVE;
    const int i = std::clamp(int(at), 0, STAR_STEPS - 2);
    const glm::dvec4 entry = glm::mix(glm::dvec4(table[i]), glm::dvec4(table[i + 1]), at - i);
    return glm::dvec3(entry) * std::exp(entry.w);
}

} // namespace

TEST(StarsTest, TheShippedCatalogueHasKnownStars)
{
    const std::vector<Star> stars = load_stars(catalogue);
    EXPECT_EQ(stars.size(), 118216u);
    EXPECT_LT(std::filesystem::file_size(catalogue), 3'500'000u);
    EXPECT_TRUE(std::filesystem::exists(catalogue.parent_path() / "LICENSE"));
    int brighter_than_1_5 = 0, south = 0, known_distances = 0, eyes = 0;
    for (const Star& star : stars) {
        ASSERT_NEAR(glm::length(star.direction), 1, 1e-12);
        ASSERT_LE(star.magnitude, 14);
        ASSERT_GT(star.temperature_K, 1000);
        ASSERT_LT(star.temperature_K, 50000);
        known_distances += star.distance_m != unknown_distance_m;
        eyes += star.magnitude <= 6;
        brighter_than_1_5 += star.magnitude < 1.5;
        south += star.direction.z < 0;
    }
    EXPECT_NEAR(brighter_than_1_5, 22, 1); // 22 stars are "of first magnitude"; one more is at 1.50
    EXPECT_NEAR(south, 59108, 2000);
    EXPECT_NEAR(known_distances, 114818, 150); // some have 1000 parsecs
    EXPECT_NEAR(eyes, 5044, 60); // a good eye's
    // Sirius, Canopus and Betelgeuse: J2000 places, magnitudes and B-V from the Bright Star Catalogue.
    struct Known {
        double ra_deg, dec_deg, magnitude, b_v;
    };
    for (const Known& known : {Known{101.287155, -16.716116, -1.46, 0.00}, {95.987958, -52.695661, -0.72, 0.15},
             {88.792939, 7.407064, 0.50, 1.85}}) {
        const Star* best = &stars[0];
        for (const Star& star : stars)
            if (apart_deg(star.direction, equatorial(known.ra_deg, known.dec_deg))
                < apart_deg(best->direction, equatorial(known.ra_deg, known.dec_deg)))
                best = &star;
        EXPECT_LT(apart_deg(best->direction, equatorial(known.ra_deg, known.dec_deg)), 0.001);
        EXPECT_NEAR(best->magnitude, known.magnitude, 0.11); // catalogues differ, and Betelgeuse varies
        EXPECT_NEAR(best->temperature_K / temperature_of(known.b_v), 1, 0.15); // B-V differs by 0.35 for red variables
    }
}

TEST(StarsTest, CommentsAndBlankLinesAreNoStars)
{
    const auto stars = load_stars(write_text("few.txt", "# two\n\n  \r\n0 0 100 65 1000\r\n27000000\t9000000 -146 - -\n"));
    ASSERT_EQ(stars.size(), 2u);
    EXPECT_NEAR(glm::distance(stars[0].direction, glm::dvec3(1, 0, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::distance(stars[1].direction, glm::dvec3(0, 0, 1)), 0, 1e-12);
    EXPECT_EQ(stars[1].magnitude, -1.46);
    EXPECT_NEAR(stars[0].distance_m / parsec_m, 100, 1e-9); // 10 milliseconds of arc
    EXPECT_EQ(stars[1].distance_m, unknown_distance_m);
    EXPECT_EQ(stars[1].temperature_K, stars[0].temperature_K); // a star without B-V gets the Sun's temperature
}

TEST(StarsTest, WrongCataloguesAreRefused)
{
    struct Case {
        const char *text, *says;
    };
    for (const Case& wrong : {Case{"", ": holds no star; "}, {"# none\n", ": holds no star; "},
             {"0 0 0 0 1\n0 0 0 0\n", ":2: \"0 0 0 0\" is not a star; five columns"},
             {"0 0 0 0 - 0\n", ":1: \"0 0 0 0 - 0\" is not a star; five columns"},
             {"36000000 0 0 0 -\n",
                 ":1: \"36000000\" is not a right ascension in 1e-5 degrees; a whole number from 0 to 35999999"},
             {"-1 0 0 0 -\n", ":1: \"-1\" is not a right ascension"},
             {"0 9000001 0 0 -\n", ":1: \"9000001\" is not a declination"},
             {"0 0 1.5 0 -\n", ":1: \"1.5\" is not a magnitude in 0.01; a whole number from -3000 to 3000 is right"},
             {"0 0 99999999999 0 -\n", ":1: \"99999999999\" is not a magnitude"},
             {"0 0 0 nan -\n", ":1: \"nan\" is not a B-V in 0.01"}, {"0 0 0 -51 -\n", ":1: \"-51\" is not a B-V"},
             {"0 0 0 -- -\n", ":1: \"--\" is not a B-V"},
             {"0 0 0 0 0\n",
                 ":1: \"0\" is not a parallax in 0.01 milliseconds of arc; a whole number from 1 to 1000000 is right"}}) {
        const auto file = write_text("wrong.txt", wrong.text);
        const std::string message = complaint([&] { load_stars(file); });
        EXPECT_TRUE(message.starts_with(file.string() + wrong.says)) << message;
        EXPECT_TRUE(message.ends_with(" right")) << message;
    }
    EXPECT_NE(complaint([&] { load_stars(scratch("missing.txt")); }).find("does not exist; a catalogue"), std::string::npos);
    EXPECT_NE(complaint([&] { load_stars(source_dir()); }).find("is a folder; a catalogue"), std::string::npos);
}

TEST(StarsTest, MutatedCataloguesLoadOrAreRefused)
{
    expect_survives(load_stars, {"# three stars\n8879290 740710 45 150 655\n7863450 -820160 18 -3 378\n0 0 600 - -\n"});
}

TEST(StarsTest, KnownColoursHaveTheirTemperatures)
{
    EXPECT_NEAR(temperature_of(0.65), 5772, 30); // the Sun
    EXPECT_NEAR(temperature_of(0.00), 9602, 700); // Vega; the formula is right to a few percent
    EXPECT_NEAR(temperature_of(1.85), 3500, 300); // Betelgeuse
    for (double b_v = -0.5; b_v < 6; b_v += 0.01)
        EXPECT_GT(temperature_of(b_v), temperature_of(b_v + 0.01));
}

TEST(StarsTest, BlackBodiesHaveTheirColour)
{
    // Textbook chromaticities (CIE 1931) of black bodies. They hold to about the last digit, because the second radiation
    // constant was different before 2018.
    const double known[][3]
        = {{2856, 0.4475, 0.4074}, {5772, 0.3266, 0.3358}, {10000, 0.2806, 0.2883}, {45443, 0.2462, 0.2433}};
    for (const auto& [kelvin, x, y] : known) {
        EXPECT_NEAR(chromaticity(black_body_xyz(kelvin)).x, x, 0.002) << kelvin;
        EXPECT_NEAR(chromaticity(black_body_xyz(kelvin)).y, y, 0.002) << kelvin;
    }
    EXPECT_NEAR(black_body_xyz(5772).y, 1, 1e-12);
}

// A point's light is that of a black body at D T from a solid angle of D^-2. The Sun is brightest at D = 2.90, 2.88 times as
// bright as at rest; above that its peak leaves the visible range.
TEST(StarsTest, TheSunIsBrightestAtD2_9)
{
    auto brightness = [](double D) { return black_body_xyz(D * 5772).y / (D * D); };
    EXPECT_NEAR(brightness(2.90), 2.88, 0.01); // the textbook gives two decimals
    EXPECT_GT(brightness(2.90), brightness(2.80));
    EXPECT_GT(brightness(2.90), brightness(3.00));
}

TEST(StarsTest, TheTableIsTheIntegral)
{
    for (double kelvin = 530; kelvin < 2e6; kelvin *= 1.0173) {
        const glm::dvec3 expected = rec709_from_sunlit_xyz() * black_body_xyz(kelvin), tabulated = from_table(kelvin);
        // The header's bound on the luminance. The primaries are interpolated linearly between steps of 1.1 %.
        EXPECT_NEAR(glm::length(tabulated - expected) / glm::length(expected), 0, kelvin < 2000 ? 1.5e-3 : 2e-4) << kelvin;
    }
}

// The picture is for an eye adapted to sunlight, so that such a star is as white as a sunlit grey.
TEST(StarsTest, AStarLikeTheSunIsWhite)
{
    const glm::dvec3 sun = from_table(5772);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sun[c], 1, 2e-4); // the table's accuracy
    EXPECT_GT(from_table(5000).r, from_table(5000).b);
    EXPECT_LT(from_table(6500).r, from_table(6500).b);
}

TEST(StarsTest, TheSkyIsRotatedAndNotMirrored)
{
    for (const glm::dvec2& ahead : {glm::dvec2(0, 0), {84, -19}, {250, 40}, {10, 90}}) {
        const glm::dmat3 turn = world_from_equatorial(ahead);
        EXPECT_NEAR(glm::determinant(turn), 1, 1e-12);
        EXPECT_NEAR(glm::distance(turn * equatorial(ahead.x, ahead.y), glm::dvec3(0, 0, -1)), 0, 1e-12);
        EXPECT_GT((turn * equatorial(ahead.x, ahead.y - 1)).z, -1 + 1e-6);
        EXPECT_LT((turn * equatorial(ahead.x, ahead.y - 1)).y, 0) << "south is down";
        // A degree east of the point ahead, along its parallel.
        const glm::dvec3 east = glm::normalize(equatorial(ahead.x, ahead.y)
            + 0.01 * glm::dvec3(-std::sin(glm::radians(ahead.x)), std::cos(glm::radians(ahead.x)), 0));
        EXPECT_LT((turn * east).x, 0) << "east is on the left when north is up";
    }
}

TEST(StarsTest, FiveMagnitudesAreAFactorOf100)
{
    const StarSky sky{"", 500, {0, 0}};
    const std::vector<Star> stars = {{{1, 0, 0}, 0, 5772}, {{1, 0, 0}, 5, 9000}};
    std::vector<shared::StarEntry> entries(stars.size());
    stars_from(star_field(stars, sky, 1), {0, 0, 0}, entries);
    const double arcmin = pi / 10800;
    EXPECT_NEAR(entries[0].light.y / (500 * arcmin * arcmin), 1, 1e-6);
    EXPECT_NEAR(entries[0].light.y / entries[1].light.y, 100, 1e-4);
    for (std::size_t i = 0; i < 2; ++i) // a star's light at rest does not depend on its temperature
        EXPECT_NEAR(entries[i].light.x * black_body_xyz(stars[i].temperature_K).y / entries[i].light.y, 1, 1e-6);
}

} // namespace stars_test
