// Every challenge of the laboratory is solved by a flight with a student's keys. The program's finding in the log of that
// flight is compared with theory, in double, by school formulas of this file that share nothing with shaders/physics.
#include "runtime/hud/challenge_sheet.h"
#include "tests/support/lab_flight.h"
#include <gtest/gtest.h>
#include <regex>

namespace challenges_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

constexpr double deg = 3.14159265358979323846 / 180;
const Controls space = controls_with(Switches{Switch::stop}), freeze = controls_with(Switches{Switch::freeze});

const Challenge& named(std::string_view name)
{
    for (const Challenge& challenge : challenges())
        if (challenge.name == name)
            return challenge;
    ADD_FAILURE() << name;
    return challenges()[0];
}

Finding found_in(const std::string& name, const LabFlight& lab)
{
    const std::optional<Finding> finding = named(name).look(lab.lines());
    EXPECT_TRUE(finding) << name;
    return finding.value_or(Finding{});
}

const LabLine& line_of(const std::vector<LabLine>& lines, const Finding& finding)
{
    return lines.at(std::size_t(finding.line - 2));
}

double gamma_of(double beta) { return 1 / std::sqrt(1 - beta * beta); }

/// A scene's challenges all begin unsolved: at rest, with both marks, for some seconds.
void expect_unsolved(const std::string& name, LabFlight& lab)
{
    const auto finding = named(name).look(lab.lines());
    EXPECT_FALSE(finding && finding->solved) << name;
}

} // namespace

TEST(Challenges, TheClockThatAlmostStandsStill)
{
    LabFlight lab("clocks", "clocks-rest");
    lab.mark(0, lab.clock_near({0, 0, 0}));
    lab.wait(1, 0.1);
    expect_unsolved("slow-clock", lab);
    lab.hold(controls_with(Steering{.turn = {0, 1, 0}}), 4.5); // 180 degrees at 40 a second
    lab.wait(0.5);
    lab.faster(1.588); // 14.5 of rapidity in ten seconds: ln 10
    lab.wait(3);
    lab.wait(1, 0.1);
    const Finding finding = found_in("slow-clock", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    // The clock is straight behind, but for the turn's end: what arrives in a second is (1 - beta) / sqrt(1 - beta^2) of it.
    const auto lines = lab.lines();
    const LabLine& line = line_of(lines, finding);
    ASSERT_GT(line["mark_1_from_motion_deg"], 175);
    const double beta = line["beta"], cosine = std::cos(line["mark_1_from_motion_deg"] * deg);
    // The speed still settles by 0.1 % within a line, and the clock goes by while its rate is read.
    EXPECT_NEAR(finding.found, 1 / (gamma_of(beta) * (1 - beta * cosine)), 2e-4);
    EXPECT_NEAR(finding.found, std::sqrt((1 - beta) / (1 + beta)), 1e-3);
}

TEST(Challenges, TheFirstLineThatSolvesOneStays)
{
    LabFlight lab("avenue", "start");
    lab.log();
    lab.faster(0.115);
    lab.wait(4);
    for (int i = 0; i < 3; ++i)
        lab.log();
    std::vector<LabLine> lines = lab.lines();
    ASSERT_EQ(lines.size(), 4u);
    const auto look = [&] { return named("red-to-green").look(lines).value_or(Finding{}); };
    EXPECT_TRUE(look().solved);
    EXPECT_EQ(look().line, 3u) << "line 1 names the columns, and line 2 is at rest";
    std::reverse(lines.begin() + 1, lines.end());
    EXPECT_EQ(look().line, 5u) << "the first one of the list, whichever is nearest";
}

TEST(Challenges, ItsOwnColourInFlight)
{
    LabFlight lab("avenue", "avenue-gamma4");
    lab.log();
    expect_unsolved("own-colour", lab); // straight ahead
    for (int i = 0; i < 110; ++i)
        lab.look(0.5), lab.log();
    const Finding finding = found_in("own-colour", lab);
    EXPECT_TRUE(finding.solved);
    const double right = std::acos((1 - 0.25) / (std::sqrt(15.0) / 4)) / deg;
    EXPECT_NEAR(finding.right, right, 1e-6);
    EXPECT_NEAR(finding.found, right, 1);
    const auto lines = lab.lines();
    EXPECT_NEAR(line_of(lines, finding)["aim_doppler"], 1, 0.05);
}

TEST(Challenges, FromRedToGreen)
{
    LabFlight lab("avenue", "start");
    lab.faster(0.115);
    lab.wait(4);
    lab.log();
    const Finding finding = found_in("red-to-green", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    const auto lines = lab.lines();
    const double beta = lines[0]["beta"];
    EXPECT_NEAR(finding.found, 650 * std::sqrt((1 - beta) / (1 + beta)), 1e-6);
    EXPECT_NEAR(beta, 1 / 6.0, 0.03); // the last hint
}

TEST(Challenges, TwoLengthsOfOneTrain)
{
    LabFlight lab("train");
    const int train = lab.moving_frame();
    lab.mark(0, lab.clock_near({7, 1.38, 0.98}, train));
    lab.mark(1, lab.clock_near({-7, 1.38, 0.98}, train));
    lab.wait(5, 0.1);
    expect_unsolved("two-lengths", lab); // it has not passed
    lab.wait(40, 0.1);
    const Finding finding = found_in("two-lengths", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    const double right = 14 * 0.6;
    EXPECT_NEAR(finding.right, right, 1e-4); // the dials' places are floats
    EXPECT_NEAR(finding.found, right, 0.01); // of two lines 0.1 s apart the passage is interpolated
    // Before it passes it looks longer than at rest, at first nearly 3 times as long as contracted times gamma.
    const auto lines = lab.lines();
    EXPECT_GT(lines[0]["marks_apparent_length_light_s"], 14);
    EXPECT_LT(lines.back()["marks_apparent_length_light_s"], right);
}

TEST(Challenges, NearerAndHalfAsLarge)
{
    LabFlight lab("clocks", "clocks-rest");
    lab.mark(0, lab.clock_near({0, 0, 0}));
    lab.mark(1, lab.clock_near({5, 0, 0}));
    lab.wait(0.5, 0.1);
    expect_unsolved("half-size", lab);
    lab.faster(0.9);
    lab.wait(1.5, 0.1);
    const Finding finding = found_in("half-size", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    // The first mark is straight ahead; of the other one tan(theta'/2) is e^-eta tan(theta/2).
    const auto lines = lab.lines();
    const LabLine& line = line_of(lines, finding);
    const double left = line["place_z_light_s"], beta = line["beta"];
    EXPECT_LT(left, 31);
    const double seen = 2 * std::atan(std::sqrt((1 - beta) / (1 + beta)) * std::tan(0.5 * std::atan2(5, left)));
    EXPECT_NEAR(finding.found, seen / std::atan2(5, 31), 1e-5); // the dials' places are floats
}

TEST(Challenges, OnlyYourSpeedChanges)
{
    LabFlight lab("clocks", "clocks-passing");
    lab.mark(0, lab.clock_near({10, 0, 0}));
    lab.press(freeze);
    lab.log();
    expect_unsolved("same-light", lab);
    lab.press(space);
    lab.log();
    const Finding finding = found_in("same-light", lab);
    EXPECT_TRUE(finding.solved);
    EXPECT_NEAR(finding.found, 0, 1e-9); // the log has 12 digits
    const auto lines = lab.lines();
    EXPECT_GT(lines[0]["beta"] - lines[1]["beta"], 0.49);
    // By the world's light: the clock shows now less the light's way.
    const double way = std::hypot(lines[1]["place_x_light_s"] - 10, 31.0);
    EXPECT_NEAR(lines[0]["mark_1_clock_s"], lines[0]["world_time_s"] - way, 1e-5);
}

TEST(Challenges, BackAndYounger)
{
    // Out along the avenue, a stop, half a turn, and back; `each` is called every dt, a part of 0.1 s.
    const auto trip = [](LabFlight& lab, double dt, const auto& each) {
        const auto hold = [&](const Controls& controls, int tenths) {
            for (int i = 0; i < tenths * std::lround(0.1 / dt); ++i)
                lab.hold(controls, dt), each();
        };
        const auto z = [&] { return lab.flight.ship.position.total().z; };
        const Controls w = controls_with(Steering{.throttle_rate = 1});
        hold(w, 17);
        while (z() > -12)
            hold({}, 1);
        lab.press(space), each();
        hold(controls_with(Steering{.turn = {0, 1, 0}}), 45);
        hold(w, 17);
        while (z() < -1)
            hold({}, 1);
        lab.press(space), each();
    };
    LabFlight lab("avenue", "start");
    lab.log();
    trip(lab, 0.1, [&] { lab.log(); });
    const Finding finding = found_in("younger", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    const auto lines = lab.lines();
    const LabLine& line = line_of(lines, finding);
    std::size_t leaves = 0; // of the lines at rest before the ship leaves, the last one is the departure
    while (lines[leaves + 1]["beta"] < 0.01)
        ++leaves;
    const LabLine& departure = lines[leaves];
    // The time on board is the sum of the world's time over gamma: by trapezoids along the same flight, 2 ms wide.
    LabFlight fine("avenue", "start");
    double own = 0, before = 0, rate_before = 1;
    trip(fine, 0.002, [&] {
        const double now = fine.flight.ship.time.total();
        const glm::dvec3 u = fine.flight.ship.u.total();
        const double rate = 1 / std::sqrt(1 + glm::dot(u, u));
        if (before >= departure["world_time_s"] - 1e-9 && now <= line["world_time_s"] + 1e-9)
            own += 0.5 * (now - before) * (rate + rate_before);
        before = now, rate_before = rate;
    });
    // A trapezoid's error is a part in 1e5 where the rapidity grows by 0.003 within it, and the stop is one of 1 ms.
    EXPECT_NEAR(finding.found, own / (line["world_time_s"] - departure["world_time_s"]), 1e-4);
    // The way out alone would solve nothing.
    for (const LabLine& out : lines)
        if (out.line <= lines[60].line) {
            EXPECT_NE(out.line, finding.line);
        }
}

TEST(Challenges, WhereMovingClocksAgree)
{
    LabFlight lab("train");
    const int train = lab.moving_frame();
    lab.mark(0, lab.clock_near({7, 1.38, 0.98}, train));
    lab.mark(1, lab.clock_near({-7, 1.38, 0.98}, train));
    lab.wait(5, 0.1);
    expect_unsolved("same-time", lab);
    lab.wait(40, 0.1);
    const Finding finding = found_in("same-time", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    // By the train's clocks: the ship is at -0.8 t' gamma..., and each dial shows t' less its distance there.
    const auto lines = lab.lines();
    const LabLine& line = line_of(lines, finding);
    const double gamma = 1 / 0.6, x = gamma * (0 - 0.8 * line["world_time_s"]);
    // Both dials are as high and as deep before the ship.
    const double across = std::hypot(2.2 - 1.38, 14 - 0.98);
    EXPECT_NEAR(finding.found, std::hypot(x - 7, across) - std::hypot(x + 7, across), 2e-3); // the dials' own thickness
    EXPECT_NEAR(x, 0, 0.3); // the last hint: the middle passes
}

TEST(Challenges, HalfAsFastStraightAbeam)
{
    LabFlight lab("rainbow");
    lab.log();
    lab.faster(0.91);
    lab.wait(4);
    for (int i = 0; i < 95; ++i)
        lab.look(1), lab.log();
    for (int i = 0; i < 95; ++i)
        lab.look(1), lab.log();
    const Finding finding = found_in("half-rate", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    const auto lines = lab.lines();
    const LabLine& line = line_of(lines, finding);
    const double beta = line["beta"], cosine = std::cos(line["aim_from_motion_deg"] * deg);
    EXPECT_NEAR(finding.found, 1 / (gamma_of(beta) * (1 - beta * cosine)), 1e-9);
    EXPECT_NEAR(finding.found, 1 / gamma_of(beta), 0.02);
}

TEST(Challenges, WhatIsBehindYouAhead)
{
    LabFlight lab("avenue", "start");
    lab.mark(0, {.at = {std::sin(155 * deg), 0, -std::cos(155 * deg)}, .sky = true}); // 155 degrees from straight ahead
    lab.log();
    expect_unsolved("behind-ahead", lab);
    lab.faster(1.8);
    lab.wait(2, 0.1);
    const Finding finding = found_in("behind-ahead", lab);
    EXPECT_TRUE(finding.solved) << finding.found;
    const auto lines = lab.lines();
    const double beta = line_of(lines, finding)["beta"];
    EXPECT_NEAR(finding.found, 2 / deg * std::atan(std::sqrt((1 - beta) / (1 + beta)) * std::tan(77.5 * deg)), 1e-6);
}

TEST(Challenges, AnEmptyLogSolvesNothing)
{
    for (const Challenge& challenge : challenges()) {
        const auto finding = challenge.look({});
        EXPECT_FALSE(finding) << challenge.name;
        EXPECT_EQ(said_of(challenge, finding, words()), words()("challenge.no_line"));
    }
}

TEST(Challenges, WhatIsSaidNamesTheLineAndWhatIsRightOnlyAfterwards)
{
    const Finding near_miss{.solved = false, .line = 12, .found = 0.0812, .right = 0.1, .tolerance = 0.01};
    EXPECT_EQ(said_of(named("slow-clock"), near_miss, words()), "not yet; nearest is line 12: 0.0812");
    const Finding done{.solved = true, .line = 3, .found = 44.25, .right = 45, .kind = Finding::Right::at_most};
    EXPECT_EQ(said_of(named("behind-ahead"), done, words("de")), "gelöst in Zeile 3: 44,2°; richtig ist höchstens 45,0°");
}

TEST(Challenges, TheSheetHasEveryQuestionAndItsHintsClosed)
{
    EXPECT_EQ(challenges().size(), 10u);
    for (const char* language : {"en", "de"}) {
        const std::string sheet = challenge_sheet(words(language));
        const std::regex details("<details><summary>");
        EXPECT_EQ(std::distance(std::sregex_iterator(sheet.begin(), sheet.end(), details), std::sregex_iterator()), 30);
        EXPECT_EQ(sheet.find("<details open"), sheet.npos);
        for (const Challenge& challenge : challenges()) {
            EXPECT_NE(sheet.find(challenge.name), sheet.npos);
            const std::string two = challenge_text(challenge, 2, words(language));
            EXPECT_NE(two.find(words(language)(challenge.hints[1])), two.npos);
            EXPECT_EQ(two.find(words(language)(challenge.hints[2])), two.npos); // not opened
            EXPECT_EQ(two.find('{'), two.npos);
        }
    }
}

/// docs/lab.md lists the challenges with the program's figures.
TEST(Challenges, TheDocumentHasThem)
{
    const std::string document = read_text(source_dir() / "docs/lab.md");
    for (const Challenge& challenge : challenges()) {
        EXPECT_NE(document.find("| " + std::string(challenge.name) + " | `" + challenge.start + "` |"), document.npos)
            << challenge.name;
        EXPECT_NE(document.find(words()(challenge.ask)), document.npos) << challenge.name;
    }
}

} // namespace challenges_test
