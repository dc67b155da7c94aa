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

namespace {

/// A ladder whose levels have more texels, the finer they are.
std::vector<PresetLevel> ladder_of_texels()
{
    std::vector<PresetLevel> ladder = ladder_of_times(times);
    for (std::size_t i = 0; i < ladder.size(); ++i)
        ladder[i].quality.texels_per_pixel = 1 + 0.1 * double(i);
    return ladder;
}

} // namespace

// A device without memory for level 6 of 8 and all finer ones, and with time for all of them. A lack of memory costs a new
// start of the device. It happens once on the finest level, to which the governor goes at once, and once on level 6.
TEST(GovernorTest, ALevelWithoutRoomIsNotTriedAgainUntilConditionsChange)
{
    Governor governor(ladder_of_texels(), 1000.0 / 60);
    int refusals = 0;
    const auto fly_with_room_for = [&](std::size_t levels, double seconds) {
        double now = 5000.0 * refusals + 1;
        for (const double end = now + seconds; now < end; now += 1.0 / 60) {
            if (governor.level() >= levels) {
                ++refusals;
                ASSERT_TRUE(governor.refuse(governor.level()));
                ASSERT_LT(governor.level(), levels) << "the level without room, or one that needs more";
            }
            governor.drawn(now, 0.5 * governor.ladder()[governor.level()].ms);
        }
    };
    fly_with_room_for(5, 3600);
    EXPECT_EQ(refusals, 2);
    EXPECT_EQ(governor.level(), 4u) << "the finest that is left";
    governor.forget_refusals();
    fly_with_room_for(8, 600);
    EXPECT_EQ(refusals, 2);
    EXPECT_EQ(governor.level(), 7u);
}

TEST(GovernorTest, WithoutRoomForAnyLevelItSaysSo)
{
    Governor governor(ladder_of_texels(), 1000.0 / 60);
    ASSERT_EQ(governor.level(), 4u);
    EXPECT_TRUE(governor.refuse(6)); // in the warm-up: the present level stays
    EXPECT_EQ(governor.level(), 4u);
    EXPECT_TRUE(governor.has_room(5));
    EXPECT_FALSE(governor.has_room(7));
    EXPECT_TRUE(governor.refuse(4));
    EXPECT_EQ(governor.level(), 3u);
    EXPECT_FALSE(governor.refuse(0));
    // Levels that trade one need for another are refused alone.
    std::vector<PresetLevel> ladder = ladder_of_texels();
    ladder[0].quality.half_floats = false;
    Governor other(ladder, 1000.0 / 60);
    EXPECT_TRUE(other.refuse(0));
    EXPECT_EQ(other.level(), 4u);
    fly(other, 10, [](double) { return 50.0; });
    EXPECT_EQ(other.level(), 1u) << "the coarsest that is left";
}

TEST(GovernorTest, ALadderOfOneLevelNeverMoves)
{
    Governor governor(ladder_of_times({10}), 1000.0 / 60);
    EXPECT_EQ(fly(governor, 10, [](double now) { return now > 5 ? 9.0 : 0.1; }).moves, 0);
}

} // namespace governor_test
