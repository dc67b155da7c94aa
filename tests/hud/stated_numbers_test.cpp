// Each number in the texts of challenges and goals, in every language: it is the number with which the program checks, tried
// just on either side, and that of the physics that the text claims, by school formulas. A number that is not listed fails.
#include "runtime/hud/challenges.h"
#include "runtime/hud/lab_log.h"
#include "tests/support/files.h"
#include "tests/support/words_files.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

namespace stated_numbers_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr double deg = 3.14159265358979324 / 180, little = 1e-6;

nlohmann::json file_of(const std::filesystem::path& file)
{
    return nlohmann::json::parse(read_text(source_dir() / "config" / file), nullptr, true, true);
}

double gamma_of(double beta) { return 1 / std::sqrt(1 - beta * beta); }
double beta_of(double gamma) { return std::sqrt(1 - 1 / (gamma * gamma)); }
double D_ahead(double beta) { return std::sqrt((1 + beta) / (1 - beta)); }
/// The speed at which light from straight ahead is shifted by D.
double beta_for(double D) { return (D * D - 1) / (D * D + 1); }

const std::map<std::string, std::vector<std::string>>& figures()
{
    static const std::map<std::string, std::vector<std::string>> all{{"goal.avenue.fast", {"80"}},
        {"goal.avenue.fast-done", {"80"}}, {"goal.avenue.younger", {"20"}}, {"goal.avenue.younger-done", {"20"}},
        {"goal.solar-system.moon-done", {"1.3"}}, {"goal.solar-system.late", {"60"}}, {"goal.clocks.younger", {"10"}},
        {"goal.twins.younger", {"3"}}, {"goal.gamow.tram", {"3"}}, {"challenge.slow_clock_check", {"0.01", "0.1", "0.10"}},
        {"challenge.slow_clock_hint_c", {"0", "0.1", "1"}}, {"challenge.own_colour_check", {"0.5", "1", "4", "5"}},
        {"challenge.own_colour_hint_a", {"1"}}, {"challenge.own_colour_hint_b", {"1"}},
        {"challenge.own_colour_hint_c", {"1"}}, {"challenge.red_to_green_ask", {"550", "650"}},
        {"challenge.red_to_green_tools", {"550"}}, {"challenge.red_to_green_check", {"20", "530", "550", "570", "650"}},
        {"challenge.red_to_green_hint_b", {"550", "650"}}, {"challenge.red_to_green_hint_c", {"1"}},
        {"challenge.two_lengths_tools", {"0.8"}}, {"challenge.two_lengths_check", {"0.1", "5"}},
        {"challenge.half_size_check", {"0.02"}}, {"challenge.half_size_hint_c", {"1", "2"}},
        {"challenge.same_light_check", {"0.3", "0.5"}}, {"challenge.younger_check", {"0.5", "10", "2", "5"}},
        {"challenge.younger_hint_b", {"2"}}, {"challenge.younger_hint_c", {"10", "4"}},
        {"challenge.same_time_check", {"0", "0.1", "0.2", "0.3", "5"}},
        {"challenge.half_rate_check", {"0.05", "0.1", "0.50", "1", "90"}}, {"challenge.half_rate_hint_a", {"90"}},
        {"challenge.half_rate_hint_c", {"1", "2"}}, {"challenge.behind_ahead_ask", {"150", "45"}},
        {"challenge.behind_ahead_check", {"150", "45"}},
        {"challenge.behind_ahead_hint_c", {"1", "150", "2", "4.5", "45", "9"}}};
    return all;
}

/// A log's line with these cells alone.
LabLine line(long number, const std::map<std::string, double>& cells)
{
    LabLine made{.line = number, .values = {}};
    std::stringstream header(log_header());
    std::size_t found = 0;
    for (std::string name; std::getline(header, name, ',');) {
        const auto cell = cells.find(name);
        made.values.push_back(cell == cells.end() ? std::nan("") : cell->second);
        found += cell != cells.end();
    }
    EXPECT_EQ(found, cells.size()) << "a column's name is wrong";
    return made;
}

bool solves(const char* name, const std::vector<LabLine>& lines)
{
    for (const Challenge& challenge : challenges())
        if (challenge.name == std::string(name)) {
            const auto finding = challenge.look(lines);
            return finding && finding->solved;
        }
    ADD_FAILURE() << name;
    return false;
}

/// Solved from `from` to `to`, and just not outside; an infinite end is no end.
template <class Lines> void expect_between(const char* name, double from, double to, const Lines& lines)
{
    SCOPED_TRACE(name);
    for (const auto& [end, out] : {std::pair(from, -1.), {to, 1.}})
        if (std::isfinite(end)) {
            EXPECT_TRUE(solves(name, lines(end - out * little))) << end;
            EXPECT_FALSE(solves(name, lines(end + out * little))) << end;
        }
}

double u_of(double beta) { return beta * gamma_of(beta); }

} // namespace

TEST(StatedNumbers, EachIsListed)
{
    const std::regex names("F1|--log-every 0\\.1"); // of a key and of an option
    const nlohmann::json english = words_file("en"), german = words_file("de");
    std::size_t met = 0;
    for (const auto& [key, text] : english.items())
        if (key.starts_with("challenge.") || key.starts_with("goal.")) {
            const auto listed = figures().find(key);
            const std::vector<std::string> all = listed == figures().end() ? std::vector<std::string>{} : listed->second;
            EXPECT_EQ(numbers_in(text, false, names), all) << key;
            EXPECT_EQ(numbers_in(german.at(key), true, names), all) << key;
            met += !all.empty();
        }
    EXPECT_EQ(met, figures().size());
}

TEST(StatedNumbers, ChallengesAreCheckedWithThem)
{
    using Lines = std::vector<LabLine>;
    // challenge.slow_clock_check, at one place of a resting log's world: 0.10 +- 0.01.
    expect_between("slow-clock", 0.09, 0.11, [](double rate) {
        std::map<std::string, double> cells{{"gamma", 1}, {"gamma_beta_x", 0}, {"gamma_beta_y", 0}, {"gamma_beta_z", 0},
            {"place_x_light_s", 0}, {"place_y_light_s", 0}, {"place_z_light_s", 0}, {"ship_time_s", 0}, {"mark_1_number", 1},
            {"mark_1_clock_s", 0}};
        Lines both{line(2, cells)};
        cells["ship_time_s"] = 1, cells["mark_1_clock_s"] = rate;
        both.push_back(line(3, cells));
        return both;
    });
    // challenge.own_colour_check: beta of 0.5 or more, within 1 degree.
    const auto own_colour = [](double beta, double off) {
        const double angle = std::acos((1 - 1 / gamma_of(beta)) / beta) / deg + off;
        return Lines{line(
            2, {{"aberration_on", 1}, {"aim_relative_gamma_beta", u_of(beta)}, {"aim_from_relative_motion_deg", angle}})};
    };
    expect_between("own-colour", 0.5, INFINITY, [&](double beta) { return own_colour(beta, 0); });
    expect_between("own-colour", -1, 1, [&](double off) { return own_colour(0.8, off); });
    expect_between("red-to-green", 530, 570, [](double nm) {
        return Lines{line(2, {{"aim_relative_gamma_beta", 0.2}, {"aim_doppler", 650 / nm}})};
    });
    const auto sized = [](double part, double nearer) {
        const std::map<std::string, double> first{{"aberration_on", 1}, {"marks_angle_deg", 10}, {"mark_1_number", 1},
            {"mark_2_number", 2}, {"mark_1_distance_light_s", 30}};
        std::map<std::string, double> later = first;
        later["marks_angle_deg"] *= part, later["mark_1_distance_light_s"] -= nearer;
        return Lines{line(2, first), line(3, later)};
    };
    expect_between("half-size", -INFINITY, 0.5, [&](double part) { return sized(part, 1); });
    expect_between("half-size", 0, INFINITY, [&](double nearer) { return sized(0.4, nearer); });
    // challenge.same_light_check: beta 0.3 or more apart, places and times at most 0.5 s together, and no more of the clock.
    const auto same_light = [](double beta, double apart, double change) {
        const std::map<std::string, double> first{{"beta", 0.1}, {"place_x_light_s", 0}, {"place_y_light_s", 0},
            {"place_z_light_s", 0}, {"world_time_s", 5}, {"mark_1_number", 1}, {"mark_1_clock_s", 2}};
        std::map<std::string, double> later = first;
        later["beta"] += beta, later["place_x_light_s"] = 0.4 * apart, later["world_time_s"] += 0.6 * apart;
        later["mark_1_clock_s"] += change;
        return Lines{line(2, first), line(3, later)};
    };
    expect_between("same-light", 0.3, INFINITY, [&](double beta) { return same_light(beta, 0, 0); });
    expect_between("same-light", -INFINITY, 0.5, [&](double apart) { return same_light(0.4, apart, 0); });
    EXPECT_TRUE(solves("same-light", same_light(0.4, 0.25, 0.2499)));
    EXPECT_FALSE(solves("same-light", same_light(0.4, 0.25, 0.2501)));
    // challenge.younger_check: 5 light-seconds away, back within 2, 10 s later, half the time on board.
    const auto younger = [](double away, double back, double world_s, double part) {
        const auto at = [&](long number, double x, double world, double ship, double beta) {
            return line(number,
                {{"place_x_light_s", x}, {"place_y_light_s", 0}, {"place_z_light_s", 0}, {"world_time_s", world},
                    {"ship_time_s", ship}, {"beta", beta}});
        };
        return Lines{at(2, 0, 0, 0, 0), at(3, away, 0.5 * world_s, 0.5 * part * world_s, 0.9),
            at(4, back, world_s, part * world_s, 0)};
    };
    expect_between("younger", 5, INFINITY, [&](double away) { return younger(away, 0, 30, 0.4); });
    expect_between("younger", -INFINITY, 2, [&](double back) { return younger(10, back, 30, 0.4); });
    expect_between("younger", 10, INFINITY, [&](double world_s) { return younger(10, 0, world_s, 0.4); });
    expect_between("younger", -INFINITY, 0.5, [&](double part) { return younger(10, 0, 30, part); });
    // challenge.same_time_check: 5 light-seconds apart, 0.3 c, within 0.2 s.
    const auto same_time = [](double apart, double beta, double length) {
        return Lines{line(2,
            {{"marks_clock_2_minus_1_s", apart}, {"marks_relative_gamma_beta", u_of(beta)},
                {"marks_rest_length_light_s", length}, {"marks_from_motion_at_rest_deg", 0}})};
    };
    expect_between("same-time", -0.2, 0.2, [&](double apart) { return same_time(apart, 0.8, 14); });
    expect_between("same-time", 0.3, INFINITY, [&](double beta) { return same_time(0, beta, 14); });
    expect_between("same-time", 5, INFINITY, [&](double length) { return same_time(0, 0.8, length); });
    // challenge.half_rate_check: 90 +- 1 degrees, 0.50 +- 0.05.
    const auto half_rate = [](double angle, double D) {
        return Lines{line(2, {{"aim_from_relative_motion_deg", angle}, {"aim_doppler", D}})};
    };
    expect_between("half-rate", 89, 91, [&](double angle) { return half_rate(angle, 0.5); });
    expect_between("half-rate", 0.45, 0.55, [&](double D) { return half_rate(90, D); });
    // challenge.behind_ahead_check: 150 degrees or more, 45 at most.
    const auto behind = [](double world, double seen) {
        return Lines{
            line(2, {{"aberration_on", 1}, {"aim_from_motion_in_world_deg", world}, {"aim_from_motion_deg", seen}})};
    };
    expect_between("behind-ahead", 150, INFINITY, [&](double world) { return behind(world, 40); });
    expect_between("behind-ahead", -INFINITY, 45, [&](double seen) { return behind(160, seen); });
}

TEST(StatedNumbers, ChallengesSayWhatThePhysicsDoes)
{
    // slow_clock: a change of rapidity by 0.1 changes D by a tenth; there is a speed for 0.1, and none for 0.
    EXPECT_NEAR(std::exp(0.1), 1.1, 0.01);
    EXPECT_NEAR(D_ahead(-beta_for(10)), 0.1, 1e-12);
    EXPECT_GT(D_ahead(-0.999999999), 0);
    // own_colour: at D = 1 the angle changes D by -gamma beta sin, a degree by less than 5 % up to gamma 4, and beyond
    // later.
    for (double gamma = gamma_of(0.5); gamma <= 4; gamma += 0.01) {
        const double beta = beta_of(gamma), cosine = (1 - 1 / gamma) / beta;
        EXPECT_NEAR(1 / (gamma * (1 - beta * cosine)), 1, 1e-12);
        EXPECT_GT(cosine, 0) << "further ahead than abeam, where D is 1/gamma";
        for (const double side : {-1., 1.})
            EXPECT_LT(std::abs(1 / (gamma * (1 - beta * std::cos(std::acos(cosine) + side * deg))) - 1), 0.05) << gamma;
    }
    // red_to_green: about a sixth of the speed of light.
    EXPECT_NEAR(beta_for(650. / 550), 1. / 6, 0.003);
    // two_lengths: the train's 0.8 c; half a light-second of different ways is half a second at 0.8 c, 5 % of the train.
    const nlohmann::json train = file_of("scenes/train.json");
    EXPECT_NEAR(train["bodies"][0]["velocity"]["beta"].get<double>(), 0.8, 1e-12);
    EXPECT_NEAR(0.5 * 0.8 / (14 / gamma_of(0.8)), 0.05, 0.005);
    // Coming straight it looks D = 3 times as long as contracted, which is more than at rest; leaving, a third.
    EXPECT_GT(D_ahead(0.8) / gamma_of(0.8), 1);
    EXPECT_LT(D_ahead(-0.8), 1);
    // half_size: gamma (1 + beta) is 2 at 0.6 c.
    EXPECT_NEAR(gamma_of(0.6) * 1.6, 2, 1e-12);
    // younger: 10 light-seconds out and back at gamma 4, with two turns and a start of a second each at rest.
    const double way_s = 20 / beta_of(4);
    EXPECT_NEAR(1 / 2., 0.5, 1e-12); // on board over world at gamma 2
    EXPECT_LT((way_s / 4 + 3) / (way_s + 3), 0.5);
    // same_time: from beside the track, where the challenge begins, the difference changes by up to 0.2 s in 0.1 s. At x
    // along the train the dials at +-7 are sqrt((x -+ 7)^2 + across^2) away; x changes by gamma beta a second.
    double most = 0;
    for (double x = -20; x < 20; x += 0.01) {
        const double across = std::hypot(2.2 - 1.38, 14 - 0.98), step = 0.1 * u_of(0.8);
        const auto apart = [&](double at) { return std::hypot(at - 7, across) - std::hypot(at + 7, across); };
        most = std::max(most, std::abs(apart(x + step) - apart(x)));
    }
    EXPECT_LT(most, 0.2);
    EXPECT_GT(most, 0.1);
    // half_rate: 1/gamma is a half, and changes by nearly a tenth with a rapidity of 0.1.
    const double rapidity = std::acosh(2.);
    EXPECT_NEAR(std::cosh(rapidity + 0.1) / 2 - 1, 0.09, 0.005);
    // behind_ahead: the factor 9, and gamma above 4.5.
    const double factor = std::tan(75 * deg) / std::tan(22.5 * deg), gamma = 0.5 * (factor + 1 / factor);
    EXPECT_NEAR(factor, 9, 0.05);
    EXPECT_GT(gamma, 4.5);
    EXPECT_LT(gamma, 4.6);
}

TEST(StatedNumbers, GoalsAreCheckedWithThem)
{
    std::map<std::string, nlohmann::json> goals;
    for (const std::filesystem::path& file : shipped("config/scenes"))
        for (const nlohmann::json& goal : file_of("scenes" / file.filename()).value("goals", nlohmann::json::array()))
            goals[goal["ask"].get<std::string>().substr(5)] = goal["conditions"];
    const auto condition = [&](const char* goal, const char* quantity) -> nlohmann::json {
        for (const nlohmann::json& one : goals[goal])
            if (one["measure"]["quantity"] == quantity)
                return one;
        ADD_FAILURE() << goal << " does not ask for " << quantity;
        return {{"from", NAN}, {"below", NAN}};
    };
    const auto from
        = [&](const char* goal, const char* quantity) { return condition(goal, quantity)["from"].get<double>(); };
    const auto to = [&](const char* goal, const char* quantity) { return condition(goal, quantity)["below"].get<double>(); };
    EXPECT_EQ(from("avenue.fast", "beta"), 0.8);
    EXPECT_NEAR(1 / gamma_of(0.8), 3. / 5, 1e-12) << "three seconds in five";
    EXPECT_EQ(from("avenue.younger", "younger_s"), 20);
    // The Moon's mean distance, 384,400 km.
    EXPECT_NEAR(from("solar-system.moon", "distance"), 384400 / 299792.458, 0.003);
    EXPECT_NEAR(384400 / 299792.458, 1.3, 0.05);
    EXPECT_EQ(from("solar-system.late", "distance"), 60) << "a minute ago";
    EXPECT_EQ(from("clocks.ahead", "doppler_ahead"), 3) << "three times as fast";
    EXPECT_EQ(from("clocks.younger", "younger_s"), 10);
    EXPECT_EQ(from("twins.younger", "younger_s"), 3);
    // A tram's 3 metres a second, of 5 of light: a fifth of the time is lost.
    const double light_m_s = file_of("scenes/gamow.json")["light_speed_m_s"];
    EXPECT_NEAR(0.5 * (from("gamow.tram", "beta") + to("gamow.tram", "beta")) * light_m_s, 3, 1e-9);
    EXPECT_NEAR(1 - 1 / gamma_of(3 / light_m_s), 0.2, 1e-12);
    // InsetView what moves: the speeds that count lie around its own.
    const struct {
        const char* goal;
        double beta;
    } beside[] = {{"train.along", 0.8}, {"alice-and-bob.bob", 0.5}, {"light-clock.along", 0.6}};
    for (const auto& [goal, beta] : beside) {
        EXPECT_LT(from(goal, "doppler"), D_ahead(beta)) << goal;
        EXPECT_GT(to(goal, "doppler"), D_ahead(beta)) << goal;
        EXPECT_NEAR(beta_for(from(goal, "doppler")), beta, 0.09) << goal;
        EXPECT_NEAR(beta_for(to(goal, "doppler")), beta, 0.09) << goal;
    }
    EXPECT_NEAR(file_of("scenes/alice-and-bob.json")["bodies"][0]["velocity"]["beta"].get<double>(), 0.5, 1e-12);
    // The lamp's 450 nm, straight behind: red is 620 to 700 nm.
    const double behind_nm = 450 * from("rainbow.red", "doppler_ahead");
    EXPECT_GT(behind_nm, 620);
    EXPECT_LT(behind_nm, 700);
    // A room's 288 K, and a candle's 1850 K within a tenth.
    EXPECT_NEAR(288 * from("warm-wall.glow", "doppler_ahead"), 1850, 185);
    // Red of 650 nm is seen in the green, 490 to 565 nm, with a quarter more waves.
    EXPECT_EQ(from("chart.green", "doppler_ahead"), 1.25);
    EXPECT_LT(650 / 1.25, 565);
    EXPECT_GT(650 / 1.25, 490);
    EXPECT_EQ(goals.size(), 14u) << "a new goal: what does it say?";
}

} // namespace stated_numbers_test
