// The sky's names and the constellations' figures: the shipped file against the catalogue of stars, the device's table
// against all lines tried one by one, and wrong files.
#include "config/model/angles.h"
#include "config/model/shipped.h"
#include "runtime/world/sky_names.h"
#include "runtime/world/stars.h"
#include "shaders/shared_structs.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <random>

namespace sky_names_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

const std::filesystem::path shipped_names = source_dir() / "scenes/stars/names.json";

double apart_deg(const dvec3& a, const dvec3& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / degree;
}

/// The angle from a direction to a line, by two hundred places along it.
double from_line_deg(const dvec3& n, const dvec3& a, const dvec3& b)
{
    double least = 180;
    for (int i = 0; i <= 200; ++i)
        least = std::min(least, apart_deg(n, glm::normalize(glm::mix(a, b, i / 200.0))));
    return least;
}

std::string message_for(const std::string& text)
{
    try {
        load_sky_names(write_text("names.json", text));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST(SkyNames, FiguresLeadFromStarToStar)
{
    const SkyNames names = load_sky_names(shipped_names);
    const std::vector<Star> stars = load_stars(source_dir() / "scenes/stars/stars.txt");
    EXPECT_EQ(names.constellations.size(), 88u); // of the International Astronomical Union
    int ends = 0, at_stars = 0;
    for (const Constellation& one : names.constellations)
        for (const auto& line : one.lines)
            for (const dvec3& end : line) {
                EXPECT_NEAR(glm::length(end), 1, 1e-12);
                double nearest = 180;
                for (std::size_t i = 0; i < 6000; ++i) // down to magnitude 6.1
                    nearest = std::min(nearest, apart_deg(end, stars[i].direction));
                ++ends, at_stars += nearest < 0.05;
            }
    EXPECT_GT(ends, 600);
    EXPECT_GT(at_stars, 0.97 * ends);
    EXPECT_EQ(names.stars.front().name, "Sirius");
    EXPECT_LT(apart_deg(names.stars.front().direction, stars.front().direction), 0.01);
    for (const NamedStar& one : names.stars) {
        double nearest = 180;
        for (std::size_t i = 0; i < 200; ++i)
            nearest = std::min(nearest, apart_deg(one.direction, stars[i].direction));
        EXPECT_LT(nearest, 0.02) << one.name;
    }
}

TEST(SkyNames, EachHasANameInEveryShippedLanguage)
{
    const SkyNames names = load_sky_names(shipped_names);
    for (const auto& file : shipped("config/words")) {
        const std::string language = file.stem().string();
        for (const Constellation& one : names.constellations)
            EXPECT_TRUE(one.names.contains(language)) << name_in(one.names, "en");
        for (const auto& [globe, words] : names.globes)
            EXPECT_TRUE(words.contains(language)) << globe;
    }
    EXPECT_EQ(name_in(names.globes.at("Earth"), "de"), "Erde");
    EXPECT_EQ(name_in(names.globes.at("Earth"), "xx"), "Earth");
}

// The shader looks a direction's cell up, and only there.
TEST(SkyNames, ACellHasEveryLineThatIsNear)
{
    const SkyNames names = load_sky_names(shipped_names);
    const glm::dmat3 turn = world_from_equatorial({84, -5});
    const std::vector<glm::vec4> table = figure_table(names, turn);
    EXPECT_LT(table.size(), 65536u) << "every device reads so many";
    std::vector<std::pair<dvec3, dvec3>> lines;
    for (const Constellation& one : names.constellations)
        for (const auto& line : one.lines)
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                lines.emplace_back(turn * line[i], turn * line[i + 1]);
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    long near = 0, listed = 0;
    for (int i = 0; i < 200; ++i) {
        const dvec3 n = glm::normalize(dvec3(any(random), any(random), any(random)));
        const int row = std::min(int(std::acos(n.z) / pi * FIGURE_ROWS), FIGURE_ROWS - 1),
                  column = std::min(int((std::atan2(n.y, n.x) / (2 * pi) + 0.5) * FIGURE_COLUMNS), FIGURE_COLUMNS - 1);
        const glm::vec4& cell = table[std::size_t(row) * FIGURE_COLUMNS + std::size_t(column)];
        for (const auto& [a, b] : lines) {
            bool has = false;
            for (int k = 0; k < int(cell.y); ++k)
                has = has
                    || (glm::distance(dvec3(table[std::size_t(cell.x) + 2 * std::size_t(k)]), a) < 1e-6
                        && glm::distance(dvec3(table[std::size_t(cell.x) + 2 * std::size_t(k) + 1]), b) < 1e-6);
            listed += has;
            if (from_line_deg(n, a, b) * degree < FIGURE_REACH) {
                ++near;
                EXPECT_TRUE(has);
            }
        }
    }
    EXPECT_GT(near, 150);
    EXPECT_LT(listed, 4 * near) << "a cell has few that are far";
}

TEST(SkyNames, WrongFilesAreRefused)
{
    const std::string rest = R"("stars": [], "globes": [])";
    EXPECT_EQ(message_for("{ \"constellations\": [], " + rest + " }"), "");
    EXPECT_NE(message_for("{ " + rest + " }"), "");
    EXPECT_NE(message_for(R"({ "constellations": [{ "de": "Adler", "rank": 1, "at": [0, 0], "lines": [] }], )" + rest + " }")
                  .find("no name in English"),
        std::string::npos);
    EXPECT_NE(
        message_for(R"({ "constellations": [{ "en": "Aquila", "rank": 4, "at": [0, 0], "lines": [] }], )" + rest + " }"),
        "");
    EXPECT_NE(
        message_for(R"({ "constellations": [{ "en": "Aquila", "rank": 1, "at": [0, 91], "lines": [] }], )" + rest + " }")
            .find("beyond the pole"),
        std::string::npos);
    EXPECT_NE(message_for(R"({ "constellations": [{ "en": "Aquila", "rank": 1, "at": [0, 9], "lines": [[[1, 2]]] }], )"
                  + rest + " }"),
        "");
    EXPECT_NE(message_for(R"({ "constellations": [], "stars": [], "globes": [], "planets": [] })"), "");
}

} // namespace sky_names_test
