// Flashes of pictures whose flicker is known; and a counter that shares no code with the program's, for pictures of chance.
#include "runtime/images/flashes.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace flashes_test {

using namespace starbow;

namespace {

constexpr double pi = 3.14159265358979324;
constexpr int per_s = 60;

/// A field of pixels around straight ahead: a pixel's width in degrees, and pixels along a side.
std::vector<SeenPixel> window(double pixel_deg, int side)
{
    std::vector<SeenPixel> pixels;
    const double step = pixel_deg * pi / 180;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double azimuth = (x + 0.5 - side / 2.0) * step, elevation = (y + 0.5 - side / 2.0) * step;
            pixels.push_back({glm::vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                  -std::cos(elevation) * std::cos(azimuth)),
                float(step * step * std::cos(elevation)), 0});
        }
    return pixels;
}

/// The counter after pictures of which each pixel's light is given by its index and the time in seconds.
FlashCounter counted(
    std::vector<SeenPixel> pixels, double seconds, const std::function<glm::vec3(std::size_t, double)>& light)
{
    FlashCounter counter(pixels, 1);
    std::vector<glm::vec3> picture(pixels.size());
    for (int frame = 0; frame <= int(seconds * per_s); ++frame) {
        for (std::size_t i = 0; i < picture.size(); ++i)
            picture[i] = light(i, double(frame) / per_s);
        counter.take(std::int64_t(frame) * 1'000'000'000 / per_s, picture);
    }
    return counter;
}

/// 1 in the first half of each period, then 0; the first change comes half a frame after a whole period.
double square(double t, double hz) { return std::fmod((t + 0.5 / per_s) * hz, 1) < 0.5 ? 1 : 0; }
double sine(double t, double hz) { return 0.5 + 0.5 * std::sin(2 * pi * hz * t); }

Flashes worst_of_flicker(
    double hz, double depth, double dark = 0.2, bool smooth = false, FlashKind kind = FlashKind::general)
{
    return counted(window(1, 20), 4, [&](std::size_t, double t) {
        return glm::vec3(float(dark + depth * (smooth ? sine(t, hz) : square(t, hz))));
    }).worst(kind, 0);
}

/// The general changes by their definition, without a walk from extreme to extreme: the greatest number of times, in turn up
/// and down, between which the value has changed enough, by dynamic programming over all pairs of frames. Entry t is the
/// number up to frame t.
std::vector<int> changes_by_definition(const std::vector<double>& values)
{
    const std::size_t n = values.size();
    std::vector<int> most_up(n, 0), most_down(n, 0), best(n, 0); // of which the last one goes up or down, up to t
    for (std::size_t t = 1; t < n; ++t) {
        most_up[t] = most_up[t - 1], most_down[t] = most_down[t - 1];
        for (std::size_t s = 0; s < t; ++s) {
            if (std::abs(values[s] - values[t]) < 0.1 - 1e-6 || std::min(values[s], values[t]) >= 0.8)
                continue;
            if (values[t] > values[s])
                most_up[t] = std::max(most_up[t], 1 + most_down[s]);
            else
                most_down[t] = std::max(most_down[t], 1 + most_up[s]);
        }
        best[t] = std::max(most_up[t], most_down[t]);
    }
    return best;
}

/// The changes of a whole series of redness that involve a saturated red, from hindsight: of all its extremes the two
/// neighbours that differ least are left out, again and again, until all that remain differ by more than 20.
int red_changes_in_hindsight(const std::vector<double>& values, const std::vector<char>& saturated)
{
    std::vector<std::size_t> extremes;
    for (std::size_t t = 0; t < values.size(); ++t) {
        const std::size_t n = extremes.size();
        const auto value = [&](std::size_t back) { return values[extremes[n - back]]; };
        if (n > 0 && values[t] == value(1))
            extremes.back() = t;
        else if (n > 1 && (value(1) > value(2)) == (values[t] > value(1)))
            extremes.back() = t;
        else
            extremes.push_back(t);
    }
    while (extremes.size() > 1) {
        std::size_t least = 0;
        const auto apart = [&](std::size_t i) { return std::abs(values[extremes[i]] - values[extremes[i + 1]]); };
        for (std::size_t i = 1; i + 1 < extremes.size(); ++i)
            if (apart(i) < apart(least))
                least = i;
        if (apart(least) > 20)
            break;
        const bool first = least == 0, last = least + 2 == extremes.size();
        const auto at = extremes.begin() + std::ptrdiff_t(least);
        if (first)
            extremes.erase(at);
        else if (last)
            extremes.erase(at + 1);
        else
            extremes.erase(at, at + 2);
    }
    int changes = 0;
    for (std::size_t i = 0; i + 1 < extremes.size(); ++i)
        changes += std::any_of(saturated.begin() + std::ptrdiff_t(extremes[i]),
            saturated.begin() + std::ptrdiff_t(extremes[i + 1]) + 1, [](char is) { return is != 0; });
    return changes;
}

/// A walk of chance, faster and slower, with rests and leaps, in red or in grey.
std::vector<glm::vec3> walk_of_chance(std::mt19937& random)
{
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<glm::vec3> walk{glm::vec3(any(random), any(random), any(random))};
    const double leap = std::pow(any(random), 3), calm = any(random), reddens = any(random);
    while (walk.size() < 240) {
        glm::vec3 next = walk.back();
        for (int k = 0; k < 3; ++k)
            next[k] = any(random) < calm ? next[k] : float(std::clamp(next[k] + leap * (2 * any(random) - 1), 0.0, 1.0));
        if (any(random) < 0.3 * reddens)
            next = glm::vec3(next.r, 0.05f * next.g, 0.05f * next.b);
        walk.push_back(next);
    }
    return walk;
}

} // namespace

TEST(FlashesTest, FlickerOfTheWholeFieldCountsItsPairsOfChanges)
{
    for (const bool smooth : {false, true}) {
        EXPECT_EQ(worst_of_flicker(2, 0.11, 0.2, smooth).changes, 4) << smooth;
        EXPECT_EQ(worst_of_flicker(3, 0.11, 0.2, smooth).changes, 6) << smooth;
        EXPECT_FALSE(worst_of_flicker(3, 0.11, 0.2, smooth).breaks_limit()) << smooth;
        EXPECT_EQ(worst_of_flicker(4, 0.11, 0.2, smooth).changes, 8) << smooth;
        EXPECT_TRUE(worst_of_flicker(4, 0.11, 0.2, smooth).breaks_limit()) << smooth;
        EXPECT_EQ(worst_of_flicker(4, 0.09, 0.2, smooth).changes, 0) << smooth;
    }
    EXPECT_EQ(worst_of_flicker(4, 0.1).changes, 8); // 10 % or more
    EXPECT_EQ(worst_of_flicker(30, 1, 0).changes, 60); // from frame to frame
}

TEST(FlashesTest, OnlyTheDarkerEndMustBeBelowEightTenths)
{
    EXPECT_EQ(worst_of_flicker(4, 0.15, 0.79).changes, 8);
    EXPECT_EQ(worst_of_flicker(4, 0.15, 0.81).changes, 0);
    // A fall that is large enough long before it reaches the dark counts once it does.
    const Flashes slow = counted(window(1, 20), 4, [](std::size_t, double t) {
        return glm::vec3(float(0.75 + 0.25 * std::abs(1 - std::fmod(t * 4, 2)))); // 2 Hz
    }).worst(FlashKind::general, 0);
    EXPECT_EQ(slow.changes, 4);
}

TEST(FlashesTest, AChangeRunsOverManyFramesFromExtremeToExtreme)
{
    // Steps of a hundredth from frame to frame, and noise of two hundredths: only the extremes are a tenth apart.
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-0.02, 0.02);
    std::vector<double> noises(1000);
    for (double& n : noises)
        n = noise(random);
    const auto ramps = [&](double height) {
        return counted(window(1, 20), 6, [&](std::size_t, double t) {
            const double phase = std::fmod(t * 2, 1);
            return glm::vec3(float(
                0.3 + height * (phase < 0.5 ? 2 * phase : 2 - 2 * phase) + noises[std::size_t(std::lround(t * per_s))]));
        }).worst(FlashKind::general, 0);
    };
    EXPECT_GE(ramps(0.16).changes, 4);
    EXPECT_LE(ramps(0.16).changes, 5); // the noise moves a change by some frames
    EXPECT_EQ(ramps(0.05).changes, 0);
}

TEST(FlashesTest, SlowFadesAreNoFlashes)
{
    const Flashes fades = counted(window(1, 20), 20, [](std::size_t, double t) {
        return glm::vec3(float(0.5 - 0.5 * std::cos(2 * pi * t / 5)));
    }).worst(FlashKind::general, 0);
    EXPECT_EQ(fades.changes, 0); // one change in a second is half a pair
}

TEST(FlashesTest, TheAreaIsASolidAngleInAFieldOfTenDegrees)
{
    // A square of pixels of 0.1 degrees: 44 x 44 are 0.0058974 sr, 45 x 45 are 0.0061685 sr, to a thousandth.
    const int side = 60;
    const auto patch = [&](int wide) {
        return counted(window(0.1, side), 2, [&](std::size_t i, double t) {
            return int(i) % side < wide && int(i) / side < wide ? glm::vec3(float(square(t, 5))) : glm::vec3(0.5f);
        }).worst(FlashKind::general, 0);
    };
    EXPECT_EQ(patch(44).changes, 0);
    EXPECT_EQ(patch(45).changes, 10);
    EXPECT_NEAR(patch(45).area_sr, 2025 * std::pow(pi / 1800, 2), 2e-5);

    // Two patches of 0.004 sr: within one field they add up, and far apart they do not.
    const int wide = 40; // pixels of a degree
    const auto two = [&](int apart) {
        return counted(window(1, wide), 2, [&](std::size_t i, double t) {
            const int x = int(i) % wide, y = int(i) / wide;
            const bool in
                = y >= 18 && y < 22 && ((x >= 8 && x < 11) || (x >= 8 + apart && x < 11 + apart)); // 12 square degrees each
            return in ? glm::vec3(float(square(t, 5))) : glm::vec3(0.5f);
        }).worst(FlashKind::general, 0);
    };
    EXPECT_EQ(two(4).changes, 10);
    EXPECT_NEAR(two(4).area_sr, 24 * std::pow(pi / 180, 2), 2e-4);
    EXPECT_EQ(two(20).changes, 0);
}

TEST(FlashesTest, PixelsOfManyDegreesAndOfFewCountByTheirSolidAngleAlone)
{
    // The same sky in pixels of two sizes.
    for (const double pixel_deg : {0.25, 0.5, 1.0}) {
        const int side = int(20 / pixel_deg);
        const Flashes flashes = counted(window(pixel_deg, side), 2, [&](std::size_t i, double t) {
            return std::max(int(i) % side, int(i) / side) * pixel_deg < 6 ? glm::vec3(float(square(t, 5))) : glm::vec3(0);
        }).worst(FlashKind::general, 0);
        EXPECT_EQ(flashes.changes, 10) << pixel_deg;
        EXPECT_NEAR(flashes.area_sr, 36 * std::pow(pi / 180, 2), 5e-4) << pixel_deg; // 8.5 degrees across: in one field
    }
}

TEST(FlashesTest, ASaturatedRedFlashesAndOrangeDoesNot)
{
    const auto flicker = [](const glm::vec3& one, const glm::vec3& two, double hz) {
        FlashCounter counter
            = counted(window(1, 20), 3, [&](std::size_t, double t) { return square(t, hz) > 0 ? one : two; });
        return counter.worst(FlashKind::red, 0).changes;
    };
    const glm::vec3 red(0.3f, 0.03f, 0.03f), orange(0.6f, 0.2f, 0.01f), black(0), grey(0.3f);
    EXPECT_EQ(flicker(red, black, 4), 8); // 0.3 / 0.36 = 0.83; (0.3 - 0.06) * 320 = 77
    EXPECT_EQ(flicker(red, grey, 4), 8);
    EXPECT_EQ(flicker(red, orange, 4), 8); // (0.6 - 0.21) * 320 = 125: the change is 48
    EXPECT_EQ(flicker(orange, black, 4), 0); // 0.6 / 0.81 = 0.74
    EXPECT_EQ(flicker({0.06f, 0, 0}, black, 4), 0); // 0.06 * 320 = 19.2
    EXPECT_EQ(flicker({0.07f, 0, 0}, black, 4), 8);
    EXPECT_EQ(flicker(orange, {0.0003f, 0, 0}, 4), 0); // a byte of black is no red
    EXPECT_EQ(flicker(red, black, 3), 6);
    // Luminance 0.2126 * 0.3 + ...: less than a tenth, and no general flash.
    EXPECT_EQ(counted(window(1, 20), 3, [&](std::size_t, double t) { return square(t, 4) > 0 ? red : black; })
                  .worst(FlashKind::general, 0)
                  .changes,
        0);
}

TEST(FlashesTest, EachOutputHasItsOwnFigureAndFieldsReachOverTheSeam)
{
    // Two outputs side by side; at their seam each flashes in an area that is too small alone.
    std::vector<SeenPixel> pixels = window(1, 20);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i].output = int(i) % 20 < 10 ? 0 : 1;
    FlashCounter counter(pixels, 2);
    std::vector<glm::vec3> light(pixels.size());
    for (int frame = 0; frame < 2 * per_s; ++frame) {
        for (int i = 0; i < 400; ++i) {
            const bool flashes = i % 20 >= 7 && i % 20 < 13 && i / 20 < 4; // 24 square degrees, 12 of each output
            light[std::size_t(i)] = glm::vec3(flashes ? float(square(double(frame) / per_s, 5)) : 0.f);
        }
        counter.take(std::int64_t(frame) * 1'000'000'000 / per_s, light);
    }
    EXPECT_EQ(counter.worst(FlashKind::general, 0).changes, 10);
    EXPECT_EQ(counter.worst(FlashKind::general, 1).changes, 10);
}

TEST(FlashesTest, TheFirstSecondOfALongerFlickerIsTheWorst)
{
    FlashCounter counter = counted(
        window(1, 20), 6, [](std::size_t, double t) { return glm::vec3(t >= 2 && t < 3 ? float(square(t, 5)) : 0.5f); });
    const Flashes worst = counter.worst(FlashKind::general, 0);
    EXPECT_GE(worst.changes, 9);
    EXPECT_GT(worst.time_ns, 2'800'000'000);
    EXPECT_LT(worst.time_ns, 3'200'000'000);
    EXPECT_EQ(counter.now(FlashKind::general, 0).changes, 0); // long over
    EXPECT_EQ(counter.now(FlashKind::general, 0).time_ns, 6'000'000'000);
}

TEST(FlashesTest, ACounterByTheDefinitionAloneAgrees)
{
    std::mt19937 random(7);
    const std::vector<SeenPixel> pixels = window(1, 20);
    for (int trial = 0; trial < 40; ++trial) {
        const std::vector<glm::vec3> walk = walk_of_chance(random);
        std::vector<double> grey;
        for (const glm::vec3& c : walk)
            grey.push_back(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
        const std::vector<int> upto = changes_by_definition(grey);
        FlashCounter counter(pixels, 1);
        for (int t = 0; t < int(walk.size()); ++t) {
            counter.take(
                std::int64_t(t) * 1'000'000'000 / per_s, std::vector<glm::vec3>(pixels.size(), walk[std::size_t(t)]));
            const int in_second = upto[std::size_t(t)] - (t >= per_s ? upto[std::size_t(t - per_s)] : 0);
            ASSERT_EQ(int(counter.changes(FlashKind::general)[0]), in_second) << "trial " << trial << ", frame " << t;
            ASSERT_EQ(counter.now(FlashKind::general, 0).changes, in_second >= 2 ? in_second : 0);
        }
    }
}

TEST(FlashesTest, RedChangesAgreeWithThoseFromHindsight)
{
    std::mt19937 random(11);
    const std::vector<SeenPixel> pixels = window(1, 5);
    int all = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const std::vector<glm::vec3> walk = walk_of_chance(random);
        std::vector<double> red;
        std::vector<char> saturated;
        for (const glm::vec3& c : walk) {
            red.push_back(float(std::max(0.0, 320 * (double(c.r) - c.g - c.b))));
            saturated.push_back(c.r >= 0.003f && c.r >= 0.8f * (c.r + c.g + c.b));
        }
        FlashCounter counter(pixels, 1);
        for (int t = 0; t < int(walk.size()); ++t) // all of it within a second
            counter.take(t * 1'000'000, std::vector<glm::vec3>(pixels.size(), walk[std::size_t(t)]));
        const int changes = red_changes_in_hindsight(red, saturated);
        ASSERT_EQ(int(counter.changes(FlashKind::red)[0]), changes) << "trial " << trial;
        all += changes;
    }
    EXPECT_GT(all, 1000);
}

} // namespace flashes_test
