// The light of the picture between the flight and the screen: exposures after leaps, a docent's change, black, calm limits,
// and replays.
#include "runtime/visit/hand_flight.h"
#include "runtime/visit/shown_light.h"
#include "tests/support/controls.h"
#include <cmath>
#include <gtest/gtest.h>

namespace shown_light_test {

using namespace starbow;
using starbow::testing::controls_with;

namespace {

constexpr double frame_s = 0.02;

Shot start_at(double exposure_ev)
{
    Shot start;
    start.exposure_ev = exposure_ev;
    return start;
}

/// A flight whose view is metered as `metered_ev`.
struct Flown {
    explicit Flown(const Exposing& rules, double start_ev = -3)
        : source(start_at(start_ev), {}, 1)
        , light(rules)
    {
    }
    RecordEntry frame(double metered_ev, const Controls& controls = {}, double black = 0, double directed_ev = 0)
    {
        RecordEntry entry{.dt_ns = std::int64_t(1e9 * frame_s)};
        source.advance(controls, entry.dt_ns);
        light.advance(entry,
            {.source = source,
                .metered = {.ev = metered_ev},
                .locks = controls[Switch::lock_exposure],
                .fade = black,
                .directed_ev = directed_ev,
                .dt_s = frame_s});
        return entry;
    }
    HandFlight source;
    ShownLight light;
};

} // namespace

TEST(ShownLightTest, TheFirstPictureHasTheStartsExposureAndTheNextOnesFollowTheView)
{
    Flown flown({});
    for (const double metered_ev : {40., 5., 5.}) { // the metered light of the first frame is of the picture before
        flown.frame(metered_ev);
        EXPECT_EQ(flown.light.ev(), -3);
    }
    for (int i = 0; i < 2000; ++i)
        flown.frame(7);
    EXPECT_NEAR(flown.light.ev(), -1, 1e-3) << "two stops darker light";
    EXPECT_FALSE(flown.light.leapt());
    flown.frame(7, controls_with(Switches{Switch::reset}));
    EXPECT_TRUE(flown.light.leapt());
    EXPECT_EQ(flown.light.ev(), -3) << "a beginning";
    flown.light.begin();
    flown.frame(9);
    EXPECT_EQ(flown.light.ev(), -3) << "another content";
}

TEST(ShownLightTest, ALockHoldsAndADocentsChangeIsAdded)
{
    Flown flown({});
    for (int i = 0; i < 5; ++i)
        flown.frame(5);
    flown.frame(5, controls_with(Switches{Switch::lock_exposure}));
    EXPECT_TRUE(flown.light.locked());
    for (int i = 0; i < 2000; ++i)
        flown.frame(9);
    EXPECT_EQ(flown.light.ev(), -3);
    flown.frame(9, {}, 0, 1.5);
    EXPECT_EQ(flown.light.ev(), -1.5);
    flown.light.forget_visitor();
    EXPECT_FALSE(flown.light.locked()) << "the next visitor's eye adapts";
}

// A light of 2^20 beside a grey one. The filter comes as slowly as eyes adapt, shows the brighter one below white, whatever
// the start's exposure and the rules are, and leaves no trace. A replay has the same exposures.
TEST(ShownLightTest, AFilterIsForTheBrightest)
{
    const std::vector<LuminanceSample> view{{1 << 20, 0.01F}, {0.18F, 1}, {NAN, 1}};
    for (const bool automatic : {true, false})
        for (const ExposureMode mode : {ExposureMode::eye, ExposureMode::range}) {
            const Exposing rules{.mode = mode, .automatic = automatic};
            HandFlight source(start_at(-3), {}, 1), again(start_at(-3), {}, 1);
            ShownLight light(rules), replayed(rules);
            double before = 0;
            for (int i = 0; i < 4000; ++i) {
                const bool filter = i >= 1000 && i < 2000;
                RecordEntry entry{.dt_ns = std::int64_t(1e9 * frame_s)};
                LightInputs now{.source = source,
                    .metered = {.ev = 0, .surfaces = view},
                    .range = mode == ExposureMode::range,
                    .filter = filter,
                    .dt_s = frame_s};
                light.advance(entry, now);
                if (i % 1000 > 50) { // a curve begins with the numbers of a view
                    EXPECT_EQ(light.curve().has_value(), now.range && !filter) << i;
                }
                if (i == 999)
                    before = light.ev();
                if (i == 1999) {
                    EXPECT_NEAR(light.ev(), std::log2(filtered_to_luminance) - 20, 1e-3);
                    EXPECT_LT(std::exp2(light.ev()) * (1 << 20), 1) << "white";
                }
                RecordEntry kept = entry;
                replayed.advance(
                    kept, {.source = again, .range = now.range, .filter = filter, .replays = true, .dt_s = frame_s});
                EXPECT_EQ(replayed.ev(), light.ev()) << i;
            }
            EXPECT_NEAR(light.ev(), before, 1e-3) << "after the filter";
        }
}

TEST(ShownLightTest, AWorldThatBeginsBehindAFilterHasItsOwnExposureWithoutIt)
{
    const std::vector<LuminanceSample> view{{1 << 20, 0.01F}, {0.18F, 1}};
    HandFlight source(start_at(-3), {}, 1);
    ShownLight light({});
    for (int i = 0; i < 4000; ++i) {
        RecordEntry entry{.dt_ns = std::int64_t(1e9 * frame_s)};
        light.advance(
            entry, {.source = source, .metered = {.ev = 5, .surfaces = view}, .filter = i < 1000, .dt_s = frame_s});
    }
    EXPECT_NEAR(light.ev(), -3, 1e-3);
}

TEST(ShownLightTest, ATourShowsItsOwnExposuresAndItsCurveBehindAFilter)
{
    struct Toured : HandFlight {
        using HandFlight::HandFlight;
        bool by_hand() const override { return false; }
    } tour(start_at(-3), {}, 1);
    const std::vector<LuminanceSample> view{{1 << 20, 0.01F}, {0.18F, 1}};
    for (const bool range : {false, true}) {
        ShownLight with({}), without({});
        for (int i = 0; i < 500; ++i)
            for (ShownLight* light : {&with, &without}) {
                RecordEntry entry{.dt_ns = std::int64_t(1e9 * frame_s)};
                light->advance(entry,
                    {.source = tour,
                        .metered = {.ev = 5, .surfaces = view},
                        .range = range,
                        .filter = light == &with,
                        .dt_s = frame_s});
            }
        EXPECT_FALSE(with.filtered());
        EXPECT_EQ(with.ev(), without.ev());
        EXPECT_EQ(with.curve().has_value(), range);
    }
}

TEST(ShownLightTest, BlackIsSmoothAndKeepsNoLight)
{
    Flown flown({});
    flown.frame(5, {}, 0.5);
    EXPECT_NEAR(flown.light.fade(), 0.5, 1e-12);
    flown.frame(5, {}, 0.1);
    EXPECT_LT(flown.light.fade(), 0.1) << "smooth at its ends";
    flown.frame(5, {}, 1);
    EXPECT_EQ(flown.light.fade(), 1);
}

// However it is driven, neither the exposure nor black turns round twice in a second, nor goes faster than a calm exhibit
// may.
TEST(ShownLightTest, ACalmExhibitsLightTurnsOnceInASecond)
{
    Flown calm({.calm = true});
    for (int i = 0; i < 100; ++i)
        calm.frame(5);
    double ev = calm.light.ev(), black = calm.light.fade();
    int ev_way = 0, black_way = 0, ev_turns = 0, black_turns = 0;
    constexpr int frames = 1000;
    for (int i = 0; i < frames; ++i) {
        const bool up = i / 5 % 2 == 0; // five times a second
        calm.frame(5, controls_with(Looking{.exposure = up ? 1. : -1.}), up ? 1 : 0, up ? 6 : -6);
        const double ev_step = calm.light.ev() - ev, black_step = calm.light.fade() - black;
        EXPECT_LE(std::abs(ev_step), 6 * frame_s + 1e-9);
        const auto turn = [](int& way, double step, int& turns) {
            const int now = (step > 1e-12) - (step < -1e-12);
            turns += now != 0 && way != 0 && now != way;
            way = now != 0 ? now : way;
        };
        turn(ev_way, ev_step, ev_turns), turn(black_way, black_step, black_turns);
        ev = calm.light.ev(), black = calm.light.fade();
    }
    EXPECT_LE(ev_turns, int(frames * frame_s));
    EXPECT_LE(black_turns, int(frames * frame_s));
    EXPECT_GT(ev_turns + black_turns, 10) << "it follows";
}

// A replay has no light to meter: what the flight's frames have kept gives the same exposures.
TEST(ShownLightTest, AReplayShowsTheRecordedExposures)
{
    for (const bool calm : {false, true}) {
        Flown flown({.calm = calm});
        HandFlight again(start_at(-3), {}, 1);
        ShownLight shown({.calm = calm});
        for (int i = 0; i < 500; ++i) {
            Controls controls = controls_with(Looking{.exposure = std::sin(0.1 * i)});
            controls.set(Switch::lock_exposure, i % 90 == 89), controls.set(Switch::reset, i % 170 == 169);
            RecordEntry kept = flown.frame(5 + 3 * std::sin(0.03 * i), controls);
            again.advance(controls, kept.dt_ns);
            shown.advance(
                kept, {.source = again, .locks = controls[Switch::lock_exposure], .replays = true, .dt_s = frame_s});
            ASSERT_EQ(shown.ev(), flown.light.ev()) << i << ' ' << calm;
        }
    }
}

} // namespace shown_light_test
