// The governor holds a frame's time by moving along the ladder. The load is simulated, because real loads are not
// repeatable.
#include "runtime/operation/governor.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace governor_test {

using namespace starbow;

namespace {

std::vector<PresetLevel> ladder_of_times(const std::vector<double>& times)
{
    std::vector<PresetLevel> ladder;
    for (double ms : times)
        ladder.push_back({{}, ms, 1 / ms, 0});
    return ladder;
}

struct Flown {
    int frames = 0, late = 0, moves = 0, most_moves_a_second = 0;
    std::vector<std::size_t> levels; ///< the level at the end of each second
};

/// Simulates so many seconds at 60 Hz. load: factor on the ladder's times, as a function of time. A late frame delays the
/// next.
Flown fly(Governor& governor, double seconds, const std::function<double(double)>& load, double noise = 0.03)
{
    constexpr double turn = 1000.0 / 60;
    std::mt19937 random(7);
    std::normal_distribution<double> chance(0, noise);
    Flown flown;
    std::vector<double> moves;
    for (double now = 0; now < seconds;) {
        const double level_ms = governor.ladder()[governor.level()].ms;
        const double ms = load(now) * level_ms * std::exp(chance(random));
        ++flown.frames;
        flown.late += ms > 1.5 * turn;
        now += std::max(ms, turn) / 1000;
        if (governor.drawn(now, ms)) {
            ++flown.moves;
            moves.push_back(now);
            int near = 0;
            for (double before : moves)
                near += now - before < 1;
            flown.most_moves_a_second = std::max(flown.most_moves_a_second, near);
        }
        if (flown.levels.size() < std::size_t(now))
            flown.levels.push_back(governor.level());
    }
    return flown;
}

const std::vector<double> times = {4, 5, 6.5, 8, 10, 13, 16, 20};

} // namespace

TEST(GovernorTest, HoldsUnderALoadThatDoublesAndHalvesEveryFiveSeconds)
{
    Governor governor(ladder_of_times(times), 1000.0 / 60);
    const Flown flown = fly(governor, 120, [](double now) { return int(now / 5) % 2 ? 2.0 : 1.0; });
    EXPECT_LE(flown.late, 0.01 * flown.frames);
    EXPECT_LE(flown.most_moves_a_second, 2);
    // The level must not oscillate: in the second minute it hardly changes.
    std::size_t changes = 0;
    for (std::size_t s = 61; s < flown.levels.size(); ++s)
        changes += flown.levels[s] != flown.levels[s - 1];
    EXPECT_LE(changes, 4u);
}

TEST(GovernorTest, TakesTheFinestLevelThatFitsAndStays)
{
    for (double load : {0.5, 1.0, 1.7, 3.0}) {
        Governor governor(ladder_of_times(times), 1000.0 / 60);
        const Flown flown = fly(governor, 30, [&](double) { return load; });
        // It fits into three quarters of the frame, and is at most one step coarser.
        std::size_t finest = 0;
        for (std::size_t i = 0; i < times.size(); ++i)
            if (load * times[i] <= 0.75 * 1000 / 60)
                finest = i;
        EXPECT_LE(std::abs(int(governor.level()) - int(finest)), 1) << load;
        for (std::size_t s = 10; s < flown.levels.size(); ++s)
            EXPECT_EQ(flown.levels[s], flown.levels[9]) << load << " at " << s;
    }
}

TEST(GovernorTest, SingleLateFramesCauseNoMove)
{
    Governor governor(ladder_of_times(times), 1000.0 / 60);
    fly(governor, 20, [](double) { return 1.0; });
    const std::size_t before = governor.level();
    int frame = 0;
    const Flown flown = fly(governor, 20, [&](double) { return ++frame % 97 == 0 ? 5.0 : 1.0; });
    EXPECT_EQ(flown.moves, 0);
    EXPECT_EQ(governor.level(), before);
}

TEST(GovernorTest, ALoadThatIsTooHighUsesTheFirstLevel)
{
    Governor governor(ladder_of_times(times), 1000.0 / 60);
    fly(governor, 10, [](double) { return 50.0; });
    EXPECT_EQ(governor.level(), 0u);
    EXPECT_NE(describe(governor).find("quality 1 of 8"), std::string::npos) << describe(governor);
}

TEST(GovernorTest, ALadderOfOneLevelNeverMoves)
{
    Governor governor(ladder_of_times({10}), 1000.0 / 60);
    EXPECT_EQ(fly(governor, 10, [](double now) { return now > 5 ? 9.0 : 0.1; }).moves, 0);
}

} // namespace governor_test
