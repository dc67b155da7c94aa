// Several groups' logs in one page and one CSV file. tests/lab/golden.py, which shares no code with the program, compared
// the shipped logs' means and spreads with the page; its figures are repeated here.
#include "runtime/hud/lab_class.h"
#include "runtime/hud/lab_class_marks.h"
#include "runtime/hud/lab_log.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace lab_class_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

std::string log_of(const std::string& group) { return read_text(source_dir() / "tests/lab" / (group + ".csv")); }

LabClass shipped_class()
{
    LabClass all;
    for (const char* group : {"newton", "einstein", "noether"})
        add_group(all, group, log_of(group), std::string(group) + ".csv");
    return all;
}

long count_of(const std::string& text, const std::string& part)
{
    long count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size())
        ++count;
    return count;
}

} // namespace

TEST(LabClass, MeansAndSpreadsAreThoseOfAnIndependentComputation)
{
    const LabClass all = shipped_class();
    ASSERT_EQ(all.groups.size(), 3u);
    struct Golden {
        std::size_t group;
        Plot plot;
        bool by_eye;
        long count;
        double mean_percent, spread_percent;
    };
    const Golden golden[] = {
        {0, Plot::doppler, false, 24, -0.0000000, 0.0000000},
        {0, Plot::length, false, 8, -0.0000000, 0.0000000},
        {0, Plot::length, true, 8, 3.0598618, 2.0541060},
        {0, Plot::doppler, true, 14, 0.0001343, 0.0002605},
        {0, Plot::clock, false, 7, 0.0000000, 0.0000000},
        {1, Plot::doppler, false, 7, -0.0000000, 0.0000000},
        {1, Plot::clock, false, 6, 0.0000000, 0.0000000},
        {2, Plot::doppler, false, 27, 0.0000000, 0.0000000},
        {2, Plot::doppler, true, 6, 0.0087075, 0.0063619},
        {2, Plot::clock, false, 3, -0.0032653, 0.0024899},
    };
    for (const Golden& g : golden) {
        const Deviation found = deviation_of(all.groups[g.group].points[std::size_t(g.plot)], g.by_eye);
        EXPECT_EQ(found.count, g.count) << g.group << ' ' << int(g.plot) << g.by_eye;
        // The script's rounding.
        EXPECT_NEAR(100 * found.mean, g.mean_percent, 1e-6) << g.group << ' ' << int(g.plot) << g.by_eye;
        EXPECT_NEAR(100 * found.spread, g.spread_percent, 1e-6) << g.group << ' ' << int(g.plot) << g.by_eye;
    }
}

TEST(LabClass, TheCsvHasEveryLineWithItsGroup)
{
    const LabClass all = shipped_class();
    std::string expected = "group," + log_header() + "\r\n";
    for (const char* group : {"newton", "einstein", "noether"}) {
        std::stringstream lines(log_of(group));
        std::string line;
        for (std::getline(lines, line); std::getline(lines, line);)
            expected += std::string(group) + "," + line.substr(0, line.size() - 1) + ",,,,,\r\n"; // no readings yet
    }
    EXPECT_EQ(all.csv, expected);
    // A name with a comma stays one cell.
    LabClass odd;
    add_group(odd, "Mia, \"Max\"", log_of("newton"), "x.csv");
    EXPECT_NE(odd.csv.find("\r\n\"Mia, \"\"Max\"\"\",2"), std::string::npos);
    // A spreadsheet carries out what begins like a formula.
    for (const char* name : {"=cmd|' /C calc'!A0", "+1+1", "-2+3", "@SUM(A1)"}) {
        LabClass formula;
        add_group(formula, name, log_of("newton"), "x.csv");
        EXPECT_NE(formula.csv.find("\r\n'" + std::string(name) + ",2"), std::string::npos) << formula.csv.substr(0, 2000);
    }
    LabClass tab;
    add_group(tab, "\t=1;2", log_of("newton"), "x.csv");
    EXPECT_NE(tab.csv.find("\r\n\"'\t=1;2\",2"), std::string::npos);
    EXPECT_NE(class_page(odd, words()).find("Mia, &quot;Max&quot;"), std::string::npos);
}

TEST(LabClass, ThePageHasEveryGroupInAColourAndAMarkOfItsOwn)
{
    for (const char* language : {"en", "de"}) {
        const std::string page = class_page(shipped_class(), words(language));
        // Points by eye alone: ticks of two groups, lengths of one. The clocks on board are all computed.
        EXPECT_EQ(count_of(page, "<table class=\"seen"), 2);
        EXPECT_EQ(count_of(page, "role=\"img\""), 3);
        EXPECT_GE(count_of(page, "class=\"theory\""), 4); // D at its speeds, length, clock, and the legend
        EXPECT_EQ(page.find("nan"), page.npos);
        EXPECT_EQ(page.find("inf"), page.npos);
        constexpr Key keys[]{
            "plot.doppler", "plot.length_y", "plot.clock", "class.mean", "class.explain", "class.no_readings"};
        for (const Key key : keys)
            EXPECT_NE(page.find(words(language)(key)), page.npos) << key.name();
    }
    // As many groups as there are pairs: no two have the same colour and mark.
    LabClass many;
    for (std::size_t i = 0; i < most_groups; ++i)
        add_group(many, std::to_string(i), log_of("newton"), "x.csv");
    const std::string page = class_page(many, words());
    const std::regex legend("<span><svg[^>]*class=\"key\"[^>]*>\\s*<use href=\"#(m[0-9])\"[^>]*fill=\"(#[0-9a-f]+)\"");
    std::set<std::string> pairs;
    for (std::sregex_iterator at(page.begin(), page.end(), legend), end; at != end; ++at)
        pairs.insert((*at)[1].str() + (*at)[2].str());
    EXPECT_EQ(pairs.size(), most_groups);
}

// The three invented groups; tests/lab/readings_golden.py, which shares no code with the program, recomputes the page's
// figures (tests/commands/lab_test.sh).
TEST(LabClass, ReadingsHaveAPictureAndTwoTables)
{
    LabClass all = shipped_class();
    for (const char* group : {"hertz", "kirchhoff", "noddack"})
        add_readings(all, group, log_of(group), std::string(group) + ".csv");
    for (const char* language : {"en", "de"}) {
        const std::string page = class_page(all, words(language));
        EXPECT_EQ(count_of(page, "<table class=\"groups"), 1);
        EXPECT_EQ(count_of(page, "<table class=\"readings"), 1);
        EXPECT_EQ(count_of(page, "role=\"img\""), 4);
        constexpr Key keys[]{"class.agrees", "class.too_far", "class.too_close", "class.readings_explain", "class.z"};
        for (const Key key : keys)
            EXPECT_NE(page.find(words(language)(key)), page.npos) << key.name();
        EXPECT_NE(page.find(words(language)("class.verdict")), page.npos);
    }
    // A class of lists alone has no plots.
    LabClass lists;
    add_readings(lists, "hertz", log_of("hertz"), "hertz.csv");
    EXPECT_EQ(count_of(class_page(lists, words()), "role=\"img\""), 1);
    EXPECT_EQ(lists.csv, "");
}

TEST(LabClass, AGroupWithoutMeasurementsIsRefused)
{
    LabClass all = shipped_class();
    const std::string csv = all.csv;
    EXPECT_EQ(complaint([&] { add_group(all, "x", log_header() + "\r\n", "x.csv"); }),
        "x.csv:1: has the names of a log and no line of measurements; a log in which K has written at least one is right");
    EXPECT_NE(
        complaint([&] { add_group(all, "x", log_of("newton") + "1,2\r\n", "x.csv"); }).find(" cells"), std::string::npos);
    EXPECT_EQ(all.groups.size(), 3u);
    EXPECT_EQ(all.csv, csv);
}

} // namespace lab_class_test
