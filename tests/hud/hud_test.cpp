#include "runtime/hud/hud.h"
#include "tests/support/files.h"
#include <cmath>
#include <gtest/gtest.h>

namespace hud_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

std::string field(const Readings& readings, const std::string& label, const Words& words = starbow::testing::words())
{
    for (const auto& [name, value] : hud_fields(readings, words))
        if (name == label)
            return value;
    return "none";
}

Readings at_gamma(double gamma, const glm::dvec3& way = {0, 0, -1})
{
    Shot shot;
    shot.u = way * std::sqrt((gamma - 1) * (gamma + 1));
    return readings(ship_at(shot), SceneFile{}, {});
}

} // namespace

TEST(Hud, ShowsTheSpeedWithoutCancellation)
{
    EXPECT_EQ(field(at_gamma(1), "v/c"), "0.0000");
    EXPECT_EQ(field(at_gamma(4), "v/c"), "0.9682");
    EXPECT_EQ(field(at_gamma(4), "γ"), "4.000");
    EXPECT_EQ(field(at_gamma(4), "D ahead"), "7.873");
    EXPECT_EQ(field(at_gamma(1e6), "1 − v/c"), "5.0×10⁻¹³"); // 1/(2 gamma^2)
    EXPECT_EQ(field(at_gamma(1e6), "D ahead"), "2.0×10⁶");
    EXPECT_EQ(field(at_gamma(999999.9), "γ"), "1.0×10⁶"); // the format is chosen for the rounded number
}

TEST(Hud, StraightAheadIsAlongTheNose)
{
    EXPECT_NEAR(at_gamma(4, {1, 0, 0}).doppler_ahead, 0.25, 1e-12); // across the motion D = 1/gamma
    EXPECT_NEAR(at_gamma(4, {0, 0, 1}).doppler_ahead, 4 - std::sqrt(15.0), 1e-12);
}

TEST(Hud, UnitsSuitTheValue)
{
    Readings r = at_gamma(1);
    r.ship_s = 12.34, r.world_s = 5 * 365.25 * 86400, r.distance_m = 3 * 299792458.0;
    EXPECT_EQ(field(r, "ship"), "12.3 s");
    EXPECT_EQ(field(r, "world"), "5.000 years");
    EXPECT_EQ(field(r, "flown"), "3.00 light-s");
    r.light_speed_m_s = 5, r.distance_m = 12;
    EXPECT_EQ(field(r, "flown"), "12.0 m");
}

TEST(Hud, EveryPanelHasLettersInsideItsPlate)
{
    Typesetter typesetter;
    Readings longest = at_gamma(1e6);
    longest.ship_s = longest.world_s = 16.6 * 60, longest.distance_m = 16.5 * 60 * 299792458.0;
    for (const char* language : {"en", "de"})
        for (int width : {160, 400, 1200}) {
            SCOPED_TRACE(language + std::string(" ") + std::to_string(width));
            Panel panel = typesetter.draw(longest, starbow::testing::words(language), width);
            // There must be a gap between two columns, whatever their numbers.
            for (double gap : {0.405, 0.63})
                for (int y = 0; y < panel.size.y * 8 / 10; ++y)
                    EXPECT_LT(panel.texels[2 * (std::size_t(y) * panel.size.x + std::size_t(gap * width))], 128) << y;
            ASSERT_EQ(panel.texels.size(), std::size_t(panel.size.x) * panel.size.y * 2);
            long letters = 0, outside = 0;
            for (std::size_t i = 0; i < panel.texels.size(); i += 2) {
                letters += panel.texels[i] > 128;
                outside += panel.texels[i] > 128 && panel.texels[i + 1] < 255;
            }
            EXPECT_GT(letters, width * panel.size.y / 60);
            EXPECT_EQ(outside, 0);
        }
}

// Each letter's core, the most that its strokes cover, is no fainter than what a contrast of 4.5 to 1 needs.
TEST(Hud, NoLetterIsTooFaintToRead)
{
    Typesetter typesetter;
    for (const Information information : {Information::visitor, Information::guide, Information::laboratory})
        for (int kind = information == Information::laboratory ? 0 : 1; kind < 4;
             ++kind) { // the others have a dial's shapes
            Readings shown = at_gamma(4);
            shown.information = information;
            if (kind > 0)
                shown.caption = Caption{.text = "HIIH", .aside = "IHHI"};
            if (kind > 1)
                shown.caption->choices = {"HI", "IH", "HH"}, shown.caption->chosen = 1;
            if (kind > 2)
                shown.caption->menu = true;
            const Panel panel = typesetter.draw(shown, starbow::testing::words(), 1200);
            // A stroke is where some texel is brighter than all around it; letters at this size have full cores.
            const auto letter = [&](int x, int y) {
                return int(panel.texels[2 * (std::size_t(y) * std::size_t(panel.size.x) + std::size_t(x))]);
            };
            constexpr int reach = 6;
            int letters = 0;
            for (int y = reach; y < panel.size.y - reach; ++y)
                for (int x = panel.size.x / 30; x < panel.size.x - reach; ++x) { // beside the lever's track
                    if (letter(x, y) < 20)
                        continue;
                    int brightest = 0;
                    for (int j = -reach; j <= reach; ++j)
                        for (int i = -reach; i <= reach; ++i)
                            brightest = std::max(brightest, letter(x + i, y + j));
                    EXPECT_GE(brightest, int(faintest_letters * 255) - 1)
                        << int(information) << kind << ": " << x << ", " << y;
                    ++letters;
                }
            EXPECT_GT(letters, 500);
        }
}

TEST(Hud, ADamagedFontIsRefused)
{
    const std::string whole = read_text(hud_font);
    EXPECT_EQ(font_fault(whole), "");
    const auto refusal = [](const std::string& bytes) {
        const auto file = write_text("font.ttf", bytes);
        const std::string said = complaint([&] { Typesetter letters(file); });
        EXPECT_TRUE(said.starts_with(file.string() + ": ") && said.ends_with(" is right")) << said;
        return said;
    };
    EXPECT_NE(refusal("").find("is not a TrueType font"), std::string::npos);
    EXPECT_NE(refusal(std::string(200'000, 'x')).find("is not a TrueType font"), std::string::npos);
    EXPECT_NE(
        refusal(std::string("\0\1\0\0\xff\xff", 6) + std::string(200'000, '\xff')).find("is cut off"), std::string::npos);
    EXPECT_NE(refusal(std::string("\0\1\0\0", 4) + std::string(200, '\0')).find("lacks the table cmap"), std::string::npos);
    for (std::size_t length = 13; length < whole.size(); length = length * 3 / 2)
        EXPECT_NE(refusal(whole.substr(0, length)).find("is cut off"), std::string::npos) << length;
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
        std::string bytes = whole;
        bytes[random() % bytes.size()] ^= char(1 + random() % 255);
        if (const std::string fault = font_fault(bytes); fault.empty())
            ADD_FAILURE() << "a changed byte is not found, change " << i;
    }
}

TEST(Hud, UsesTheLanguagesWordsAndDecimalSign)
{
    const Words& german = starbow::testing::words("de");
    EXPECT_EQ(field(at_gamma(4), "D voraus", german), "7,873");
    EXPECT_EQ(field(at_gamma(1e6), "1 − v/c", german), "5,0×10⁻¹³");
    Readings r = at_gamma(1);
    r.world_s = 5 * 365.25 * 86400, r.distance_m = 3 * 299792458.0, r.exposure_ev = -1.25, r.exposure_locked = true;
    EXPECT_EQ(field(r, "Welt", german), "5,000 Jahre");
    EXPECT_EQ(field(r, "Weg", german), "3,00 Licht-s");
    EXPECT_EQ(field(r, "Belichtung", german), "−1,3 EV fest");
    r.range = Readings::Range{46.4, 7.6};
    EXPECT_EQ(field(r, "Belichtung", german), "46 Stufen in 8, −1,3 EV fest");
    EXPECT_EQ(range_sentence(*r.range, german), "Helligkeit gestaucht: 46 Stufen in 8");
    EXPECT_EQ(range_sentence({7.4, 7.4}, starbow::testing::words()), "All 7 stops of brightness shown");
    EXPECT_EQ(shown_duration(-2.5, german), "−2,5 s");
    EXPECT_EQ(shown_duration(-720, german), "−12,0 min");
    EXPECT_EQ(shown_duration(-0.001, german, 2), "0,00 s"); // no minus before zero
}

TEST(Hud, EachCombinationOfLightEffectsHasAName)
{
    EXPECT_EQ(light_name({}, starbow::testing::words()), "spectra shifted, times D³: as eyes see them");
    EXPECT_EQ(light_name(Effects{}.without(Effect::headlight), starbow::testing::words()), "spectra shifted, without D³");
    EXPECT_EQ(light_name(Effects{}.without(Effect::doppler), starbow::testing::words()), "colours unshifted, times D³");
    EXPECT_EQ(light_name(Effects{}.without(Effect::doppler).without(Effect::headlight), starbow::testing::words()),
        "colours as at rest");
    EXPECT_EQ(light_name(Effects{}.with(Effect::false_colours), starbow::testing::words()),
        "false colours: infrared red, visible green, ultraviolet blue");
    Readings all = at_gamma(4);
    all.effects = Effects{}.without(Effect::doppler).with(Effect::false_colours);
    EXPECT_EQ(field(all, "light"), "false colours: infrared red, visible green, ultraviolet blue, unshifted");
}

} // namespace hud_test
