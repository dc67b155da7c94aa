// The bytes of a frame's state: there and back, and what is refused.
#include "config/json/error.h"
#include "runtime/machines/bus.h"
#include "runtime/machines/instant_bytes.h"
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace starbow::instant_bytes_test {
namespace {

/// An instant in which every part differs from its default.
SharedInstant full()
{
    SharedInstant shared{
        .scene = "gamow", .coming = "train", .layout = "dome2", .layout_digest = 0xfedcba9876543210u,
        .turned = {{2, 30.1}, {7, -0.5}}, .language = "de", .quality = "fine", .level = 3, .instant = {}};
    Instant& now = shared.instant;
    now.shot = {"gamow", 1.25, {1, 2, 3}, {0.1, -7, 1e5}, {0.5, 0.5, -0.5, 0.5},
        {false, false, false, Comparison::galilean, true}, -2.5};
    now.head = {{0.1, 0.2, -0.3}, {0.6, 0, 0.8, 0}};
    RangeCurve& curve = now.range.emplace();
    for (std::size_t i = 0; i < curve.shown.size(); ++i)
        curve.shown[i] = 0.01 * double(i) - 8;
    curve.low = -7, curve.high = 12;
    now.meters = true, now.bloom = 0.2, now.black = 0.75;
    now.vignette = {10, 20, 30, 0.5}, now.vignette_part = 0.4;
    now.pattern = Pattern::wedges;
    Written& hud = now.hud.emplace();
    hud.number = 12345678901;
    Readings& shown = hud.readings;
    shown = {0.25, 4, 7.8, 10, 40, 1e9, 299792458, 59.9, {true, false, true, Comparison::no_light_delay, false},
        FlightMode::newtonian, true, 1.5, true};
    shown.range = {20, 8}, shown.lever = 0.3, shown.prompt = "Schieben Sie den Hebel vor";
    shown.caption = Caption{"Wohin zuerst?", {"Sonne", "Mond"}, 1, 0, "noch 5 s", true, true};
    shown.notice = "kein Kopf", shown.information = Information::visitor;
    now.sign = {{"hinter Ihnen", "3 s alt"}, {0, 0.6, 0.8}};
    now.small_picture = {Beside::telescope, -1, 1.5, "Fernrohr 1,5°"};
    Instruments& on = now.instruments.emplace();
    on.overlay = Overlay::ring;
    on.marks[0] = Spot{{4, 5, 6}, 2, false, 17};
    on.scale = {2, 300, 5};
    on.panel_number = 1234567890123, on.scale_place = {0.1f, 0.2f, 0.3f, 0.4f};
    return shared;
}

TEST(InstantBytesTest, EveryPartComesBack)
{
    const SharedInstant sent = full();
    const std::vector<std::uint8_t> bytes = bytes_of(sent);
    EXPECT_LE(bytes.size(), most_state_bytes);
    const SharedInstant come = instant_of(bytes);
    EXPECT_EQ(bytes_of(come), bytes);
    EXPECT_EQ(come.scene, "gamow");
    EXPECT_EQ(come.coming, "train");
    EXPECT_EQ(come.layout, "dome2");
    EXPECT_EQ(come.layout_digest, sent.layout_digest);
    EXPECT_EQ(come.turned, sent.turned);
    EXPECT_EQ(come.language, "de");
    EXPECT_EQ(come.level, 3);
    const Instant &a = sent.instant, &b = come.instant;
    EXPECT_EQ(a.shot.position, b.shot.position);
    EXPECT_EQ(a.shot.u, b.shot.u);
    EXPECT_EQ(a.shot.ship_from_cockpit, b.shot.ship_from_cockpit);
    EXPECT_EQ(a.shot.effects.comparison, b.shot.effects.comparison);
    EXPECT_EQ(a.head.turned, b.head.turned);
    EXPECT_EQ(a.range, b.range);
    EXPECT_EQ(a.pattern, b.pattern);
    EXPECT_EQ(a.hud->readings.caption->choices, b.hud->readings.caption->choices);
    EXPECT_EQ(a.hud->readings.lever, b.hud->readings.lever);
    EXPECT_EQ(a.hud->readings.mode, b.hud->readings.mode);
    EXPECT_EQ(a.sign->lines, b.sign->lines);
    EXPECT_EQ(a.small_picture->name, b.small_picture->name);
    EXPECT_EQ(a.instruments->marks[0]->clock, b.instruments->marks[0]->clock);
    EXPECT_FALSE(b.instruments->marks[1]);
    EXPECT_EQ(a.instruments->panel_number, b.instruments->panel_number);
    EXPECT_EQ(a.instruments->scale_place, b.instruments->scale_place);
    // The plain one, too.
    const SharedInstant plain = instant_of(bytes_of(SharedInstant{}));
    EXPECT_FALSE(plain.instant.range || plain.instant.hud || plain.instant.sign || plain.instant.small_picture
        || plain.instant.instruments);
    EXPECT_NE(digest_of_instant(bytes), digest_of_instant(bytes_of(SharedInstant{})));
}

/// A part that the list of fields has forgotten would let two instants have the same bytes.
TEST(InstantBytesTest, EveryBitOfAShotCounts)
{
    const std::vector<std::uint8_t> before = bytes_of(full());
    SharedInstant other = full();
    double* const numbers[] = {&other.instant.shot.time, &other.instant.shot.position.y, &other.instant.shot.u.z,
        &other.instant.shot.ship_from_cockpit.w, &other.instant.shot.exposure_ev, &other.instant.head.moved_m.x,
        &other.instant.bloom, &other.instant.black, &other.instant.vignette_part, &other.instant.vignette.clear_deg,
        &other.instant.range->shown[100]};
    for (double* number : numbers) {
        const double kept = *number;
        *number = std::nextafter(kept, 1e300);
        EXPECT_NE(bytes_of(other), before);
        *number = kept;
    }
    EXPECT_EQ(bytes_of(other), before);
}

std::string complaint(const std::vector<std::uint8_t>& bytes)
{
    try {
        instant_of(bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(InstantBytesTest, WhatIsNoInstantIsRefused)
{
    const std::vector<std::uint8_t> bytes = bytes_of(full());
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_NE(complaint({bytes.begin(), bytes.begin() + std::ptrdiff_t(length)}), "") << length;
    std::vector<std::uint8_t> longer = bytes, other = bytes;
    longer.push_back(0);
    EXPECT_EQ(complaint(longer), "a state of the exhibit's machines has 1 bytes too many");
    other[0] = 99;
    EXPECT_EQ(complaint(other),
        "a state of the exhibit's machines has version 99; the same program, with version 2, on all machines is right");
    SharedInstant none = full();
    none.instant.shot.position.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(complaint(bytes_of(none)), "a state of the exhibit's machines has a number that is none");
    none = full();
    none.instant.hud->readings.prompt = std::string(3500, 'x');
    EXPECT_THROW(bytes_of(none), InputError);
}

TEST(InstantBytesTest, DamagedOnesAreReadOrRefused)
{
    const std::vector<std::uint8_t> whole = bytes_of(full());
    std::mt19937 random(5);
    int read = 0, refused = 0;
    for (int i = 0; i < 20000; ++i) {
        std::vector<std::uint8_t> bytes = whole;
        for (int k = int(random() % 4) + 1; k > 0; --k)
            bytes[random() % bytes.size()] = std::uint8_t(random());
        if (random() % 4 == 0)
            bytes.resize(random() % (bytes.size() + 50));
        ++(complaint(bytes).empty() ? read : refused);
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

} // namespace
} // namespace starbow::instant_bytes_test
