// What an exhibit keeps about itself in plain files: damage changes it to a harmless value, or is noticed, and stops
// nothing.
#include "runtime/operation/crash_counter.h"
#include "runtime/operation/last_language.h"
#include "runtime/operation/usage_statistics.h"
#include "tests/support/damage.h"
#include <nlohmann/json.hpp>

namespace kept_state_test {

using namespace starbow;
using namespace starbow::testing;
namespace fs = std::filesystem;

namespace {

// Too few crashes are counted, never too many: the exhibit starts, and starts in its usual mode.
TEST(KeptState, ADamagedListOfEndsNamesNoMore)
{
    const fs::path folder = scratch("ends-damaged"), file = folder / "ends";
    for (int i = 0; i < 4; ++i)
        CrashCounter(folder, 10'000 + 60 * i);
    const std::string whole = read_text(file);
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        if (damaged.size() > whole.size())
            return; // more lines are more ends
        write_bytes(file, damaged);
        const int lately = CrashCounter(folder, 10'300).lately();
        EXPECT_TRUE(lately >= 0 && lately <= 4) << how << ": " << lately;
        EXPECT_TRUE(read_text(file).ends_with("running\n")) << how << ": it is written again";
    });
    write_bytes(file, whole);
    EXPECT_EQ(CrashCounter(folder, 10'300).lately(), 4);
    for (const std::string& more : {std::string(5000, 'x'), std::string(100'000, '\0'), std::string(100'000, '\n')}) {
        write_bytes(file, whole + more);
        EXPECT_LE(CrashCounter(folder, 10'300).lately(), 4);
    }
}

TEST(KeptState, ADamagedLanguageIsANameOrNone)
{
    const fs::path folder = scratch("language-damaged"), file = folder / "language";
    fs::create_directories(folder);
    for_each_damage("pt-BR", [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        const std::string kept = kept_language(folder);
        EXPECT_TRUE(kept.empty() || kept == damaged) << how;
        EXPECT_EQ(kept.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-_"), kept.npos) << how;
        EXPECT_LE(kept.size(), 32u) << how;
    });
}

TEST(KeptState, ADamagedDayIsNoticed)
{
    const fs::path folder = scratch("day-damaged");
    std::tm parts{};
    parts.tm_year = 126, parts.tm_mon = 10, parts.tm_mday = 23, parts.tm_hour = 9, parts.tm_isdst = -1;
    const std::time_t nine = std::mktime(&parts);
    {
        UsageStatistics usage(folder);
        usage.turn(nine, {});
        usage.count([](UsageCounts& counts) {
            counts.add_frame(0.016, false);
            counts.add_frame(0.3, true);
            counts.visits = 17, counts.visits_s = 1234.5, counts.scenes_s["avenue"] = 99.25;
        });
    }
    const fs::path file = day_file(folder, "2026-11-23");
    const std::string whole = read_text(file);
    const auto text_of = [](const UsageDay& day) {
        std::string text;
        for (const UsageCounts& counts : day.hours)
            text += counts.frames() > 0 || counts.visits > 0 ? json_of(counts).dump() : "-";
        return text;
    };
    const std::string right = text_of(load_usage_day(folder, "2026-11-23"));
    EXPECT_NE(right, text_of({}));
    int same = 0, noticed = 0;
    for_each_damage(whole, [&](const std::string& damaged, const std::string& how) {
        write_bytes(file, damaged);
        try {
            EXPECT_EQ(text_of(load_usage_day(folder, "2026-11-23")), right) << how;
            ++same; // a space became another, or the checksum lost its name
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << how;
            ++noticed;
        }
    });
    std::printf("%d damages noticed, %d without effect\n", noticed, same);
    EXPECT_GT(noticed, 6 * int(whole.size()));
    // The exhibit goes on with a damaged day.
    std::string other = whole;
    other[whole.find("1234.5")] = '3';
    write_bytes(file, other);
    {
        UsageStatistics usage(folder);
        usage.turn(nine, {});
        usage.count([](UsageCounts& counts) { counts.visits = 1; });
        usage.count([](UsageCounts& counts) { counts.add_frame(0.016, false); });
    }
    EXPECT_EQ(load_usage_day(folder, "2026-11-23").hours[9].visits, 1u);
    // A day of a version without checksums.
    nlohmann::json old = nlohmann::json::parse(whole);
    old.erase("sum");
    write_bytes(file, old.dump());
    EXPECT_EQ(text_of(load_usage_day(folder, "2026-11-23")), right);
}

} // namespace
} // namespace kept_state_test
