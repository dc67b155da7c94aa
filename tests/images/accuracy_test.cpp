// The choice of settings to measure and of preset levels, on made-up numbers.
#include "runtime/images/accuracy.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace accuracy_test {

using namespace starbow;

namespace {

MeasuredSetting made_up(const std::string& name, double ms, double flip, Quality quality = {})
{
    MeasuredSetting one{{name, quality}};
    one.ms = ms;
    one.errors.flip = flip;
    one.errors.psnr_dB = 30;
    return one;
}

const std::vector<MeasuredSetting> some
    = {made_up("a", 10, 0.2, {.texels_per_pixel = 0.5}), made_up("b", 20, 0.1), made_up("worse than b", 21, 0.11),
        made_up("c", 40, 0.05, {.pixel_rays = 2}), made_up("other light", 15, 0.01, {.spectra = SpectralLevel::fine})};

} // namespace

TEST(AccuracyTest, TheFrontierHasTheSettingsThatNothingBeats)
{
    EXPECT_EQ(frontier(some), (std::vector<bool>{true, false, false, false, true}));
    const std::vector<MeasuredSetting> same_light(some.begin(), some.end() - 1);
    EXPECT_EQ(frontier(same_light), (std::vector<bool>{true, true, false, true}));
    EXPECT_EQ(frontier({made_up("x", 1, 1), made_up("y", 1, 1)}), (std::vector<bool>{true, true}));
}

TEST(AccuracyTest, ABetterSettingIsBetterByMoreThanNoise)
{
    const std::vector<MeasuredSetting> all = {made_up("a", 10, 0.1), made_up("b", 9.5, 0.095), made_up("c", 8, 0.08)};
    EXPECT_EQ(better_than(all[0], {all[0], all[1]}, 0.1), nullptr);
    const MeasuredSetting* better = better_than(all[0], all, 0.1);
    ASSERT_NE(better, nullptr);
    EXPECT_EQ(better->setting.name, "c");
}

TEST(AccuracyTest, TheBestSettingWithinATimeIsFound)
{
    EXPECT_EQ(best_within(some, 5), nullptr);
    EXPECT_EQ(best_within(some, 12)->setting.name, "a");
    EXPECT_EQ(best_within(some, 100)->setting.name, "other light");
}

TEST(AccuracyTest, ALadderHasOnlySettingsThatAFlightCanChange)
{
    const std::vector<MeasuredSetting> same_light(some.begin(), some.end() - 1);
    const std::vector<PresetLevel> ladder = ladder_of(same_light);
    ASSERT_EQ(ladder.size(), 3u);
    for (std::size_t i = 1; i < ladder.size(); ++i) {
        EXPECT_GT(ladder[i].ms, ladder[i - 1].ms);
        EXPECT_LT(ladder[i].flip, ladder[i - 1].flip);
    }
    EXPECT_EQ(ladder_of({made_up("x", 9, 0.2), made_up("y", 10, 0.1, {.cube_samples = 4}),
                            made_up("z", 5, 0.3, {.frames_per_cube = 2})})
                  .size(),
        1u);
    for (const PresetLevel& level : ladder_of(some))
        EXPECT_EQ(level.quality.spectra, std::nullopt);
}

TEST(AccuracyTest, EverySettingIsTriedOnce)
{
    const std::vector<Setting> shipped = {{"standard", {}, true}};
    const std::vector<Setting> all = settings_to_try(shipped, {}, true, SpectralLevel::colours);
    std::set<std::string> names;
    for (const Setting& one : all)
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
    const auto tried = [&](auto&& knob) {
        return std::count_if(all.begin(), all.end(), [&](const Setting& one) { return knob(one.quality); });
    };
    EXPECT_GE(tried([](const Quality& q) { return q.texels_per_pixel != 1; }), 5);
    EXPECT_GE(tried([](const Quality& q) { return q.clip_levels == 0; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return !q.mips; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return q.pixel_rays > 1; }), 2);
    EXPECT_GE(tried([](const Quality& q) { return q.spectra == SpectralLevel::fine; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return q.stereo == StereoMethod::shared; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return !q.matrices; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return !q.half_floats; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return q.frames_per_cube > 1; }), 2);
    EXPECT_GE(tried([](const Quality& q) { return q.lod_error_texels == 0; }), 1);
    EXPECT_GE(tried([](const Quality& q) { return q.cube_samples == 4; }), 1);
}

TEST(AccuracyTest, PageAndTableHoldEverySetting)
{
    std::vector<MeasuredSetting> all = some;
    all[1].setting.name = "a <b> & \"c\"";
    all[1].setting.shipped = true;
    const std::string page = accuracy_page(all, {"avenue, desk", "a GPU", 9, 64}), csv = accuracy_csv(all);
    EXPECT_NE(page.find("a &lt;b&gt; &amp; &quot;c&quot;"), page.npos);
    EXPECT_EQ(page.find("<b>"), page.npos);
    EXPECT_NE(csv.find("\n\"a <b> & \"\"c\"\"\","), csv.npos) << csv;
    std::vector<MeasuredSetting> formula = some;
    formula[1].setting.name = "=1+1";
    EXPECT_NE(accuracy_csv(formula).find("\n'=1+1,"), csv.npos);
    EXPECT_EQ(page.find("http:"), page.find("http://www.w3.org/2000/svg")); // a name, not an address
    EXPECT_EQ(page.find("<script"), page.npos);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), std::ptrdiff_t(all.size() + 1));
    const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    EXPECT_EQ(columns(csv.substr(0, csv.find('\n'))), columns(csv.substr(csv.rfind("other light"))));
}

} // namespace accuracy_test
