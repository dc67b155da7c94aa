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
