// The statistics of starbow bench --input.
#include "runtime/operation/latency.h"
#include <gtest/gtest.h>

namespace latency_stats_test {

using namespace starbow;

// The textbooks' example of nearest rank: 15, 20, 35, 40, 50.
TEST(Latency, PercentilesAreOfNearestRank)
{
    const std::vector<double> five{35, 20, 15, 50, 40};
    EXPECT_EQ(percentile(five, 0.05), 15);
    EXPECT_EQ(percentile(five, 0.3), 20);
    EXPECT_EQ(percentile(five, 0.4), 20);
    EXPECT_EQ(percentile(five, 0.5), 35);
    EXPECT_EQ(percentile(five, 1), 50);
    EXPECT_EQ(percentile({}, 0.5), 0);
    EXPECT_EQ(percentile({7}, 0.99), 7);
    // For 1 to 100 the n-th percentile is n, even where n / 100 times 100 is not n in binary.
    std::vector<double> hundred;
    for (int i = 100; i > 0; --i)
        hundred.push_back(i);
    for (int i = 1; i <= 100; ++i)
        EXPECT_EQ(percentile(hundred, i / 100.0), i);
}

// Four frames of 16 ms: a report before the first, one that waits for a frame, none, and two of which the later counts.
TEST(Latency, AReportCountsInTheFrameThatFirstShowsIt)
{
    constexpr std::int64_t ms = 1'000'000;
    Latency latency;
    latency.add({.report_ns = 95 * ms, .read_ns = 100 * ms, .handed_ns = 102 * ms, .shown_ns = 110 * ms});
    latency.add({.report_ns = 101 * ms, .read_ns = 116 * ms, .handed_ns = 119 * ms, .shown_ns = 126 * ms});
    latency.add({.report_ns = 101 * ms, .read_ns = 132 * ms, .handed_ns = 133 * ms, .shown_ns = 142 * ms});
    latency.add({.report_ns = 147 * ms, .read_ns = 148 * ms, .handed_ns = 152 * ms, .shown_ns = 160 * ms});
    EXPECT_EQ(latency.frames(), 4u);
    EXPECT_EQ(latency.reports(), 3u);
    EXPECT_DOUBLE_EQ(latency.seconds(), 0.05);
    EXPECT_EQ(latency.report_ms(), (std::vector<double>{15, 25, 13}));
    EXPECT_EQ(latency.frame_ms(), (std::vector<double>{16, 16, 18}));
    EXPECT_EQ(latency.own_ms(), (std::vector<double>{2, 3, 1, 4}));
    EXPECT_EQ(latency.present_ms(), (std::vector<double>{8, 7, 9, 8}));
    EXPECT_EQ(latency.bound_ms(), (std::vector<double>{15, 26, 26, 28}));
    EXPECT_NE(latency.describe().find("15.00     25.00     25.00"), std::string::npos) << latency.describe();
    // The report came before the last controls were read, and those were handed over after it.
    latency.add({.report_ns = 147 * ms + 1, .read_ns = 164 * ms, .handed_ns = 165 * ms, .shown_ns = 166 * ms});
    EXPECT_NEAR(latency.bound_ms().back(), 19, 1e-5);
    EXPECT_EQ(latency.describe().find("not in the table"), std::string::npos);
}

// A frame that compiles shaders for 300 ms, and the one after it with the report that waited for it, stay out of the table;
// the frame after both counts with its own times.
TEST(Latency, FramesOfTheCompilerAreCountedApart)
{
    constexpr std::int64_t ms = 1'000'000;
    Latency latency;
    latency.add({.report_ns = 95 * ms, .read_ns = 100 * ms, .handed_ns = 400 * ms, .shown_ns = 410 * ms, .compiled = true});
    latency.add({.report_ns = 101 * ms, .read_ns = 416 * ms, .handed_ns = 419 * ms, .shown_ns = 426 * ms});
    EXPECT_EQ(latency.frames(), 0u);
    EXPECT_EQ(latency.reports(), 0u);
    EXPECT_EQ(latency.seconds(), 0);
    latency.add({.report_ns = 427 * ms, .read_ns = 432 * ms, .handed_ns = 433 * ms, .shown_ns = 442 * ms});
    latency.add({.report_ns = 427 * ms, .read_ns = 448 * ms, .handed_ns = 450 * ms, .shown_ns = 458 * ms});
    EXPECT_EQ(latency.apart(), 2u);
    EXPECT_EQ(latency.frames(), 2u);
    EXPECT_DOUBLE_EQ(latency.seconds(), 0.016);
    EXPECT_EQ(latency.report_ms(), (std::vector<double>{15}));
    EXPECT_EQ(latency.frame_ms(), (std::vector<double>{16, 16}));
    EXPECT_EQ(latency.own_ms(), (std::vector<double>{1, 2}));
    EXPECT_EQ(latency.present_ms(), (std::vector<double>{9, 8}));
    EXPECT_EQ(latency.bound_ms(), (std::vector<double>{26, 26}));
    EXPECT_NE(
        latency.describe().find("not in the table: 2 frames with or just after a compilation of shaders, the longest of "
                                "310.00 ms"),
        std::string::npos)
        << latency.describe();
}

} // namespace latency_stats_test
