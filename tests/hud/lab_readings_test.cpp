// Students' readings: their statistics against tables and sums by hand, the lists that spreadsheets save, and what is
// refused.
#include "runtime/hud/lab_class_readings.h"
#include "runtime/hud/lab_readings.h"
#include "tests/support/damage.h"
#include "tests/support/lab_flight.h"
#include <gtest/gtest.h>

namespace lab_readings_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

std::string list_of(const std::string& lines) { return "no,quantity,reading,uncertainty\r\n" + lines; }
std::string refusal(const std::string& bytes)
{
    return complaint([&] { read_reading_list(bytes, "g.csv"); });
}
StudentReading reading(double value, double uncertainty, double theory, long line = 2)
{
    return {{value, uncertainty, theory}, "A1", line};
}

/// The upper tail of chi-square's density by the trapezoidal rule over the root of chi-square, where it is smooth.
double tail(double chi_square, int degrees)
{
    const double low = std::sqrt(chi_square), step = 1e-4;
    double sum = 0;
    for (int i = 0; i < 300'000; ++i) {
        const double r = low + (i + 0.5) * step;
        sum += std::exp((degrees - 1) * std::log(r) - r * r / 2 - std::lgamma(degrees / 2.));
    }
    return sum * step * std::exp2(1 - degrees / 2.);
}

} // namespace

// The quantiles of Abramowitz and Stegun, table 26.8, which has six figures.
TEST(LabReadings, TheProbabilityOfChiSquareIsThatOfTables)
{
    struct Row {
        double chi_square;
        long degrees;
        double probability;
    };
    for (const Row& row : {Row{3.84146, 1, 0.05}, {6.63490, 1, 0.01}, {5.99147, 2, 0.05}, {0.0201007, 2, 0.99},
             {7.81473, 3, 0.05}, {15.9872, 10, 0.1}, {2.55821, 10, 0.99}, {50.8922, 30, 0.01}, {124.342, 100, 0.05}})
        EXPECT_NEAR(chi_square_probability(row.chi_square, row.degrees), row.probability, 2e-6) << row.chi_square;
    for (const int degrees : {1, 2, 5, 12, 39, 160})
        for (const double part : {0.3, 1., 1.7})
            EXPECT_NEAR(chi_square_probability(part * degrees, degrees), tail(part * degrees, degrees), 1e-8)
                << degrees << ' ' << part;
    EXPECT_EQ(chi_square_probability(0, 3), 1);
    EXPECT_NEAR(chi_square_probability(2000, 2000), 0.4958, 2e-4); // nearly a normal distribution's half
    EXPECT_EQ(chi_square_probability(1e9, 4), 0);
    EXPECT_EQ(chi_square_probability(INFINITY, 4), 0);
}

// By hand: deviations 0.3, -0.1, 0.4 with uncertainties 0.2, 0.1, 0.1.
TEST(LabReadings, StatisticsAreThoseOfASumByHand)
{
    const std::vector<StudentReading> readings{reading(10.3, 0.2, 10, 2), reading(9.9, 0.1, 10, 3), reading(5.4, 0.1, 5, 7)};
    const ReadingStatistics all = statistics_of(readings);
    EXPECT_EQ(all.count, 3);
    EXPECT_NEAR(all.mean, 0.2, 1e-12);
    EXPECT_NEAR(all.spread, std::sqrt((0.01 + 0.09 + 0.04) / 2), 1e-12);
    EXPECT_NEAR(all.standard_error, std::sqrt(0.07 / 3), 1e-12);
    EXPECT_NEAR(all.chi_square, 2.25 + 1 + 16, 1e-12);
    EXPECT_NEAR(all.probability, 0.000242, 2e-6);
    EXPECT_EQ(all.outliers, std::vector<long>{7});
    const ReadingStatistics one = statistics_of(std::span(readings).first(1));
    EXPECT_EQ(one.spread, 0);
    EXPECT_NEAR(one.probability, std::erfc(1.5 / std::sqrt(2.)), 1e-12);
    EXPECT_EQ(statistics_of({}).probability, 1);
}

TEST(LabReadings, ListsAreReadAsSpreadsheetsSaveThem)
{
    const std::vector<StudentReading> plain
        = read_reading_list(list_of("A1,\"○–◇ / deg\",35.6,0.2\r\nC3,,-5.9,.1\r\nC6,,,\r\n\r\nA1,,36,0.2"), "g.csv");
    ASSERT_EQ(plain.size(), 3u);
    EXPECT_EQ(plain[0].of, "A1");
    EXPECT_EQ(plain[0].value, 35.6);
    EXPECT_NEAR(plain[0].theory, 35.757, 0.001);
    EXPECT_EQ(plain[1].value, -5.9);
    EXPECT_EQ(plain[2].line, 6);
    const std::vector<StudentReading> german = read_reading_list(
        "\xef\xbb\xbfno;quantity;reading;uncertainty\nA1;\"a;b\";35,6;0,2\n;;;\nC3;; −5,9 ;0,1\n", "g.csv");
    ASSERT_EQ(german.size(), 2u);
    EXPECT_EQ(german[0].value, 35.6);
    EXPECT_EQ(german[1].value, -5.9);
    EXPECT_TRUE(is_reading_list("no\tquantity"));
    EXPECT_FALSE(is_reading_list(log_header()));
    EXPECT_FALSE(is_reading_list("nothing"));
}

TEST(LabReadings, WrongListsAreRefusedWithPlaceAndValue)
{
    EXPECT_EQ(refusal("no,value\r\n"),
        "g.csv:1: \"no,value\" are not the names of a list of readings; no,quantity,reading,uncertainty is right");
    EXPECT_EQ(refusal(list_of("A77,,1,1\r\n")),
        "g.csv:2: no: \"A77\" is not a row of the worksheet; a number such as A1 is right");
    EXPECT_EQ(refusal(list_of("A1,,35.6 deg,1\r\n")),
        "g.csv:2: reading: \"35.6 deg\" is not a number; a number such as 0.866 is right");
    EXPECT_EQ(
        refusal(list_of("A1,,35.6,\r\n")), "g.csv:2: uncertainty: \"\" is not a number; a number such as 0.866 is right");
    for (const char* none : {"0", "-1", "1e-300"})
        EXPECT_EQ(refusal(list_of(std::string("\r\nA1,,35.6,") + none)),
            std::string("g.csv:3: uncertainty: \"") + none + "\" is out of range; a number above 0 is right");
    EXPECT_EQ(refusal(list_of("A1,35,6,0,2\r\n")),
        "g.csv:2: \"A1,35,6,0,2\" has 5 cells; 4 are right: no, quantity, reading, uncertainty");
    for (const char* wrong : {"nan", "inf", "1e300", "0x10", "--1"})
        EXPECT_EQ(refusal(list_of(std::string("A1,,") + wrong + ",1\r\n")).find("g.csv:2: reading: "), 0u) << wrong;
    LabClass all;
    EXPECT_EQ(complaint([&] { add_readings(all, "g", list_of("A1,,,\r\n"), "g.csv"); }),
        "g.csv: has no reading; a list with at least one number and its uncertainty is right");
    EXPECT_TRUE(all.groups.empty());
}

TEST(LabReadings, FuzzedListsAreReadOrRefused)
{
    std::mt19937 random(20261130);
    const std::string sample = list_of("A1,\"a\"\"b\",35.6,0.2\r\nC3,,-5.9,0.1\r\nH1,,0.1,0.01\r\n");
    int read = 0;
    for (int i = 0; i < fuzz_count(); ++i) {
        const std::string bytes = mutated(sample, random);
        if (!is_reading_list(bytes))
            continue;
        LabClass all;
        try {
            add_readings(all, "group", bytes, "group.csv");
            class_page(all, words());
            ++read;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos) << error.what();
            EXPECT_TRUE(std::string(error.what()).starts_with("group.csv")) << error.what();
        }
    }
    EXPECT_GT(read, fuzz_count() / 50);
}

// The theory of an instant stands in the log's line beside the student's number, and nowhere before.
TEST(LabReadings, ALogsLineHasAReadingOrNone)
{
    LabFlight lab("clocks", "clocks-passing");
    lab.log();
    EXPECT_FALSE(reading_of(lab.lines()[0]));
    const std::string without = lab.bytes;
    lab.log(WrittenReading{{630, 4, 635.1}, LabQuantity::wavelength});
    const std::vector<LabLine> lines = lab.lines();
    const std::optional<StudentReading> reading = reading_of(lines[1]);
    ASSERT_TRUE(reading);
    EXPECT_EQ(reading->of, "wavelength_nm");
    EXPECT_EQ(reading->value, 630);
    EXPECT_EQ(reading->theory, 635.1);
    EXPECT_EQ(reading->line, 3);
    EXPECT_NEAR(lines[1]["reading_sigmas"], -1.275, 1e-12);
    LabClass all;
    add_group(all, "g", lab.bytes, "g.csv");
    ASSERT_EQ(all.groups[0].readings.size(), 1u);
    EXPECT_NE(class_page(all, words()).find("550 nm → / nm"), std::string::npos);
    EXPECT_EQ(readings_csv(all.groups),
        "group,of,line,reading,uncertainty,theory,sigmas\r\ng,wavelength_nm,3,630,4,635.1,-1.275\r\n");
    // Without any reading the page says that the instruments' lines are no measurements.
    LabClass none;
    add_group(none, "g", without, "g.csv");
    EXPECT_NE(class_page(none, words()).find("are no measurements"), std::string::npos);
    EXPECT_EQ(readings_csv(none.groups), "");
    // Half a reading.
    std::string half = lab.bytes;
    half.replace(half.rfind(",630,"), 5, ",,");
    EXPECT_NE(complaint([&] { read_lab_lines(half, "g.csv"); }).find("g.csv:3: "), std::string::npos);
}

// A log of an older version ends before the columns of readings; its class has them, empty.
TEST(LabReadings, OlderLogsAreRead)
{
    const std::string old = read_text(source_dir() / "tests/lab/newton.csv");
    EXPECT_EQ(old.find("reading"), old.npos);
    LabClass all;
    add_group(all, "newton", old, "newton.csv");
    EXPECT_GT(all.groups[0].lines, 3);
    const std::string head = all.csv.substr(0, all.csv.find("\r\n"));
    for (std::size_t at = 0; at < all.csv.size();) {
        const std::size_t end = all.csv.find("\r\n", at);
        const std::string line = all.csv.substr(at, end - at);
        EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(head, ','));
        at = end + 2;
    }
}

} // namespace lab_readings_test
