// The bytes of a frame's state: there and back, and what is refused.
#include "config/json/error.h"
#include "config/model/shipped.h"
#include "runtime/hud/signs.h"
#include "runtime/machines/bus.h"
#include "runtime/machines/shared_state.h"
#include "runtime/machines/sound.h"
#include "tests/support/files.h"
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <regex>

namespace starbow::shared_state_test {
namespace {

/// A state in which every part differs from its default.
SharedState full()
{
    SharedState shared{.scene = "gamow",
        .coming = "train",
        .layout = "dome2",
        .layout_digest = 0xfedcba9876543210u,
        .turned = {{2, 30.1}, {7, -0.5}},
        .language = "de",
        .quality = "fine",
        .level = 3,
        .picture = {}};
    PictureState& now = shared.picture;
    now.shot = {"gamow", 1.25, {1, 2, 3}, {0.1, -7, 1e5}, {0.5, 0.5, -0.5, 0.5},
        {{Effect::false_colours}, Comparison::galilean}, -2.5};
    now.head = {{0.1, 0.2, -0.3}, {0.6, 0, 0.8, 0}};
    RangeCurve& curve = now.range.emplace();
    for (std::size_t i = 0; i < curve.shown.size(); ++i)
        curve.shown[i] = 0.01 * double(i) - 8;
    curve.low = -7, curve.high = 12;
    now.meters = true, now.bloom = 0.2, now.fade = 0.75;
    now.vignette = {10, 20, 30, 0.5}, now.vignette_part = 0.4;
    now.pattern = Pattern::wedges;
    HudText& hud = now.hud.emplace();
    hud.number = 12345678901;
    Readings& shown = hud.readings;
    shown = {0.25, 4, 7.8, 0.3, 10, 40, 1e9, 299792458, 59.9,
        {{Effect::aberration, Effect::headlight}, Comparison::no_light_delay}, FlightMode::newtonian, true, 1.5, true};
    shown.range = {20, 8}, shown.filtered = true, shown.lever = 0.3, shown.prompt = "Schieben Sie den Hebel vor";
    shown.caption = Caption{"Wohin zuerst?", {"Sonne", "Mond"}, 1, 0, "noch 5 s", true, true, "scene/avenue"};
    shown.notice = "kein Kopf", shown.information = Information::visitor;
    now.title = "Was sehen Sie nahe der Lichtgeschwindigkeit?";
    now.highlights = {{"Uhr zu Hause", {0, 0.6, -0.8}, 0.1, 8}, {"Erde", {0, 0, -1}, 0, 0}};
    now.figures = true, now.sky_labels = {{"Großer Bär", {0, 0.6, -0.8}}};
    now.sign = {{"hinter Ihnen", "3 s alt"}, {0, 0.6, 0.8}};
    now.pointer = {{0.6, 0, -0.8}, 0.25};
    now.inset = {InsetView::telescope, -1, 1.5, "Fernrohr 1,5°"};
    Instruments& on = now.instruments.emplace();
    on.overlay = Overlay::ring;
    on.marks[0] = Spot{{4, 5, 6}, 2, false, 17};
    on.scale = {2, 300, 5};
    on.panel_number = 1234567890123, on.scale_place = {0.1f, 0.2f, 0.3f, 0.4f};
    return shared;
}

TEST(InstantBytesTest, AStateHasRoomForABuildersNumbers)
{
    const Layout kept = load_layout(starbow::testing::write_text("many.json", R"({ "outputs": [{ "name": "a",
        "viewports": [{ "projection": { "type": "planar" }, "grid": { "columns": 9, "rows": 9 } }] }] })"));
    Layout now = kept;
    std::vector<double>& right = now.outputs[0].viewports[0].grid->right;
    std::fill(right.begin(), right.begin() + most_turned, 0.01);
    SharedState shared = full();
    shared.turned = turned_for_machines(kept, now);
    EXPECT_EQ(shared.turned.size(), most_turned);
    EXPECT_LE(bytes_of(shared).size(), most_state_bytes * 3 / 4) << "a long caption needs the rest";
    right[most_turned] = 0.01;
    EXPECT_THROW(turned_for_machines(kept, now), InputError);
}

TEST(InstantBytesTest, EveryPartComesBack)
{
    const SharedState sent = full();
    const std::vector<std::uint8_t> bytes = bytes_of(sent);
    EXPECT_LE(bytes.size(), most_state_bytes);
    const SharedState come = shared_state_of(bytes);
    EXPECT_EQ(bytes_of(come), bytes);
    EXPECT_EQ(come.scene, "gamow");
    EXPECT_EQ(come.coming, "train");
    EXPECT_EQ(come.layout, "dome2");
    EXPECT_EQ(come.layout_digest, sent.layout_digest);
    EXPECT_EQ(come.turned, sent.turned);
    EXPECT_EQ(come.language, "de");
    EXPECT_EQ(come.level, 3);
    const PictureState &a = sent.picture, &b = come.picture;
    EXPECT_EQ(a.shot.position, b.shot.position);
    EXPECT_EQ(a.shot.u, b.shot.u);
    EXPECT_EQ(a.shot.ship_from_cockpit, b.shot.ship_from_cockpit);
    EXPECT_EQ(a.shot.effects.comparison, b.shot.effects.comparison);
    EXPECT_EQ(a.head.turned, b.head.turned);
    EXPECT_EQ(a.range, b.range);
    EXPECT_EQ(a.pattern, b.pattern);
    EXPECT_EQ(a.hud->readings.caption->choices, b.hud->readings.caption->choices);
    EXPECT_EQ(a.hud->readings.caption->picture, b.hud->readings.caption->picture);
    EXPECT_EQ(a.hud->readings.lever, b.hud->readings.lever);
    EXPECT_EQ(a.hud->readings.mode, b.hud->readings.mode);
    EXPECT_EQ(a.title, b.title);
    ASSERT_EQ(a.highlights.size(), b.highlights.size());
    EXPECT_EQ(a.highlights[0].name, b.highlights[0].name);
    EXPECT_EQ(a.highlights[0].towards, b.highlights[0].towards);
    EXPECT_EQ(a.highlights[0].enlarged_deg, b.highlights[0].enlarged_deg);
    EXPECT_TRUE(b.figures);
    ASSERT_EQ(b.sky_labels.size(), 1u);
    EXPECT_EQ(a.sky_labels[0].name, b.sky_labels[0].name);
    EXPECT_EQ(a.sky_labels[0].towards, b.sky_labels[0].towards);
    EXPECT_EQ(a.sign->lines, b.sign->lines);
    EXPECT_EQ(a.inset->name, b.inset->name);
    EXPECT_EQ(a.instruments->marks[0]->clock, b.instruments->marks[0]->clock);
    EXPECT_FALSE(b.instruments->marks[1]);
    EXPECT_EQ(a.instruments->panel_number, b.instruments->panel_number);
    EXPECT_EQ(a.instruments->scale_place, b.instruments->scale_place);
    // The plain one, too.
    SharedState least{.scene = "avenue"};
    const SharedState plain = shared_state_of(bytes_of(least));
    EXPECT_FALSE(
        plain.picture.range || plain.picture.hud || plain.picture.sign || plain.picture.inset || plain.picture.instruments);
    EXPECT_NE(digest_of_state(bytes), digest_of_state(bytes_of(SharedState{})));
}

/// A part that the list of fields has forgotten would let two instants have the same bytes.
TEST(InstantBytesTest, EveryBitOfAShotCounts)
{
    const std::vector<std::uint8_t> before = bytes_of(full());
    SharedState other = full();
    double* const numbers[] = {&other.picture.shot.time, &other.picture.shot.position.y, &other.picture.shot.u.z,
        &other.picture.shot.ship_from_cockpit.w, &other.picture.shot.exposure_ev, &other.picture.head.moved_m.x,
        &other.picture.bloom, &other.picture.fade, &other.picture.vignette_part, &other.picture.vignette.clear_deg,
        &other.picture.range->shown[100]};
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
        shared_state_of(bytes);
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
    std::fill_n(other.begin(), 4, std::uint8_t(0));
    EXPECT_TRUE(std::regex_match(complaint(other),
        std::regex("a state of the exhibit's machines has version 0; the same program, with version [0-9]+, on all machines "
                   "is right")));
    SharedState none = full();
    none.picture.shot.position.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(complaint(bytes_of(none)), "a state of the exhibit's machines has a number that is none");
    none = full();
    none.picture.hud->readings.prompt = std::string(3500, 'x');
    EXPECT_THROW(bytes_of(none), InputError);
}

/// Each change leaves bytes that are whole, and a state that no exhibit shows: numbers out of their range, and numbers
/// that do not suit others. A menu without choices once divided by their number.
TEST(InstantBytesTest, PartsThatDoNotSuitEachOtherAreRefused)
{
    const double inf = std::numeric_limits<double>::infinity();
    using Change = std::function<void(SharedState&, PictureState&)>;
    const std::vector<std::pair<const char*, Change>> changes{
        {"chosen choice", [](auto&, PictureState& now) { now.hud->readings.caption->chosen = 2; }},
        {"chosen choice", [](auto&, PictureState& now) { now.hud->readings.caption->chosen = -2; }},
        {"right choice", [](auto&, PictureState& now) { now.hud->readings.caption->right = 1000000; }},
        {"right choice",
            [](auto&, PictureState& now) {
                now.hud->readings.caption->choices.clear(), now.hud->readings.caption->chosen = -1;
            }},
        {"menu without",
            [](auto&, PictureState& now) { now.hud->readings.caption = Caption{.text = "Menu", .menu = true}; }},
        {"number that is none", [&](auto&, PictureState& now) { now.shot.u.y = inf; }},
        {"velocity", [](auto&, PictureState& now) { now.shot.u.y = 1e300; }},
        {"place", [](auto&, PictureState& now) { now.shot.position.z = -1e200; }},
        {"turn of the ship",
            [](auto&, PictureState& now) {
                now.shot.ship_from_cockpit = {0, 0, 0, 0};
            }},
        {"turn of the head",
            [](auto&, PictureState& now) {
                now.head.turned = {2, 0, 0, 0};
            }},
        {"head's way", [](auto&, PictureState& now) { now.head.moved_m.x = 1e9; }},
        {"exposure", [](auto&, PictureState& now) { now.shot.exposure_ev = 1e9; }},
        {"high end", [](auto&, PictureState& now) { now.range->high = now.range->low - 1; }},
        {"curve that falls", [](auto&, PictureState& now) { std::swap(now.range->shown[3], now.range->shown[4]); }},
        {"bloom", [](auto&, PictureState& now) { now.bloom = 2; }},
        {"black", [](auto&, PictureState& now) { now.fade = -0.1; }},
        {"soft part", [](auto&, PictureState& now) { now.vignette.soft_deg = 0; }},
        {"gamma", [](auto&, PictureState& now) { now.hud->readings.gamma = 0; }},
        {"1 - v/c", [](auto&, PictureState& now) { now.hud->readings.beta_deficit = -1; }},
        {"speed of light", [](auto&, PictureState& now) { now.hud->readings.light_speed_m_s = 0; }},
        {"lever", [](auto&, PictureState& now) { now.hud->readings.lever = 1.5; }},
        {"direction",
            [](auto&, PictureState& now) {
                now.sign->towards = {0, 0, 0};
            }},
        {"too long a title", [](auto&, PictureState& now) { now.title = std::string(300, 'W'); }},
        {"two highlights", [](auto&, PictureState& now) { now.highlights.resize(3); }},
        {"highlight in a direction",
            [](auto&, PictureState& now) {
                now.highlights[0].towards = {0, 0, 2};
            }},
        {"highlight's radius", [](auto&, PictureState& now) { now.highlights[0].radius = 3; }},
        {"highlight's field", [](auto&, PictureState& now) { now.highlights[0].enlarged_deg = -1; }},
        {"highlight with too long a name", [](auto&, PictureState& now) { now.highlights[1].name = std::string(300, 'W'); }},
        {"too many names of the sky", [](auto&, PictureState& now) { now.sky_labels.resize(29); }},
        {"too long a name of the sky", [](auto&, PictureState& now) { now.sky_labels[0].name = std::string(300, 'W'); }},
        {"name in a direction",
            [](auto&, PictureState& now) {
                now.sky_labels[0].towards = {0, 0, 2};
            }},
        {"too long a line", [](auto&, PictureState& now) { now.sign->lines[0] = std::string(300, 'W'); }},
        {"too many lines", [](auto&, PictureState& now) { now.sign->lines.resize(20); }},
        {"inset of nothing", [](auto&, PictureState& now) { now.inset->kind = InsetView::none; }},
        {"field", [](auto&, PictureState& now) { now.inset->fov_deg = 0; }},
        {"too long a name", [](auto&, PictureState& now) { now.inset->name = std::string(300, 'W'); }},
        {"without a frame", [](auto&, PictureState& now) { now.instruments->marks[0]->frame = -1; }},
        {"farthest colour", [](auto&, PictureState& now) { now.instruments->scale.farthest_s = 1; }},
        {"below 0", [](auto&, PictureState& now) { now.instruments->panel_number = -7; }},
        {"level", [](SharedState& shared, auto&) { shared.level = -2; }},
        {"no scene", [](SharedState& shared, auto&) { shared.scene.clear(); }},
        {"turned number", [](SharedState& shared, auto&) { shared.turned[0].value = 1e30; }},
    };
    for (const auto& [says, change] : changes) {
        SharedState shared = full();
        change(shared, shared.picture);
        const std::string why = complaint(bytes_of(shared));
        EXPECT_NE(why.find(says), why.npos) << says << ": " << why;
    }
    EXPECT_EQ(complaint(bytes_of(full())), "");
}

/// What is read can be written on the display: no choice is out of its list, and no text out of the picture.
TEST(InstantBytesTest, WhatIsReadCanBeShown)
{
    const std::vector<std::uint8_t> whole = bytes_of(full());
    const Typesetter typesetter;
    const Words words = words_in("de");
    std::mt19937 random(25);
    const double numbers[] = {0, -0.0, 1e308, -1e308, 1e-308, 1e18, -1, 1e9};
    int shown = 0;
    for (int i = 0; i < 20 * testing::fuzz_count() && shown < testing::fuzz_count() / 4; ++i) {
        std::vector<std::uint8_t> bytes = whole;
        const std::size_t at = random() % (bytes.size() - 8);
        const std::uint32_t word = random() % 300;
        switch (random() % 4) {
        case 0:
            bytes[at] = std::uint8_t(bytes[at] ^ (1 << random() % 8));
            break;
        case 1:
            std::memcpy(&bytes[at], &numbers[random() % std::size(numbers)], 8);
            break;
        case 2:
            std::memcpy(&bytes[at], &word, 4);
            break;
        default:
            std::memset(&bytes[at], random() % 2 ? 0xff : 0, 8);
        }
        try {
            const SharedState shared = shared_state_of(bytes);
            ++shown;
            if (shared.picture.hud) {
                EXPECT_EQ(typesetter.draw(shared.picture.hud->readings, words, 320).size.x, 320);
            }
            if (!shared.picture.title.empty()) {
                EXPECT_LT(draw_title(typesetter, shared.picture.title, 320).size.x, 8192);
            }
            if (shared.picture.sign) {
                EXPECT_LT(draw_sign(typesetter, shared.picture.sign->lines, 10).size.x, 8192);
            }
        } catch (const InputError&) {
        }
    }
    EXPECT_GT(shown, 20);
}

/// The other messages: numbers that none of this program's has.
TEST(InstantBytesTest, OtherMessagesAreLookedAt)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const ReadyMessage ready{"left", 7, 1, 16.7, false, {{0, {{0.5f, 0.1f}}, {{3e30f, 0}}}}};
    EXPECT_EQ(fault_of(ready), "");
    for (const double wrong : {double(nan), double(inf), -double(inf), 1e308, -1.0}) {
        ReadyMessage other = ready;
        other.frame_ms = wrong;
        EXPECT_NE(fault_of(other), "") << wrong;
    }
    for (const float wrong : {nan, inf, -1.0f}) {
        ReadyMessage other = ready;
        other.samples[0].surfaces[0].luminance = wrong;
        EXPECT_NE(fault_of(other), "") << wrong;
        other = ready;
        other.samples[0].stars[0].solid_angle_sr = wrong;
        EXPECT_NE(fault_of(other), "") << wrong;
    }
    for (const std::string& name : {std::string(), std::string(65, 'x')}) {
        ReadyMessage other = ready;
        other.node = name;
        EXPECT_NE(fault_of(other), "");
        EXPECT_NE(fault_of(ConfigMessage{name, {}, {}}), "");
        EXPECT_NE(fault_of(GoMessage{1, {name}}), "");
    }
    EXPECT_NE(fault_of(GoMessage{std::numeric_limits<std::int64_t>::max(), {}}), "");
    EXPECT_NE(fault_of(GoMessage{-1, {}}), "");
    EXPECT_NE(fault_of(StateMessage{-1, {1}}), "");
    EXPECT_NE(fault_of(StateMessage{1, {}}), "");
    EXPECT_NE(fault_of(StateMessage{1, {1}, 0, -1}), "");
    EXPECT_NE(fault_of(ConfigMessage{"left", {{"the program", std::string(60000, 'A')}}, {}}), "");
    EXPECT_EQ(fault_of(PageMessage{1, 2, 2, {1, 2, 3}}), "");
    for (const PageMessage& wrong :
        {PageMessage{0, 2, 2, {}}, PageMessage{1, -5, -5, {}}, PageMessage{1, 2147483647, 2147483647, {}},
            PageMessage{1, 16000000, 1, {}}, PageMessage{1, 2, 2, std::vector<std::uint8_t>(1000)}})
        EXPECT_NE(fault_of(wrong), "") << wrong.width;
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
    EXPECT_GT(read, 500); // most of what is damaged has a number that no state has
    EXPECT_GT(refused, 1000);
}

} // namespace
} // namespace starbow::shared_state_test
