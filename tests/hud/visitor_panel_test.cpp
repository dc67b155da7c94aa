// The displays for visitors and guides: right, readable, and small enough on every shipped layout.
#include "config/model/angles.h"
#include "config/model/layout.h"
#include "displays/projections/views.h"
#include "runtime/hud/hud_place.h"
#include "runtime/hud/visitor_panel.h"
#include "tests/support/effects.h"
#include "tests/support/files.h"
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace visitor_panel_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

/// degrees: of the nose from the motion, on board.
Readings at_rapidity(double rapidity, double degrees = 0)
{
    Readings r{};
    r.beta_deficit = 2 / (std::exp(2 * rapidity) + 1);
    r.gamma = std::cosh(rapidity);
    r.doppler_ahead = 1 / (std::cosh(rapidity) - std::sinh(rapidity) * std::cos(degrees * std::acos(-1.0) / 180));
    r.looked_cosine = std::cos(degrees * std::acos(-1.0) / 180);
    r.light_speed_m_s = 299792458;
    r.information = Information::visitor;
    return r;
}

/// Everything that a display can be asked to show: speeds, ways to look, switches, long times.
std::vector<Readings> all_states()
{
    std::vector<Readings> all;
    for (const double rapidity : {0.0, 0.1, 0.5, 1.0, 1.5, 2.2, 4.0, 14.5})
        for (int bits = 0; bits < 128; ++bits)
            for (const Comparison comparison : {Comparison::none, Comparison::galilean, Comparison::no_light_delay}) {
                Readings r = at_rapidity(rapidity, bits & 64 ? 90 : bits & 1 ? 0 : 180);
                r.effects = effects_of((bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0);
                r.effects.on.set(Effect::false_colours, (bits & 16) != 0);
                r.effects.comparison = comparison;
                r.frozen = (bits & 32) != 0;
                r.ship_s = rapidity < 1 ? 12.3 : 599.9, r.world_s = rapidity < 1 ? 35999 : 1.3e11;
                r.distance_m = 9.9e15;
                all.push_back(r);
            }
    all.push_back(at_rapidity(0.5));
    all.back().filtered = true;
    return all;
}

} // namespace

TEST(VisitorPanel, TheDialFillsWithTheDopplerFactorAhead)
{
    double before = -1;
    for (double rapidity = 0; rapidity < 16; rapidity += 0.25) {
        const double part = gauge_part(at_rapidity(rapidity).beta_deficit);
        EXPECT_NEAR(part, -std::expm1(-rapidity), 1e-8) << rapidity; // 1 - 1/e^rapidity
        EXPECT_GT(part, before);
        EXPECT_LT(part, 1);
        before = part;
    }
}

TEST(VisitorPanel, NoSpeedIsShownAsThatOfLight)
{
    const auto percent = [](double deficit) { return shown_percent(deficit, words()); };
    EXPECT_EQ(percent(1), "0 %");
    EXPECT_EQ(percent(0.5), "50 %");
    EXPECT_EQ(percent(1 - 0.9682), "96 %");
    EXPECT_EQ(percent(0.0099), "99.0 %");
    EXPECT_EQ(percent(0.0032), "99.6 %");
    EXPECT_EQ(percent(1e-4), "99.990 %");
    for (double deficit = 1; deficit > 1e-16; deficit *= 0.7)
        EXPECT_FALSE(percent(deficit).starts_with("100")) << deficit;
    EXPECT_EQ(percent(0), "99.999 %");
    EXPECT_EQ(shown_percent(0.0099, words("de")), "99,0 %");
}

TEST(VisitorPanel, EverySentenceIsSaidInSomeState)
{
    std::set<std::string> said;
    for (const Readings& r : all_states())
        said.insert(plain_sentence(r, words()));
    const std::set<std::string> others{
        "say.percent", "say.of_light", "say.clock_board", "say.clock_world", "say.minute", "say.minutes"};
    for (const auto& [key, text] : words().texts)
        if (key.starts_with("say.") && !others.contains(key)) {
            EXPECT_TRUE(said.contains(text)) << key;
        }
}

// The minutes against the flight's own clocks: a ship that flies on at its speed, whose two readings are compared.
TEST(VisitorPanel, MinutesAreThoseOfBothClocks)
{
    std::set<std::string> said;
    for (double rapidity = 0; rapidity < 9; rapidity += 0.01) {
        Readings r = at_rapidity(rapidity);
        r.effects = effects_of(true, true, true);
        Ship ship;
        ship.u = Sum3(glm::dvec3(0, 0, -std::sinh(rapidity)));
        const Ship later = fly(ship, {}, {}, 1);
        const double ratio
            = (later.time.total() - ship.time.total()) / (later.proper_time.total() - ship.proper_time.total());
        for (const double ship_s : {0.0, 5.0, 11.9, 12.1, 17.9, 18.1, 1e9 + 14}) {
            r.ship_s = ship_s;
            const std::string text = minutes_sentence(r, words());
            int board = 1, world = 0;
            if (text.starts_with("One minute for you is "))
                world = std::stoi(text.substr(22));
            else if (!text.empty()) {
                ASSERT_EQ(std::sscanf(text.c_str(), "%d minutes for you are %d outside.", &board, &world), 2) << text;
            }
            EXPECT_TRUE(text.empty() || (ship_s != 0 && ship_s != 5 && ship_s != 11.9 && ship_s != 18.1)) << ship_s << text;
            if (!text.empty()) {
                EXPECT_NEAR(double(world) / board, ratio, 0.05 * ratio) << text;
            }
            if (ship_s == 12.1)
                said.insert(text);
        }
        r.ship_s = 14;
        r.effects.on.set(Effect::aberration, false); // a picture that is not real has no such sentence
        EXPECT_EQ(minutes_sentence(r, words()), "");
        r.effects.on.set(Effect::aberration, true), r.frozen = true;
        EXPECT_EQ(minutes_sentence(r, words()), "");
    }
    EXPECT_EQ(said.size(), 17u); // each of the numbers, and none
    EXPECT_TRUE(said.contains("2 minutes for you are 3 outside."));
    EXPECT_TRUE(said.contains("One minute for you is 2 minutes outside."));
    Readings r = at_rapidity(std::acosh(4.0));
    r.effects = effects_of(true, true, true), r.ship_s = 13;
    EXPECT_EQ(minutes_sentence(r, words("de")), "Eine Minute für dich sind draußen 4 Minuten.");
    bool shown = false;
    for (const Lettering& line : lettering_of(Typesetter(), r, words()))
        shown |= line.text.starts_with("One minute for you");
    EXPECT_TRUE(shown);
}

// Each sentence about the way to look against the picture's own numbers: the sine and cosine of an angle on board, and D.
TEST(VisitorPanel, WhereOneLooksIsSaidByTheAngle)
{
    const auto said = [](double rapidity, double degrees, bool colours) {
        Readings r = at_rapidity(rapidity, degrees);
        r.effects.on.set(Effect::doppler, colours), r.effects.on.set(Effect::headlight, colours);
        return plain_sentence(r, words());
    };
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        const double rapidity = std::uniform_real_distribution(0.26, 9.0)(random),
                     degrees = std::uniform_real_distribution(0.0, 180.0)(random);
        for (const bool colours : {false, true}) {
            const std::string text = said(rapidity, degrees, colours);
            EXPECT_EQ(text.starts_with("You look back"), degrees > 120) << rapidity << ' ' << degrees;
            EXPECT_EQ(text.starts_with("You look to the side"), degrees > 60 && degrees < 120) << rapidity << ' ' << degrees;
            const auto D = [&](double at) { return at_rapidity(rapidity, at).doppler_ahead; };
            if (text.find("redder and dimmer") != text.npos || text.find("larger and nearer") != text.npos) {
                EXPECT_LT(D(degrees), 1) << rapidity << ' ' << degrees; // sizes are 1 / D
            }
            if (text.find("towards your way light is bluer") != text.npos) {
                EXPECT_GT(D(degrees - 10), D(degrees)) << rapidity << ' ' << degrees;
            }
            if (text.find("ahead it turns bluer") != text.npos) {
                EXPECT_GT(D(0), 1) << rapidity;
            }
        }
    }
    Readings one = at_rapidity(1, 150);
    one.effects.on.set(Effect::doppler, true), one.effects.on.set(Effect::headlight, false);
    EXPECT_EQ(plain_sentence(one, words()).find("dimmer"), std::string::npos)
        << "without the headlight effect nothing is dimmer";
}

/// A direction of the world on board, or back with -u: the photon (1, -n) in the other frame.
static glm::dvec3 in_frame_of(const glm::dvec3& u, const glm::dvec3& n)
{
    const double g = std::sqrt(1 + glm::dot(u, u)), along = glm::dot(u, n);
    return glm::normalize((n + u * (1 + along / (1 + g))) / (g + along));
}

// Every sentence at flights of chance, whose heads are turned, against light rays that are followed one by one.
TEST(VisitorPanel, EverySentenceIsTrueOfThePicture)
{
    std::mt19937 random(17);
    const auto any = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    const auto direction = [&] {
        const double z = any(-1, 1), a = any(0, 2 * pi);
        return glm::dvec3(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z);
    };
    std::map<std::string, int> said;
    for (int i = 0; i < 4000; ++i) {
        Flight flight;
        const double rapidity = i % 20 == 0 ? 0 : i % 20 == 1 ? any(4, 9) : std::pow(any(0, 1), 1.5) * 4;
        const glm::dvec3 u = std::sinh(rapidity) * direction();
        flight.ship.u = Sum3(u);
        flight.ship.ship_from_cockpit = glm::angleAxis(any(0, 6), direction());
        flight.look_rad = i % 3 == 0 ? glm::dvec2(0) : glm::dvec2(any(-3, 3), any(-1.5, 1.5));
        const bool all_on = i % 2 == 0;
        for (const EffectEntry& one : all_effects)
            flight.effects.on.set(one.which, one.usual ? all_on || any(0, 1) < 0.6 : any(0, 1) < 0.05);
        flight.effects.comparison = any(0, 1) < 0.9 ? Comparison::none
            : any(0, 1) < 0.5                       ? Comparison::galilean
                                                    : Comparison::no_light_delay;
        flight.frozen = any(0, 1) < 0.05;
        Readings shown = readings(flight, SceneFile());
        shown.frozen = flight.frozen;
        const std::string text = plain_sentence(shown, words());
        std::string key = "?";
        for (const auto& [name, value] : words().texts)
            if (name.starts_with("say.") && value == text)
                key = name.substr(4);
        ++said[key];
        SCOPED_TRACE(key + " at rapidity " + std::to_string(rapidity));

        // What the picture does, by rays: the view, D and magnification there, and the light from ahead.
        const double g = std::cosh(rapidity), beta = std::tanh(rapidity);
        const glm::dvec3 way = rapidity > 0 ? glm::normalize(u) : glm::dvec3(0, 0, -1);
        const glm::dvec3 view = shot_of(flight, "").ship_from_cockpit * glm::dvec3(0, 0, -1);
        const double from_motion = std::acos(std::clamp(glm::dot(view, way), -1., 1.)) / pi * 180;
        const auto D = [&](const glm::dvec3& seen) { return 1 / (g * (1 - beta * glm::dot(seen, way))); };
        const glm::dvec3 aside
            = glm::normalize(glm::cross(view, std::abs(view.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 near_by = glm::normalize(view + 1e-4 * aside);
        const double magnified
            = glm::distance(view, near_by) / glm::distance(in_frame_of(-u, view), in_frame_of(-u, near_by));
        double ahead = 0;
        for (int k = 0; k < 400; ++k) { // an even sky
            const double z = -1 + (k + 0.5) / 200, a = 2.399963 * k;
            const glm::dvec3 star(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z);
            ahead += glm::dot(in_frame_of(u, star), way) > 0 ? 1 / 400. : 0;
        }
        const Effects& on = flight.effects;
        const bool looks_ahead = from_motion <= 60.001, looks_back = from_motion >= 119.999;
        if (key == "rest")
            EXPECT_EQ(rapidity, 0);
        else if (key == "slow")
            EXPECT_TRUE(beta > 0 && beta < 0.25);
        else if (key == "rain")
            EXPECT_TRUE(on[Effect::aberration] && looks_ahead && ahead > 0.6 && ahead < 1);
        else if (key == "colours")
            EXPECT_TRUE(on[Effect::doppler] && on[Effect::headlight] && looks_ahead && D(way) > 1.5);
        else if (key == "beam")
            EXPECT_TRUE(on[Effect::aberration] && looks_ahead && ahead > 0.95) << ahead;
        else if (key == "limit")
            EXPECT_TRUE(looks_ahead && 1 - beta < 1e-4);
        else if (key == "back")
            EXPECT_TRUE(on[Effect::aberration] && looks_back && magnified > 1.05) << magnified;
        else if (key == "back_colours")
            EXPECT_TRUE(on[Effect::doppler] && on[Effect::headlight] && looks_back && D(view) < 1);
        else if (key == "aside" || key == "aside_colours") {
            EXPECT_FALSE(looks_ahead || looks_back) << from_motion;
            // What is seen there lies farther from the way for who is at rest, and light nearer to the way is bluer.
            EXPECT_LT(glm::dot(in_frame_of(-u, view), way), glm::dot(view, way));
            EXPECT_GT(D(glm::normalize(view + 0.1 * way)), D(view));
            EXPECT_TRUE(key == "aside" || (on[Effect::doppler] && on[Effect::headlight]));
        } else if (key == "no_aberration")
            EXPECT_TRUE(!on[Effect::aberration] && on[Effect::doppler] && on[Effect::headlight]);
        else if (key == "colours_alone")
            EXPECT_TRUE(!on[Effect::aberration] && on[Effect::doppler] && !on[Effect::headlight]);
        else if (key == "brightness_alone")
            EXPECT_TRUE(!on[Effect::aberration] && !on[Effect::doppler] && on[Effect::headlight]);
        else if (key == "no_effects")
            EXPECT_TRUE(!on[Effect::aberration] && !on[Effect::doppler] && !on[Effect::headlight]);
        else if (key == "galilean" || key == "no_light_delay")
            EXPECT_EQ(on.comparison, key == "galilean" ? Comparison::galilean : Comparison::no_light_delay);
        else if (key == "false_colours")
            EXPECT_TRUE(on[Effect::false_colours]);
        else if (key == "frozen")
            EXPECT_TRUE(flight.frozen);
        else
            ADD_FAILURE() << "what does it say? " << text;
    }
    EXPECT_EQ(said.size(), 18u) << "each is said by chance";
}

TEST(VisitorPanel, VisitorsReadNoFormula)
{
    for (const char* language : {"en", "de"})
        for (const auto& [key, text] : words(language).texts)
            if (key.starts_with("say.")) {
                for (const char* sign : {"γ", "β", "=", "³", "′", "D ", "v/c", "θ"})
                    EXPECT_EQ(text.find(sign), text.npos) << key;
            }
}

TEST(VisitorPanel, AllLinesFitBesideEachOther)
{
    const Typesetter typesetter;
    constexpr int px = 400; // to a panel's height
    for (const char* language : {"en", "de"})
        for (const Information information : {Information::visitor, Information::guide})
            for (Readings r : all_states()) {
                r.information = information;
                struct Box {
                    double left, right, top, bottom;
                };
                std::vector<Box> boxes;
                for (const Lettering& line : lettering_of(typesetter, r, words(language))) {
                    SCOPED_TRACE(language + std::string(": ") + line.text);
                    EXPECT_GE(line.size, least_lettering - 1e-9);
                    const double width = typesetter.width_of(line.text, int(line.size * px)) / px;
                    // DejaVu Sans: capitals reach 0.63 of the size above the baseline, descents 0.2 below.
                    const Box box{line.x, line.x + width, line.baseline - 0.63 * line.size, line.baseline + 0.2 * line.size};
                    EXPECT_GE(box.left, 0.05);
                    EXPECT_LE(box.right, 1 / panel_aspect - 0.05);
                    EXPECT_GE(box.top, 0.03);
                    EXPECT_LE(box.bottom, 0.99);
                    for (const Box& other : boxes)
                        EXPECT_FALSE(box.left < other.right && other.left < box.right && box.top < other.bottom
                            && other.top < box.bottom);
                    boxes.push_back(box);
                }
                if (::testing::Test::HasFailure())
                    return;
            }
}

// A calm exhibit lets through the switches that change words alone (config/model/switches.h). By WCAG 2.3.1 what fills less
// than 0.006 sr of any field of 10 degrees is no flash. All that differs counts, on the widest display of the shipped
// layouts.
TEST(VisitorPanel, TheWordsThatASwitchChangesAreTooSmallAnAreaToFlash)
{
    const Typesetter typesetter;
    constexpr double width_deg = 60, px_per_deg = 12, limit_sr = 0.006;
    constexpr int width = int(width_deg * px_per_deg), field = int(10 * px_per_deg);
    const double pixel_sr = std::pow(pi / 180 / px_per_deg, 2);
    double most_sr = 0;
    for (const char* language : {"en", "de"})
        for (const Information information : {Information::visitor, Information::guide, Information::laboratory})
            for (const double rapidity : {0.0, 0.5, 1.5}) {
                Readings usual = at_rapidity(rapidity);
                usual.information = information;
                Readings locked = usual;
                locked.exposure_locked = true;
                const Panel before = typesetter.draw(usual, words(language), width);
                const Panel after = typesetter.draw(locked, words(language), width);
                ASSERT_EQ(after.size, before.size);
                // The sums of the pixels that differ, over all rectangles from the corner on.
                const int height = before.size.y;
                std::vector<double> sums(std::size_t(width + 1) * (height + 1), 0);
                const auto at = [&](int x, int y) -> double& { return sums[std::size_t(y) * (width + 1) + x]; };
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        const std::size_t texel = 2 * (std::size_t(y) * width + x);
                        const bool differs = before.texels[texel] != after.texels[texel]
                            || before.texels[texel + 1] != after.texels[texel + 1];
                        at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + (differs ? pixel_sr : 0);
                    }
                for (int y = 0; y < std::max(1, height - field); ++y)
                    for (int x = 0; x < width - field; ++x) {
                        const int right = x + field, low = std::min(y + field, height);
                        most_sr = std::max(most_sr, at(right, low) - at(x, low) - at(right, y) + at(x, y));
                    }
            }
    std::printf("  %.4f sr of letters\n", most_sr);
    EXPECT_GT(most_sr, 1e-5);
    EXPECT_LT(most_sr, limit_sr);
}

TEST(VisitorPanel, OnEveryLayoutItsLettersAreReadableAndItCoversLittle)
{
    MapStore store{std::filesystem::path()};
    for (const std::filesystem::path& file : shipped("config/layouts")) {
        SCOPED_TRACE(file.filename());
        const Layout layout = load_layout(file);
        std::vector<std::vector<CompiledView>> views;
        std::vector<glm::ivec2> sizes;
        for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
            sizes.push_back(layout.outputs[i].size / (layout.outputs[i].size.x > 1000 ? 8 : 4));
            views.push_back(compile_output(store, layout, i, sizes.back()));
        }
        const HudPlacement hud = placed_hud(layout, sizes, views);
        const glm::dmat3 panel = panel_from_cockpit(hud, views);
        const double half = std::tan(glm::radians(0.5 * hud.width_deg));
        const double height_deg = 2 * glm::degrees(std::atan(half * panel_aspect));
        const double capitals_deg = 0.63 * least_lettering * height_deg;
        EXPECT_LE(0.63 * 0.26 * height_deg, 3);
        // By solid angle: each pixel's, from its neighbours' directions.
        double all = 0, covered = 0;
        for (const auto& output : views)
            for (const CompiledView& view : output)
                for (int y = 0; view.view.eye != Eye::right && y + 1 < view.view.size.y; ++y)
                    for (int x = 0; x + 1 < view.view.size.x; ++x) {
                        const auto towards = [&](int i, int j) -> std::optional<glm::dvec3> {
                            if (view.matrix)
                                return glm::normalize(*view.matrix * glm::dvec3(x + i + 0.5, y + j + 0.5, 1));
                            const glm::vec4 at = view.map->at(x + i, y + j);
                            return at.w > 0 ? std::optional(glm::normalize(glm::dvec3(at))) : std::nullopt;
                        };
                        const auto a = towards(0, 0), b = towards(1, 0), c = towards(0, 1);
                        if (!a || !b || !c)
                            continue;
                        const double solid = glm::length(glm::cross(*b - *a, *c - *a));
                        const glm::dvec3 at = panel * *a;
                        all += solid;
                        if (at.z > 0 && std::abs(at.x) < half * at.z && std::abs(at.y) < half * panel_aspect * at.z)
                            covered += solid;
                    }
        std::printf("  %-20s capitals from %.2f degrees, the panel covers %4.1f %%\n", file.stem().c_str(), capitals_deg,
            100 * covered / all);
        EXPECT_GT(covered, 0);
        // On a picture below 0.7 sr, some 50 by 46 degrees, both can't be had: a television that fills 34 degrees.
        const bool small = all < 0.7;
        EXPECT_GE(capitals_deg, small ? 0.65 : 1);
        EXPECT_LT(covered / all, small ? 0.22 : 0.1);
    }
}

} // namespace visitor_panel_test
