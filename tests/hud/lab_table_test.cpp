// The reader of the laboratory's logs: what the log writes comes back, and anything else is refused in one sentence.
#include "runtime/hud/lab_class.h"
#include "runtime/hud/lab_table.h"
#include "tests/support/lab_flight.h"
#include <gtest/gtest.h>

namespace lab_table_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// A flight past the clocks with both marks: a log with every column filled, and one with empty cells.
const std::string& sample()
{
    static const std::string bytes = [] {
        LabFlight lab("clocks", "clocks-passing");
        lab.log();
        lab.mark(0, lab.clock_near({-10, 0, 0}));
        lab.mark(1, lab.clock_near({10, 0, 0}));
        for (int i = 0; i < 4; ++i)
            lab.wait(0.5), lab.log();
        return lab.bytes;
    }();
    return bytes;
}

/// The sample with a cell of its line (from 1) replaced.
std::string with_cell(long line, const std::string& column, const std::string& cell)
{
    std::string bytes = sample();
    std::size_t from = 0;
    for (long i = 1; i < line; ++i)
        from = bytes.find('\n', from) + 1;
    const std::string header = log_header();
    std::size_t begin = 0, at = 0;
    for (; header.compare(begin, column.size() + 1, column + ",") != 0; ++at) {
        begin = header.find(',', begin);
        if (begin++ == header.npos) {
            ADD_FAILURE() << column;
            return "";
        }
    }
    for (; at > 0; --at)
        from = bytes.find(',', from) + 1;
    bytes.replace(from, bytes.find_first_of(",\r", from) - from, cell);
    return bytes;
}

std::string refusal(const std::string& bytes)
{
    return complaint([&] { read_lab_lines(bytes, "group1.csv"); });
}

} // namespace

TEST(LabTable, WhatTheLogWritesComesBack)
{
    const std::vector<LabLine> lines = read_lab_lines(sample(), "group1.csv");
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_EQ(lines[0].line, 2);
    EXPECT_EQ(lines[4].line, 6);
    EXPECT_NEAR(lines[0]["beta"], 0.5, 1e-12);
    EXPECT_TRUE(std::isnan(lines[0]["mark_1_doppler"]));
    EXPECT_EQ(lines[1]["mark_2_number"], 2);
    EXPECT_EQ(lines[1]["aberration_on"], 1);
    EXPECT_NEAR(lines[4]["ship_time_s"], 2, 1e-9);
    EXPECT_NEAR(lines[4]["marks_rest_length_light_s"], 20, 1e-5); // the dials' places are floats
    EXPECT_NEAR(lines[4]["marks_contracted_length_light_s"], 20 * std::sqrt(0.75), 1e-5);
    EXPECT_NEAR(lines[4]["marks_from_motion_at_rest_deg"], 0, 1e-4);
    EXPECT_NEAR(lines[4]["marks_relative_gamma_beta"], 0.5 / std::sqrt(0.75), 1e-9);
    // Also with the line ends of other systems, and without the last one.
    std::string unix_ends;
    for (char c : sample())
        if (c != '\r')
            unix_ends += c;
    unix_ends.pop_back();
    EXPECT_EQ(read_lab_lines(unix_ends, "x").size(), 5u);
}

// Past a moving thing, the motion that counts is the one beside it.
TEST(LabTable, TheMotionBesideAMovingThing)
{
    LabFlight lab("train");
    const int train = lab.moving_frame();
    lab.mark(0, lab.clock_near({7, 1.38, 0.98}, train));
    lab.mark(1, lab.clock_near({-7, 1.38, 0.98}, train));
    lab.wait(12, 1);
    for (const LabLine& line : lab.lines()) {
        EXPECT_TRUE(std::isnan(line["mark_1_from_motion_deg"])); // the ship rests
        EXPECT_NEAR(line["mark_1_relative_gamma_beta"], 0.8 / 0.6, 1e-9);
        // The ship flies past the train to its rear; of light from there D is 1 / (gamma (1 - beta cos)).
        const double cosine = std::cos(line["mark_1_from_relative_motion_deg"] * 3.14159265358979323846 / 180);
        EXPECT_NEAR(line["mark_1_doppler"], 0.6 / (1 - 0.8 * cosine), 1e-9);
        EXPECT_NEAR(line["marks_contracted_length_light_s"], 14 * 0.6, 1e-5);
    }
}

TEST(LabTable, DamagedLinesAreRefusedWithPlaceAndValue)
{
    EXPECT_EQ(refusal(""), "group1.csv is empty; a log that starbow run --log has written is right");
    EXPECT_EQ(refusal("date,weather\r\n1,2\r\n"),
        "group1.csv:1: column 1: \"date\" is not what a log has there; \"utc\" is right, as starbow run --log writes it");
    EXPECT_NE(
        refusal("utc;ship_time_s;world_time_s\r\n").find("\"utc;ship_time_s;world_time_s\" is not"), std::string::npos);
    EXPECT_NE(refusal(log_header() + ",extra\r\n").find("\"extra\" is one column too many"), std::string::npos);
    EXPECT_NE(refusal("\xef\xbb\xbf" + sample()).find("group1.csv:1: column 1: "), std::string::npos);
    EXPECT_EQ(refusal(with_cell(3, "aim_doppler", "0,866")).find("group1.csv:3: "), 0u);
    EXPECT_EQ(refusal(with_cell(3, "aim_doppler", "abc")),
        "group1.csv:3: aim_doppler: \"abc\" is not a number; a number such as 0.866, or nothing, is right");
    EXPECT_EQ(refusal(with_cell(4, "gamma", "0.5")),
        "group1.csv:4: gamma: \"0.5\" is out of range; a number of at least 1 is right");
    EXPECT_EQ(
        refusal(with_cell(2, "beta", "1.5")), "group1.csv:2: beta: \"1.5\" is out of range; a number from 0 to 1 is right");
    EXPECT_EQ(refusal(with_cell(6, "mark_1_doppler", "0")),
        "group1.csv:6: mark_1_doppler: \"0\" is out of range; a number above 0 is right");
    for (const char* wrong : {"nan", "inf", "1e999", " 1", "1 ", "0x10", "--1", "1,"})
        EXPECT_EQ(refusal(with_cell(5, "world_time_s", wrong)).find("group1.csv:5: "), 0u) << wrong;
    EXPECT_EQ(refusal(with_cell(5, "world_time_s", "")),
        "group1.csv:5: world_time_s: \"\" is not a number; a number such as 0.866 is right");
    EXPECT_EQ(
        refusal(with_cell(2, "doppler_on", "yes")), "group1.csv:2: doppler_on: \"yes\" is not a switch; 0 or 1 is right");
    EXPECT_NE(refusal(with_cell(2, "overlay", "on")).find("\"on\" is not an overlay; off, aim, grid"), std::string::npos);
    EXPECT_NE(refusal(with_cell(2, "utc", "yesterday")).find("\"yesterday\" is not a time"), std::string::npos);
    // A line that a power cut has cut.
    const std::string cut = sample().substr(0, sample().size() - 40);
    EXPECT_NE(refusal(cut).find("group1.csv:6: "), std::string::npos);
    EXPECT_NE(refusal(cut).find(" cells; a line as starbow run --log writes it, with "), std::string::npos);
    EXPECT_NE(refusal(sample() + "\r\n").find("group1.csv:7: \"\" has 1 cells"), std::string::npos);
    // No byte of a damaged file steers a terminal.
    EXPECT_NE(refusal(with_cell(2, "gamma", "\x1b[31m")).find("\"?[31m\""), std::string::npos);
}

// Bytes as bad disks, editors and spreadsheets leave them: a log is read, or refused in one line, by every reader of logs.
TEST(LabTable, FuzzedLogsAreReadOrRefused)
{
    std::mt19937 random(20261125);
    int read = 0;
    const std::string header = log_header() + "\r\n", body = sample().substr(header.size());
    for (int i = 0; i < fuzz_count(); ++i) {
        // The first line rarely: a fault there ends the reading at once.
        const std::string bytes = i % 8 == 0 ? mutated(sample(), random) : header + mutated(body, random);
        LabClass all;
        try {
            add_group(all, "group", bytes, "group.csv");
            class_page(all, words());
            ++read;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos) << error.what();
            EXPECT_TRUE(std::string(error.what()).starts_with("group.csv")) << error.what();
            EXPECT_TRUE(all.groups.empty() && all.csv.empty());
        }
    }
    EXPECT_GT(read, fuzz_count() / 20);
    EXPECT_LT(read, fuzz_count());
}

} // namespace lab_table_test
