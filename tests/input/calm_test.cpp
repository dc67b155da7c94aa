// A calm exhibit's limits, against hands that do their worst; and the flashes that these hands make, by WCAG 2.3.1.
#include "input/calm.h"
#include "runtime/flight/history.h"
#include "runtime/images/flashes.h"
#include "runtime/light/exposure.h"
#include "shaders/physics/physics.h"
#include "shaders/tone.h"
#include "tests/support/chance_hands.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <string>

namespace calm_test {

using namespace starbow;

namespace {

constexpr double dt_s = 1.0 / 60;
constexpr std::int64_t frame_ns = 1'000'000'000 / 60;

/// The most turns of a series within any one second.
int most_turns(const std::vector<double>& values)
{
    std::vector<std::size_t> turns;
    int way = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const int now = (values[i] > values[i - 1]) - (values[i] < values[i - 1]);
        if (now != 0 && way != 0 && now != way)
            turns.push_back(i);
        way = now != 0 ? now : way;
    }
    int most = 0;
    for (std::size_t first = 0; first < turns.size(); ++first)
        most = std::max(most, int(std::count_if(turns.begin() + std::ptrdiff_t(first), turns.end(), [&](std::size_t i) {
            return i < turns[first] + 60;
        })));
    return most;
}

/// What a visitor sees: a row of directions 5 degrees apart, from straight ahead to abreast, in front of a grey world; a
/// field for each switch that changes the picture, and a field that all of them change.
struct View {
    static constexpr int directions = 19;
    static constexpr int fields = directions + int(all_switches.size()) + 1;

    /// Luminances before the exposure.
    static std::vector<LuminanceSample> light(const Flight& flight)
    {
        const double E = physics::exp_rapidity(glm::length(flight.ship.u.total()));
        std::vector<LuminanceSample> all;
        for (int i = 0; i < directions; ++i) {
            const double angle = 5 * i * 3.14159265358979324 / 180;
            const double D = 2 / (E * (1 - std::cos(angle)) + (1 + std::cos(angle)) / E); // 1 / (gamma (1 - beta cos))
            const double own = 0.2 + 0.05 * (i % 3);
            all.push_back({float(flight.effects[Effect::headlight] ? own * D * D * D : own), 0.01f});
        }
        return all;
    }
};

/// These show words at most, and the exposure that a lock lets go is slow.
const std::set<std::string> of_words{"lock_exposure", "quit", "save"};

/// Directions farther apart than a field's diameter, on circles around the sphere.
glm::vec3 field_at(int i)
{
    constexpr int around = 20;
    const float azimuth = 0.3f * float(i % around), elevation = 0.4f * float(i / around) - 0.4f;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

struct Worst {
    int general = 0; ///< changes in a second
    Flight last;
};

/// Flies at gamma 4 with a script of controls, with the automatic exposure, in a calm exhibit or in another, and counts the
/// flashes of a field of 10 degrees in each direction.
Worst flown_by(const std::function<Controls(int frame)>& script, bool calm, double seconds, double max_gamma = 4)
{
    Shot start;
    start.u = {0, 0, -std::sqrt(15.0)};
    start.exposure_ev = -3;
    start.effects.on.set(Effect::headlight, false);
    Flying rules;
    rules.max_gamma = max_gamma;
    const Exposing exposing{.calm = calm};
    Flight flight = flight_at(start, rules);
    History history;
    Exposure exposure;
    SlowTurns ev;
    FlashLimiter hands;
    // Each direction is a field of its own, far from the others.
    std::vector<SeenPixel> pixels;
    for (int i = 0; i < View::fields; ++i)
        pixels.push_back({field_at(i), 0.01f, 0});
    FlashCounter counter(pixels, 1);
    std::array<bool, all_switches.size()> leapt{};
    bool any_leapt = false;
    for (int frame = 0; frame < int(seconds * 60); ++frame) {
        Controls controls = script(frame);
        if (calm)
            controls = hands.let_through(controls, dt_s);
        flight = flown(flight, history, controls, frame_ns, rules, 1, start);
        const std::vector<LuminanceSample> light = View::light(flight);
        exposure.locked ^= controls[Switch::lock_exposure];
        exposure = adapted(exposure, metered_ev(light), dt_s, exposing, start.exposure_ev);
        double shown = shown_ev(exposure, exposing, flight.exposure_ev, start.exposure_ev);
        if (calm)
            shown = *(ev = calmed_ev(ev, shown, dt_s)).value;
        std::vector<glm::vec3> picture;
        for (const LuminanceSample& sample : light)
            picture.push_back(tone_float::tone_map(glm::vec3(float(sample.luminance * std::exp2(shown)))));
        for (std::size_t i = 0; i < all_switches.size(); ++i) {
            const bool leaps = controls[all_switches[i].which] && !of_words.contains(std::string(all_switches[i].name));
            leapt[i] ^= leaps, any_leapt ^= leaps;
            picture.emplace_back(leapt[i] ? 0.7f : 0.1f);
        }
        picture.emplace_back(any_leapt ? 0.7f : 0.1f);
        counter.take(frame * frame_ns, picture);
    }
    return {counter.worst(FlashKind::general, 0).changes, flight};
}

} // namespace

TEST(CalmTest, ANumberTurnsAtMostOnceASecondAndArrives)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    for (int trial = 0; trial < 50; ++trial) {
        SlowTurns number;
        std::vector<double> values;
        double wanted = 0;
        const double restless = any(random), far = any(random) * 10;
        for (int frame = 0; frame < 600; ++frame) {
            if (any(random) < restless)
                wanted = far * any(random);
            const double before = number.value.value_or(wanted);
            number = followed(number, wanted, dt_s, 6, 0.05);
            values.push_back(*number.value);
            ASSERT_LE(std::abs(values.back() - before), 6 * dt_s + 1e-12);
        }
        EXPECT_LE(most_turns(values), 1) << trial;
        for (int frame = 0; frame < 240; ++frame)
            number = followed(number, wanted, dt_s, 6, 0.05);
        EXPECT_NEAR(*number.value, wanted, 0.05) << trial;
    }
}

TEST(CalmTest, AnUndisturbedWayIsNotDelayed)
{
    SlowTurns number = followed({}, 0, dt_s, 6, 0.05);
    for (int frame = 0; frame < 60; ++frame)
        number = followed(number, 0.1 * frame * dt_s, dt_s, 6, 0.05);
    EXPECT_NEAR(*number.value, 0.1 * 59 * dt_s, 1e-12);
}

TEST(CalmTest, TheFirstPressActsAtOnceAndTheOthersTogetherASecondLater)
{
    FlashLimiter hands;
    std::vector<int> headlight, doppler, stop;
    for (int frame = 0; frame < 180; ++frame) {
        Controls controls;
        controls.set(Switch::headlight, frame == 10 || frame == 20 || frame == 30 || frame == 40); // three more: one is left
        controls.set(Switch::doppler, frame == 25 || frame == 35); // two: none is left
        controls.set(Switch::stop, frame == 50);
        controls.set(Switch::lock_exposure, frame == 15); // changes words alone
        controls = hands.let_through(controls, dt_s);
        if (controls[Switch::headlight])
            headlight.push_back(frame);
        if (controls[Switch::doppler])
            doppler.push_back(frame);
        if (controls[Switch::stop])
            stop.push_back(frame);
        EXPECT_EQ(controls[Switch::lock_exposure], frame == 15);
    }
    EXPECT_EQ(headlight, (std::vector{10, 70}));
    EXPECT_TRUE(doppler.empty());
    EXPECT_EQ(stop, (std::vector{70}));
}

TEST(CalmTest, AThrottleTurnsAtMostOnceASecond)
{
    FlashLimiter hands;
    std::vector<double> lever, speed{0};
    for (int frame = 0; frame < 600; ++frame) {
        Controls controls;
        controls.lever = 0.5 + 0.5 * std::sin(frame * 0.7);
        controls.throttle_rate = frame / 5 % 2 == 0 ? 1 : -1;
        controls = hands.let_through(controls, dt_s);
        lever.push_back(*controls.lever);
        speed.push_back(speed.back() + controls.throttle_rate * dt_s);
    }
    EXPECT_LE(most_turns(lever), 1);
    EXPECT_LE(most_turns(speed), 1);
}

TEST(CalmTest, AHeadlightSwitchPressedTenTimesASecondFlickersOnlyWithoutCalm)
{
    const auto mash = [](int frame) {
        Controls controls;
        controls.set(Switch::headlight, frame % 6 == 0);
        return controls;
    };
    EXPECT_GE(flown_by(mash, false, 5).general, 10);
    EXPECT_LE(flown_by(mash, true, 5).general, 2 * most_flashes);
    EXPECT_GT(flown_by(mash, true, 5).general, 0); // it still is a switch
    // After an odd number of presses it is on.
    const auto presses = [](int number) {
        return [number](int frame) {
            Controls controls;
            controls.set(Switch::headlight, frame % 6 == 0 && frame < 6 * number);
            return controls;
        };
    };
    EXPECT_TRUE(flown_by(presses(7), true, 5).last.effects[Effect::headlight]);
    EXPECT_FALSE(flown_by(presses(8), true, 5).last.effects[Effect::headlight]);
}

TEST(CalmTest, NoHandsMakeMoreThanThreeFlashesInASecond)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    int most_without = 0, most_with = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const double restless = std::pow(any(random), 2);
        std::vector<Controls> script(480);
        double lever = 0.5, exposure = 0, rate = 0;
        for (Controls& controls : script) {
            for (const SwitchEntry& one : all_switches)
                controls.set(one.which, any(random) < 0.1 * restless);
            controls.set(Switch::headlight, any(random) < restless);
            controls.set(Switch::aberration, any(random) < restless);
            controls.choose = any(random) < 0.1 * restless;
            controls.turn_by = any(random) < 0.1 * restless;
            if (any(random) < restless)
                lever = any(random), exposure = std::round(2 * any(random) - 1), rate = std::round(2 * any(random) - 1);
            if (trial % 2 == 0)
                controls.lever = lever;
            controls.throttle_rate = rate;
            controls.exposure = exposure;
        }
        const auto play = [&](int frame) { return script[std::size_t(frame)]; };
        most_without = std::max(most_without, flown_by(play, false, 8).general);
        most_with = std::max(most_with, flown_by(play, true, 8).general);
        ASSERT_LE(flown_by(play, true, 8).general, 2 * most_flashes) << trial;
    }
    EXPECT_GT(most_without, 20);
    EXPECT_GT(most_with, 1);
}

// Hands of chance move every number that the controls have: together they turn round at most once a second.
TEST(CalmTest, OfAllThatMovesOneNumberTurnsInASecond)
{
    int turns_without = 0;
    for (unsigned int seed = 0; seed < 40; ++seed) {
        for (const bool calm : {false, true}) {
            starbow::testing::ChanceHands chance(seed);
            FlashLimiter hands;
            std::map<std::pair<std::size_t, std::size_t>, std::pair<double, int>> last; // a number's place, and its way
            std::vector<int> turns;
            for (int frame = 0; frame < 900; ++frame) {
                Controls controls = chance.next(dt_s);
                if (calm)
                    controls = hands.let_through(controls, dt_s);
                for (std::size_t i = 0; i < all_channels.size(); ++i) {
                    if (all_channels[i].way == Way::light || std::string(all_channels[i].name) == "head_turned")
                        continue; // a head's turn is normalized: its speed is measured below
                    const std::span<double> numbers = all_channels[i].of(controls);
                    for (std::size_t n = 0; n < numbers.size(); ++n) {
                        const bool first = !last.contains({i, n});
                        auto& [place, way] = last[{i, n}];
                        const double moved
                            = all_channels[i].way == Way::place ? (first ? 0 : numbers[n] - place) : numbers[n];
                        const int now = (moved > 1e-12) - (moved < -1e-12);
                        if (now != 0 && way != 0 && now != way)
                            turns.push_back(frame);
                        way = now != 0 ? now : way, place = numbers[n];
                    }
                }
                if (calm) {
                    const double step = std::hypot(controls.look_rad.x, controls.look_rad.y) * 180 / std::acos(-1.0) / dt_s;
                    EXPECT_LE(step, std::sqrt(2.) * calm_turn_deg_per_s + 1e-9);
                }
            }
            if (!calm)
                turns_without += int(turns.size());
            for (std::size_t k = 1; calm && k < turns.size(); ++k)
                EXPECT_GE(turns[k] - turns[k - 1], 60) << seed;
        }
    }
    EXPECT_GT(turns_without, 10000);
}

// A hand that drags the mouse up and down six times a second no longer moves the view so.
TEST(CalmTest, ADraggedMouseTurnsTheViewSlowly)
{
    FlashLimiter hands;
    double look = 0, least = 0, most = 0;
    int turned = 0, way = 0;
    for (int frame = 0; frame < 600; ++frame) {
        Controls controls;
        controls.look_rad.y = frame / 5 % 2 == 0 ? 0.07 : -0.07;
        const double moved = hands.let_through(controls, dt_s).look_rad.y;
        look += moved, least = std::min(least, look), most = std::max(most, look);
        const int now = (moved > 0) - (moved < 0);
        turned += now != 0 && way != 0 && now != way;
        way = now != 0 ? now : way;
    }
    EXPECT_LE(turned, 10);
    EXPECT_LT(most - least, 0.4);
}

TEST(CalmTest, ABuildersStepsWaitAndAddUp)
{
    FlashLimiter hands;
    int acted = 0, sum = 0;
    for (int frame = 0; frame < 240; ++frame) {
        Controls controls;
        controls.turn_by = frame < 100 && frame % 10 == 0 ? 1 : 0;
        const int by = hands.let_through(controls, dt_s).turn_by;
        acted += by != 0, sum += by;
    }
    EXPECT_EQ(sum, 10);
    EXPECT_LE(acted, 3);
}

TEST(CalmTest, AShipThatTurnsByStepsTakesOneASecond)
{
    FlashLimiter hands;
    int steps = 0;
    for (int frame = 0; frame < 300; ++frame) {
        Controls controls;
        controls.turn.y = frame / 20 % 2 == 0 ? 1 : -1;
        steps += hands.let_through(controls, dt_s, true).turn.y != 0;
    }
    EXPECT_GE(steps, 2);
    EXPECT_LE(steps, 5);
}

// Each switch twenty times in two seconds, and all of them at once.
TEST(CalmTest, EverySwitchThatChangesThePictureActsOnceASecond)
{
    const auto let_through = [](const std::function<void(Controls&)>& press) {
        FlashLimiter hands;
        std::vector<int> of_each(all_switches.size(), 0);
        for (int frame = 0; frame < 120; ++frame) {
            Controls controls;
            if (frame % 6 == 0)
                press(controls);
            controls = hands.let_through(controls, dt_s);
            for (std::size_t i = 0; i < all_switches.size(); ++i)
                of_each[i] += controls[all_switches[i].which];
        }
        return of_each;
    };
    const std::vector<int> together = let_through([](Controls& controls) {
        for (const SwitchEntry& one : all_switches)
            controls.set(one.which);
    });
    for (std::size_t i = 0; i < all_switches.size(); ++i) {
        const SwitchEntry& one = all_switches[i];
        const int alone = let_through([&](Controls& controls) { controls.set(one.which); })[i];
        if (of_words.contains(std::string(one.name))) {
            EXPECT_EQ(alone, 20) << one.name;
            EXPECT_EQ(together[i], 20) << one.name;
        } else {
            EXPECT_GE(alone, 1) << one.name;
            EXPECT_LE(alone, 2) << one.name;
            EXPECT_LE(together[i], 2) << one.name;
        }
    }
}

TEST(CalmTest, ASecondPressOfATwoWaySwitchUndoesTheFirstWhileItWaitsAndOneOfTheOthersAddsNothing)
{
    const std::set<std::string> two_ways{"aberration", "doppler", "headlight", "false_colours", "range", "filter", "hud",
        "sky_names", "menu", "full_screen", "freeze"};
    for (const SwitchEntry& one : all_switches) {
        if (of_words.contains(std::string(one.name)))
            continue;
        FlashLimiter hands;
        int acted = 0;
        for (int frame = 0; frame < 180; ++frame) {
            Controls controls;
            controls.set(one.which == Switch::stop ? Switch::home : Switch::stop, frame == 0);
            controls.set(one.which, frame == 20 || frame == 40);
            acted += hands.let_through(controls, dt_s)[one.which];
        }
        EXPECT_EQ(acted, two_ways.contains(std::string(one.name)) ? 0 : 1) << one.name;
    }
}

// A lever takes a quarter of a second from end to end, and an exposure a sixth for a stop, however they are thrown.
TEST(CalmTest, LeverAndExposureGoNoFasterThanAHandAndAnEye)
{
    FlashLimiter hands;
    SlowTurns ev;
    double lever = 0, ev_before = 0;
    for (int frame = 0; frame < 60; ++frame) {
        Controls controls;
        controls.lever = frame == 0 ? 0 : 1;
        const double now = *hands.let_through(controls, dt_s).lever;
        EXPECT_LE(now - lever, 4 * dt_s + 1e-12) << frame;
        EXPECT_NEAR(now, std::min(1.0, 4 * dt_s * frame), 1e-12) << frame;
        lever = now;
        ev = calmed_ev(ev, frame == 0 ? 0 : 4, dt_s);
        EXPECT_LE(*ev.value - ev_before, 6 * dt_s + 1e-12) << frame;
        EXPECT_NEAR(*ev.value, std::min(4.0, 6 * dt_s * frame), 1e-12) << frame;
        ev_before = *ev.value;
    }
}

} // namespace calm_test
