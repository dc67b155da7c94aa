// The counts of an exhibit: classes of frame times, visits, days by the hour and Prometheus's text, each against sums that
// the test makes itself.
#include "runtime/operation/usage_statistics.h"
#include "tests/support/files.h"
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

namespace usage_statistics_test {

using namespace starbow;
using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

/// The values of an exposition by name with labels, read as its specification says, line by line.
std::map<std::string, double> values_in(const std::string& exposition)
{
    std::map<std::string, double> values;
    std::istringstream stream(exposition);
    std::string typed;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("# TYPE "))
            typed = line.substr(7, line.find(' ', 7) - 7);
        if (line.starts_with("#"))
            continue;
        const std::size_t space = line.rfind(' ');
        EXPECT_TRUE(line.starts_with(typed)) << line << " stands below the type of " << typed;
        EXPECT_TRUE(values.emplace(line.substr(0, space), std::stod(line.substr(space + 1))).second)
            << line << " comes twice";
    }
    return values;
}

fs::path empty_folder(const std::string& name)
{
    const fs::path folder = scratch(name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/// 2026-11-23 09:59:30 in the machine's zone.
std::time_t before_ten()
{
    std::tm parts{};
    parts.tm_year = 126, parts.tm_mon = 10, parts.tm_mday = 23, parts.tm_hour = 9, parts.tm_min = 59, parts.tm_sec = 30;
    parts.tm_isdst = -1;
    return std::mktime(&parts);
}

void add_frames(UsageStatistics& usage, int frames, double s)
{
    for (int i = 0; i < frames; ++i)
        usage.count([&](UsageCounts& counts) { counts.add_frame(s, false); });
}

} // namespace

TEST(UsageCounts, FrameTimesFallIntoTheirClasses)
{
    UsageCounts counts;
    std::vector<double> times;
    std::mt19937 random(5);
    for (int i = 0; i < 20000; ++i) {
        const double s = std::pow(10.0, std::uniform_real_distribution<double>(-3.2, 0.5)(random));
        times.push_back(s);
        counts.add_frame(s, s > 0.025);
    }
    std::ranges::sort(times);
    EXPECT_EQ(counts.frames(), times.size());
    EXPECT_EQ(counts.longest_frame_s, times.back());
    for (std::size_t i = 0; i < frame_classes_s.size(); ++i) {
        const auto below = std::ranges::count_if(
            times, [&](double s) { return s <= frame_classes_s[i] && (i == 0 || s > frame_classes_s[i - 1]); });
        EXPECT_EQ(counts.frames_by_time[i], std::uint64_t(below)) << frame_classes_s[i];
    }
    // A percentile is an upper bound, at most a class too long.
    for (const double part : {0.01, 0.5, 0.9, 0.999, 1.0}) {
        const double true_s = times[std::size_t(std::ceil(part * double(times.size()))) - 1];
        EXPECT_GE(counts.percentile_s(part), true_s);
        const auto its_class = std::ranges::lower_bound(frame_classes_s, true_s);
        EXPECT_LE(counts.percentile_s(part), its_class == frame_classes_s.end() ? times.back() : *its_class);
    }
    EXPECT_EQ(UsageCounts{}.percentile_s(0.5), 0);
}

TEST(UsageCounts, ASumIsThatOfItsPartsAndSurvivesItsFile)
{
    UsageCounts a, b;
    a.add_frame(0.01, false), b.add_frame(0.3, true);
    a.visits = 3, b.visits = 4, a.visits_s = 30, b.visits_s = 44, a.device_losses = 1, b.unplugged = 2;
    a.scenes_s = {{"avenue", 5}, {"train", 1}}, b.scenes_s = {{"train", 2}};
    a.resident_bytes = 7, b.resident_bytes = 6, b.worst_skew_s = 0.002;
    a += b;
    const UsageCounts read = usage_counts_of(nlohmann::json::parse(json_of(a).dump()));
    for (const UsageCounts* sum : {&std::as_const(a), &read}) {
        EXPECT_EQ(sum->frames(), 2u);
        EXPECT_EQ(sum->visits, 7u);
        EXPECT_EQ(sum->visits_s, 74);
        EXPECT_EQ(sum->device_losses, 1u);
        EXPECT_EQ(sum->unplugged, 2u);
        EXPECT_EQ(sum->missed_refreshes, 1u);
        EXPECT_EQ(sum->longest_frame_s, 0.3);
        EXPECT_EQ(sum->worst_skew_s, 0.002);
        EXPECT_EQ(sum->resident_bytes, 7u);
        EXPECT_EQ(sum->scenes_s, (std::map<std::string, double>{{"avenue", 5}, {"train", 3}}));
    }
}

TEST(UsageStatistics, EachHourHasItsOwnCountsAndARestartContinuesThem)
{
    const fs::path state = empty_folder("usage");
    const std::time_t start = before_ten();
    {
        UsageStatistics usage(state);
        usage.turn(start, {});
        add_frames(usage, 5, 0.01);
        usage.turn(start + 40, {}); // ten o'clock is past
        add_frames(usage, 7, 0.02);
        EXPECT_EQ(usage.since_start().frames(), 12u);
    }
    {
        UsageStatistics usage(state);
        usage.turn(start + 100, {});
        add_frames(usage, 3, 0.02);
    }
    const UsageDay day = load_usage_day(state, "2026-11-23");
    EXPECT_EQ(day.hours[9].frames(), 5u);
    EXPECT_EQ(day.hours[10].frames(), 10u);
    EXPECT_EQ(days_in(state), std::vector<std::string>{"2026-11-23"});
}

TEST(UsageStatistics, MidnightBeginsANewDayAndAClockSetBackLosesNothing)
{
    const fs::path state = empty_folder("midnight");
    const std::time_t start = before_ten();
    {
        UsageStatistics usage(state);
        usage.turn(start, {});
        add_frames(usage, 1, 0.01);
        usage.turn(start + 86400, {});
        add_frames(usage, 2, 0.01);
        usage.turn(start, {}); // a day back
        add_frames(usage, 4, 0.01);
    }
    EXPECT_EQ(load_usage_day(state, "2026-11-23").hours[9].frames(), 5u);
    EXPECT_EQ(load_usage_day(state, "2026-11-24").hours[9].frames(), 2u);
}

TEST(UsageStatistics, AFolderThatCannotBeWrittenLosesNoCount)
{
    const fs::path state = write_text("no-folder", "a file");
    UsageStatistics usage(state);
    const std::time_t start = before_ten();
    usage.turn(start, {});
    add_frames(usage, 9, 0.01);
    for (int minute = 1; minute < 4; ++minute)
        usage.turn(start + 60 * minute, {});
    EXPECT_EQ(usage.since_start().frames(), 9u);
}

TEST(UsageStatistics, ADayThatCouldNotBeWrittenAtMidnightIsWrittenLater)
{
    const std::time_t start = before_ten();
    // The write that fails may or may not have ended when the next one is due.
    for (int i = 0; i < 100; ++i) {
        const fs::path state = write_text("full-at-midnight" + std::to_string(i), "a file where the folder should be");
        {
            UsageStatistics usage(state);
            usage.turn(start, {});
            add_frames(usage, 3, 0.01);
            usage.turn(start + 86400, {});
            add_frames(usage, 2, 0.01);
            usage.turn(start + 2 * 86400, {});
            add_frames(usage, 1, 0.01);
            usage.turn(start, {}); // back in the first day, which no file holds
            add_frames(usage, 4, 0.01);
            fs::remove(state);
        }
        EXPECT_EQ(load_usage_day(state, "2026-11-23").hours[9].frames(), 7u);
        EXPECT_EQ(load_usage_day(state, "2026-11-24").hours[9].frames(), 2u);
        EXPECT_EQ(load_usage_day(state, "2026-11-25").hours[9].frames(), 1u);
    }
}

TEST(UsageStatistics, DamagedDaysAreRefusedInOneLineOrRead)
{
    const fs::path state = empty_folder("damaged");
    {
        UsageStatistics usage(state);
        usage.turn(before_ten(), {});
        usage.count([](UsageCounts& counts) { counts.scenes_s["avenue"] = 3; });
        add_frames(usage, 2, 0.01);
    }
    const std::string good = read_text(day_file(state, "2026-11-23"));
    expect_survives(
        [&](const fs::path& file) {
            fs::copy_file(file, day_file(state, "2026-11-23"), fs::copy_options::overwrite_existing);
            load_usage_day(state, "2026-11-23");
        },
        {good}, fuzz_count() / 5);
    EXPECT_NE(complaint([&] { load_usage_day(state, "../2026"); }).find("is not a day"), std::string::npos);
}

TEST(Exposition, SaysWhatWasCounted)
{
    UsageCounts counts;
    for (int i = 0; i < 100; ++i)
        counts.add_frame(0.016, false);
    counts.add_frame(2.5, true);
    counts.visits = 12, counts.visits_s = 600, counts.scenes_s = {{"a\"b\\c\nd", 4}};
    const auto values = values_in(exposition_of(counts, {.uptime_s = 5, .threads = 9, .version = "0.9"}));
    EXPECT_EQ(values.at("starbow_frame_seconds_bucket{le=\"0.0125\"}"), 0);
    EXPECT_EQ(values.at("starbow_frame_seconds_bucket{le=\"0.017\"}"), 100);
    EXPECT_EQ(values.at("starbow_frame_seconds_bucket{le=\"1\"}"), 100);
    EXPECT_EQ(values.at("starbow_frame_seconds_bucket{le=\"+Inf\"}"), 101);
    EXPECT_EQ(values.at("starbow_frame_seconds_count"), 101);
    EXPECT_NEAR(values.at("starbow_frame_seconds_sum"), 4.1, 1e-9);
    EXPECT_EQ(values.at("starbow_missed_refreshes_total"), 1);
    EXPECT_EQ(values.at("starbow_visits_total"), 12);
    EXPECT_EQ(values.at("starbow_threads"), 9);
    EXPECT_EQ(values.at("starbow_build_info{version=\"0.9\"}"), 1);
    EXPECT_EQ(values.at(R"(starbow_scene_seconds_total{scene="a\"b\\c\nd"})"), 4);
}

TEST(Exposition, SaysWhichMachinesAreInStep)
{
    EXPECT_EQ(values_in(exposition_of({}, {})).at("starbow_machines"), 1);
    const std::vector<MachineHealth> machines{{"left", true, 6.94}, {"up", true, 7.06}, {"right", false, 9, true}, {"a\"b"}};
    const auto values = values_in(exposition_of({}, {.machines = machines}));
    EXPECT_EQ(values.at("starbow_machines"), 4);
    EXPECT_EQ(values.at("starbow_machines_in_step"), 2);
    EXPECT_EQ(values.at("starbow_machine_in_step{machine=\"left\"}"), 1);
    EXPECT_EQ(values.at("starbow_machine_in_step{machine=\"right\"}"), 0);
    EXPECT_EQ(values.at(R"(starbow_machine_in_step{machine="a\"b"})"), 0);
    EXPECT_NEAR(values.at("starbow_machine_frame_seconds{machine=\"up\"}"), 0.00706, 1e-9);
    EXPECT_EQ(line_of(machines), "left 6.9 ms, up 7.1 ms, right has another file, a\"b away");
    EXPECT_EQ(line_of({}), "");
}

TEST(UsageStatistics, TheTextfileIsWhole)
{
    const fs::path folder = empty_folder("textfile");
    {
        UsageStatistics usage({}, folder / "starbow.prom");
        usage.turn(before_ten(), {.uptime_s = 1});
        usage.turn(before_ten() + 20, {.uptime_s = 21});
    }
    EXPECT_EQ(values_in(read_text(folder / "starbow.prom")).at("starbow_uptime_seconds"), 21);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

} // namespace usage_statistics_test
