// The guard of a calm exhibit's light: what flickers is dimmed before it flashes too often, and what does not stays bright.
#include "runtime/images/flash_guard.h"
#include "runtime/images/flashes.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace flash_guard_test {

using namespace starbow;

namespace {

constexpr int across = 64, down = 48, per_s = 60;
constexpr double pixel_deg = 0.7, pi = 3.14159265358979324;

struct Shown {
    int changes = 0; ///< in the worst second, as WCAG counts them
    double dimmest = 1, last = 1;
};

/// Shows a window's light, by place and time, through a guard whose samples are those of the picture before.
Shown shown(double seconds, const std::function<double(int x, int y, double t)>& light)
{
    std::vector<SeenPixel> pixels;
    std::vector<LuminanceSample> samples(std::size_t(across) * down);
    const double step = pixel_deg * pi / 180;
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const double azimuth = (x - across / 2) * step, height = (y - down / 2) * step;
            pixels.push_back(
                {glm::vec3(std::cos(height) * std::sin(azimuth), std::sin(height), -std::cos(height) * std::cos(azimuth)),
                    float(step * step), 0});
        }
    FlashCounter counter(pixels, 1);
    FlashGuard guard;
    Shown result;
    std::vector<glm::vec3> picture(pixels.size());
    for (int frame = 0; frame < int(seconds * per_s); ++frame) {
        for (int y = 0; y < down; ++y)
            for (int x = 0; x < across; ++x) {
                const std::size_t i = std::size_t(y * across + x);
                samples[i] = {float(light(x, y, double(frame) / per_s)), float(step * step)};
                picture[i] = glm::vec3(std::min(samples[i].luminance, 1.f) * float(guard.light()));
            }
        counter.take(std::int64_t(frame) * 1'000'000'000 / per_s, picture);
        guard.take(
            samples, across, [](double luminance) { return luminance; }, 1. / per_s);
        result.dimmest = std::min(result.dimmest, guard.light());
        result.last = guard.light();
    }
    result.changes = counter.worst(FlashKind::general, 0).changes;
    return result;
}

double wave(double t, double hz) { return std::sin(2 * pi * hz * t) > 0 ? 1 : 0; }

} // namespace

TEST(FlashGuardTest, WhatFlickersIsDimmedBeforeItFlashesTooOften)
{
    for (const double hz : {1., 4., 9., 25.})
        for (const double contrast : {0.15, 0.4, 1.}) {
            const Shown seen = shown(5, [&](int, int, double t) { return 0.5 + contrast * (wave(t, hz) - 0.5); });
            EXPECT_LE(seen.changes, 2 * most_flashes) << hz << " Hz, contrast " << contrast;
            EXPECT_EQ(seen.dimmest<1, hz> 2) << hz << " Hz, contrast " << contrast;
        }
}

TEST(FlashGuardTest, APatternThatPassesByIsDimmedToo)
{
    for (const double deg_per_s : {8., 20., 60.}) {
        const Shown seen
            = shown(8, [&](int x, int, double t) { return 0.1 + 0.7 * wave((x * pixel_deg - deg_per_s * t) / 3, 1); });
        EXPECT_LE(seen.changes, 2 * most_flashes) << deg_per_s;
    }
}

TEST(FlashGuardTest, WhatDoesNotFlashStaysBright)
{
    EXPECT_EQ(shown(4, [](int x, int y, double) { return (x * 7 + y * 3) % 10 / 10.; }).dimmest, 1) << "at rest";
    EXPECT_EQ(shown(4, [](int, int, double t) { return wave(t, 0.6); }).dimmest, 1) << "slow";
    EXPECT_EQ(shown(4, [](int, int, double t) { return 0.5 + 0.07 * wave(t, 8); }).dimmest, 1) << "faint";
    EXPECT_EQ(shown(4, [](int x, int y, double t) { return x < 6 && y < 4 ? wave(t, 8) : 0.3; }).dimmest, 1) << "small";
    EXPECT_EQ(
        shown(4, [](int x, int y, double t) { return (x + 8) % 16 < 3 && (y + 8) % 16 < 5 ? wave(t, 8) : 0.3; }).dimmest, 1)
        << "small spots in fields of their own";
}

TEST(FlashGuardTest, TheLightComesBackAndFlashesNoMoreBySoDoing)
{
    const Shown seen = shown(15, [](int, int, double t) { return t < 3 ? wave(t, 7) : 0.9; });
    EXPECT_LE(seen.changes, 2 * most_flashes);
    EXPECT_LE(seen.dimmest, FlashGuard::factors.back());
    EXPECT_EQ(seen.last, 1);
}

TEST(FlashGuardTest, LightOfChanceKeepsToTheLimit)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    for (int trial = 0; trial < 5; ++trial) {
        // Blocks that hold their light for times of chance.
        std::vector<double> light(64, 0), until(64, 0), slow(64);
        for (double& s : slow)
            s = 0.02 + 0.6 * any(random) * any(random);
        double now = -1;
        const Shown seen = shown(6, [&](int x, int y, double t) {
            if (t != now) {
                now = t;
                for (std::size_t b = 0; b < 64; ++b)
                    if (t >= until[b])
                        until[b] = t + slow[b] * 2 * any(random), light[b] = any(random);
            }
            return light[std::size_t(y / 6 * 8 + x / 8)];
        });
        EXPECT_LE(seen.changes, 2 * most_flashes) << trial;
    }
}

} // namespace flash_guard_test
