#include "runtime/operation/edid.h"
#include "runtime/operation/file_watch.h"
#include "runtime/operation/monitors.h"
#include "runtime/operation/skew.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <random>

namespace monitors_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// The standard's own example (VESA E-EDID 1.3, appendix: "DELL UR111").
constexpr std::uint8_t example[128] = {0x00, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x00, 0x10, 0xac, 0xab, 0x50, 0x00, 0x00,
    0x00, 0x00, 0x2a, 0x09, 0x01, 0x03, 0x0e, 0x26, 0x1d, 0x96, 0xef, 0xee, 0x91, 0xa3, 0x54, 0x4c, 0x99, 0x26, 0x0f, 0x50,
    0x54, 0xa5, 0x43, 0x00, 0xa9, 0x4f, 0xa9, 0x59, 0x71, 0x59, 0x61, 0x59, 0x45, 0x59, 0x31, 0x59, 0xc2, 0x8f, 0x01, 0x01,
    0x86, 0x3d, 0x00, 0xc0, 0x51, 0x00, 0x30, 0x40, 0x40, 0xa0, 0x13, 0x00, 0x7c, 0x22, 0x11, 0x00, 0x00, 0x1e, 0x00, 0x00,
    0x00, 0xff, 0x00, 0x35, 0x35, 0x33, 0x34, 0x37, 0x42, 0x4f, 0x4e, 0x5a, 0x48, 0x34, 0x37, 0x0a, 0x00, 0x00, 0x00, 0xfc,
    0x00, 0x44, 0x45, 0x4c, 0x4c, 0x20, 0x55, 0x52, 0x31, 0x31, 0x31, 0x0a, 0x20, 0x20, 0x00, 0x00, 0x00, 0xfd, 0x00, 0x30,
    0xa0, 0x1e, 0x79, 0x1c, 0x02, 0x00, 0x28, 0x50, 0x10, 0x0e, 0x80, 0x46, 0x00, 0x8d};

using Bytes = std::vector<std::uint8_t>;
Bytes standard() { return Bytes(std::begin(example), std::end(example)); }

/// Sets the right checksum.
Bytes summed(Bytes bytes)
{
    unsigned sum = 0;
    for (std::size_t i = 0; i < 127; ++i)
        sum += bytes[i];
    bytes[127] = std::uint8_t(256 - sum % 256);
    return bytes;
}

Monitor monitor(const char* connector, glm::ivec2 position, const char* model = "", const char* serial = "")
{
    return {.connector = connector, .model = model, .serial = serial, .position = position, .size = {1920, 1080}};
}

const std::vector<Monitor> wall
    = {monitor("DP-1", {0, 0}, "DELL U2415", "7MT01"), monitor("DP-2", {1920, 0}, "DELL U2415", "7MT02"),
        monitor("HDMI-1", {3840, 0}, "EPSON PJ"), monitor("VGA-1", {5760, 0})};

std::optional<std::size_t> chosen(const MonitorName& name, const std::vector<Monitor>& monitors = wall)
{
    const MonitorChoice choice = choose_monitor(name, monitors);
    EXPECT_EQ(choice.problem.empty(), choice.monitor.has_value());
    return choice.monitor;
}

} // namespace

TEST(Edid, TheStandardsExampleIsRead)
{
    const auto edid = parse_edid(example);
    ASSERT_TRUE(edid);
    EXPECT_EQ(edid->model, "DELL UR111");
    EXPECT_EQ(edid->serial, "55347BONZH47");
    EXPECT_EQ(edid->size_mm, glm::ivec2(380, 290)); // the standard says 38 x 29 cm
}

TEST(Edid, WithoutDescriptorsTheNumbersAreUsed)
{
    Bytes bytes = standard();
    bytes[75] = bytes[93] = 0x10; // dummies instead of serial and name
    bytes[12] = 0x78, bytes[13] = 0x56, bytes[14] = 0x34, bytes[15] = 0xf2;
    const auto edid = parse_edid(summed(bytes));
    ASSERT_TRUE(edid);
    EXPECT_EQ(edid->model, "DEL-50AB"); // the example's text: maker DEL, product 50AB
    EXPECT_EQ(edid->serial, "4063516280"); // 0xf2345678
    bytes[12] = bytes[13] = bytes[14] = bytes[15] = 0;
    EXPECT_EQ(parse_edid(summed(bytes))->serial, "");
}

TEST(Edid, AProjectorHasNoSize)
{
    Bytes bytes = standard();
    bytes[21] = bytes[22] = bytes[66] = bytes[67] = bytes[68] = 0;
    EXPECT_EQ(parse_edid(summed(bytes))->size_mm, glm::ivec2(0));
    bytes[21] = 0x4f; // 1.4: this byte is the picture's shape, 16:9, which is no size either
    EXPECT_EQ(parse_edid(summed(bytes))->size_mm, glm::ivec2(0));
}

TEST(Edid, ADamagedEdidIsRefused)
{
    EXPECT_FALSE(parse_edid({}));
    for (std::size_t length : {1, 8, 64, 127})
        EXPECT_FALSE(parse_edid(std::span(example).first(length))) << length;
    for (std::size_t at = 0; at < 128; ++at) // one wrong bit anywhere
        for (int bit = 0; bit < 8; ++bit) {
            Bytes bytes = standard();
            bytes[at] ^= std::uint8_t(1 << bit);
            EXPECT_FALSE(parse_edid(bytes)) << at;
        }
    Bytes bytes = standard();
    bytes[3] = 0;
    EXPECT_FALSE(parse_edid(summed(bytes))) << "this is not how an EDID begins";
}

TEST(Edid, NamesAreAlwaysOnePrintableLine)
{
    std::mt19937 random(1);
    for (int round = 0; round < 20000; ++round) {
        Bytes bytes = standard();
        for (std::size_t at = 8; at < 127; ++at)
            if (random() % 4 == 0)
                bytes[at] = std::uint8_t(random());
        const auto edid = parse_edid(summed(bytes));
        ASSERT_TRUE(edid);
        EXPECT_FALSE(edid->model.empty());
        for (char c : edid->model + edid->serial)
            ASSERT_TRUE(c >= 0x20 && c < 0x7f);
    }
}

TEST(Monitors, AreChosenByAnyMember)
{
    EXPECT_EQ(chosen({.connector = "DP-2"}), 1u);
    EXPECT_EQ(chosen({.model = "EPSON PJ"}), 2u);
    EXPECT_EQ(chosen({.serial = "7MT01"}), 0u);
    EXPECT_EQ(chosen({.model = "DELL U2415", .serial = "7MT02"}), 1u);
    EXPECT_EQ(chosen({.position = glm::ivec2(5760, 0)}), 3u);
}

TEST(Monitors, EveryMemberMustMatch)
{
    EXPECT_FALSE(chosen({.connector = "DP-1", .serial = "7MT02"}));
    EXPECT_FALSE(chosen({.connector = "DP-1", .position = glm::ivec2(1920, 0)}));
    EXPECT_FALSE(chosen({.connector = "dp-1"}));
    EXPECT_FALSE(chosen({.connector = "DP"}));
}

TEST(Monitors, AMissingMonitorIsReportedWithTheOthers)
{
    const std::string problem = choose_monitor({.connector = "DP-9"}, wall).problem;
    EXPECT_NE(problem.find("\"DP-9\" is plugged in nowhere"), std::string::npos) << problem;
    EXPECT_NE(problem.find("DP-2 at [1920, 0] (DELL U2415 7MT02)"), std::string::npos) << problem;
    EXPECT_NE(choose_monitor({.connector = "DP-9"}, {}).problem.find("there are: none"), std::string::npos);
}

TEST(Monitors, TwoMatchingMonitorsAreRefused)
{
    const MonitorChoice choice = choose_monitor({.model = "DELL U2415"}, wall);
    EXPECT_FALSE(choice.monitor);
    EXPECT_NE(choice.problem.find("DP-1"), std::string::npos) << choice.problem;
    EXPECT_NE(choice.problem.find("DP-2"), std::string::npos) << choice.problem;
    // Two monitors that show the same part of the desktop are one.
    EXPECT_EQ(chosen({.position = glm::ivec2(0, 0)}, {monitor("A", {0, 0}), monitor("B", {0, 0})}), 0u);
}

TEST(Monitors, WithoutANameThePrimaryIsChosen)
{
    EXPECT_EQ(chosen({}), 0u);
    auto monitors = wall;
    monitors[2].primary = true;
    EXPECT_EQ(chosen({}, monitors), 2u);
    EXPECT_FALSE(chosen({}, {}));
}

TEST(Monitors, AWindowStaysOnItsMonitor)
{
    const Monitor screen{.connector = "DP-2", .position = {1920, 100}, .size = {1280, 720}};
    EXPECT_EQ(place_on(screen, {.size = {640, 480}, .whole_monitor = true}), (WindowPlace{{1920, 100}, {1280, 720}}));
    EXPECT_EQ(place_on(screen, {.size = {640, 480}}), (WindowPlace{{1920, 100}, {640, 480}}));
    EXPECT_EQ(place_on(screen, {.size = {2560, 720}}), (WindowPlace{{1920, 100}, {1280, 360}})); // shrunk to fit
    // With a place the layout decides, even across several monitors.
    EXPECT_EQ(
        place_on(screen, {.size = {2560, 720}, .place = glm::ivec2(-10, 20)}), (WindowPlace{{1910, 120}, {2560, 720}}));
}

TEST(Monitors, TheLineForALayoutReadsBackAsTheSameMonitor)
{
    for (std::size_t i = 0; i < wall.size(); ++i)
        for (bool by_edid : {false, true}) {
            if (by_edid && wall[i].model.empty())
                continue;
            const auto file = write_text("layout.json",
                "{ \"outputs\": [{ \"name\": \"a\", \"viewports\": [{ \"projection\": { \"type\": \"planar\" } }], "
                    + layout_line(wall[i], by_edid) + " }] }");
            EXPECT_EQ(chosen(load_layout(file).outputs[0].monitor), i);
        }
    Monitor odd = monitor("a\"b\\c", {0, 0});
    EXPECT_EQ(layout_line(odd, false), R"("monitor": { "connector": "a\"b\\c" })");
}

TEST(Skew, MedianFollowsAndWorstStays)
{
    Skew skew;
    EXPECT_EQ(skew.median_s(), 0);
    for (double s : {0.003, 0.001, 0.002})
        skew.add(s);
    EXPECT_FLOAT_EQ(float(skew.median_s()), 0.002f);
    EXPECT_EQ(skew.worst_s(), 0.003);
    for (int i = 0; i < 100000; ++i) // the median forgets old values, the worst does not
        skew.add(0.001);
    EXPECT_FLOAT_EQ(float(skew.median_s()), 0.001f);
    EXPECT_EQ(skew.worst_s(), 0.003);
    EXPECT_EQ(skew.frames(), 100003u);
}

TEST(FileWatch, ReportsASettledChangeOnce)
{
    const auto file = write_text("a.json", "1");
    FileWatch watch({file});
    auto now = FileWatch::Clock::now();
    auto look = [&] { return watch.changed(now += std::chrono::milliseconds(110)); };
    EXPECT_FALSE(look());
    write_text("a.json", "22");
    EXPECT_FALSE(look()) << "the file may be half written";
    EXPECT_FALSE(look());
    EXPECT_TRUE(look());
    EXPECT_FALSE(look());
    // Editors replace a file by another one of the same size; in between it is missing.
    std::filesystem::remove(file);
    EXPECT_FALSE(look());
    const auto other = write_text("b.json", "33");
    std::filesystem::rename(other, file);
    int reported = 0;
    for (int i = 0; i < 6; ++i)
        reported += look();
    EXPECT_EQ(reported, 1);
    // A file that stays missing is reported once, and again when it is back.
    const auto aside = file.parent_path() / "aside.json";
    std::filesystem::rename(file, aside);
    reported = 0;
    for (int i = 0; i < 30; ++i)
        reported += look();
    EXPECT_EQ(reported, 1);
    std::filesystem::rename(aside, file);
    for (int i = 0; i < 6; ++i)
        reported += look();
    EXPECT_EQ(reported, 2);
    // A file that is written again and again is not reported until it settles.
    for (int i = 0; i < 6; ++i) {
        write_text("a.json", std::string(std::size_t(i), 'x'));
        EXPECT_FALSE(look());
    }
}

// A window is on the monitor that shows most of it, wherever the primary one is.
TEST(Monitors, AWindowIsOnTheMonitorThatShowsMostOfIt)
{
    const std::vector<WindowPlace> wall{{{0, 0}, {1920, 1080}}, {{1920, 0}, {1920, 1080}}, {{0, 1080}, {1280, 1024}}};
    EXPECT_EQ(largest_share({{100, 100}, {800, 600}}, wall), 0u);
    EXPECT_EQ(largest_share({{2500, 300}, {800, 600}}, wall), 1u);
    EXPECT_EQ(largest_share({{1500, 300}, {800, 600}}, wall), 0u); // 420 columns of 800
    EXPECT_EQ(largest_share({{1540, 300}, {800, 600}}, wall), 1u); // 380
    EXPECT_EQ(largest_share({{300, 900}, {800, 600}}, wall), 2u); // 180 rows of 600 above
    EXPECT_EQ(largest_share({{-790, -590}, {800, 600}}, wall), 0u); // a corner
    EXPECT_EQ(largest_share({{-800, 0}, {800, 600}}, wall), std::nullopt);
    EXPECT_EQ(largest_share({{0, 0}, {800, 600}}, {}), std::nullopt);
}

} // namespace monitors_test
