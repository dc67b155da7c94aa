// Each number of a tour's captions, and each thing that they name as seen, its place and its size, is computed here from the
// flight's state while the caption is shown, by formulas that share no code with the program's measures. A number or a
// caption that is not listed here fails.
#include "config/model/shipped.h"
#include "config/model/tour_file.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/caption.h"
#include "tests/support/files.h"
#include "tests/support/tour_frame.h"
#include "tests/support/words_files.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace caption_truth_test {

using namespace starbow;
using namespace starbow::testing;
using glm::dvec3;

namespace {

constexpr double about = 0.25; ///< what "about" allows

struct Number {
    std::string text; ///< as in the English caption; {measured}: the measured one
    std::function<double(const Frame&)> is;
    double within; ///< so much off is the same for a reader of the instruments beside it
};
struct Seen {
    const char* what;
    std::function<dvec3(const Frame&)> at;
    double within_deg = 0; ///< of the view's middle; 0: anywhere in view
    dvec3 across{0}; ///< from one of its ends to the other, in the world; 0: a point, as a star, or a place
    double least_deg = 1; ///< it is seen at least as large
};
/// A picture of 720 rows over 60 degrees has 12 in one degree. A thing of 12 pixels shows which thing it is. The hand of a
/// dial of 36 is 15 long: the tip moves by 1.5 pixels in a second, a sixtieth of the turn.
constexpr double read_deg = 3;
/// Dials, and other things, from one end to the other.
const dvec3 clock_dial(3.8, 0, 0), ship_dial(1.24, 0, 0), golden(2.6, 0, 0), whole_column(0, 3, 0);
constexpr double earth_s = 12742 / 299792.458, saturn_s = 2 * 58232 / 299792.458;

Seen dial(const char* what, double x)
{
    return {what, [=](const Frame&) { return dvec3(x, 0, 0); }, 0, clock_dial, read_deg};
}
struct Facts {
    std::vector<Number> numbers;
    std::vector<Seen> seen;
    bool at_end_only = false; ///< the caption says what comes, and is true once its step is over
};

std::function<dvec3(const Frame&)> place(double x, double y, double z)
{
    return [=](const Frame&) { return dvec3(x, y, z); };
}
std::function<double(const Frame&)> always(double x)
{
    return [=](const Frame&) { return x; };
}

/// Half of a way of d light-years at one g: years on board, at home, and gamma.
struct Half {
    double on_board, at_home, gamma;
    explicit Half(double d)
    {
        const double a = 9.80665 * light_year_s / 299792458, coshed = 1 + a * d / 2;
        on_board = std::acosh(coshed) / a, at_home = std::sqrt(coshed * coshed - 1) / a, gamma = coshed;
    }
};

const dvec3 column(0, 0, -46), saturn_then(-1065.36964085, 245.286484011, -4265.03607586);

const std::map<std::string, Facts>& facts()
{
    const auto beta = [](const Frame& f) { return f.beta(); };
    const auto years = [](const Frame& f) { return f.own; };
    // The shaft's width, relative to that from 12 light-seconds at rest; of a point it is 0.2 % more at the end. The height
    // is as good a measure from far away alone.
    const auto size = [](const Frame& f) { return f.size_deg(column, {0.3, 0, 0}) / (2 * std::atan(0.15 / 12) / degree); };
    const auto height = [](const Frame& f) { return f.size_deg(column, whole_column) / (2 * std::atan(1.5 / 12) / degree); };
    const auto to_column = [](const Frame& f) { return f.away(column); };
    const auto straight = [](const dvec3& at) {
        const dvec3 high = at == column ? whole_column : dvec3(0);
        return std::vector<Seen>{{"straight ahead", place(at.x, at.y, at.z), 3, high}};
    };
    const auto minutes = [](const Frame& f) { return f.trip / 60; };
    const auto light_left = [](const Frame& f) { return f.left(dvec3(0)) / 60; };
    // Sirius' neighbour need not be known: Proxima lies straight ahead of home, the Pleiades where the tour's comment says.
    const dvec3 proxima(0, 0, -4.244);
    const dvec3 pleiades = 403. * dvec3(0.30382802304345763, -0.5772852186744786, 0.7579118080050367);
    const Seen gold{"the golden ring", place(1.3, -0.35, -8), 0, golden}, home{"home", place(-1.3, 0, 0), 0, ship_dial},
        home_dial{"the clock at home", place(-1.3, 0, 0), 0, ship_dial, read_deg},
        dial_away{"the traveller's clock", travellers_dial, 0, ship_dial, read_deg};
    const std::vector<Seen> ring{gold}, ships{home_dial, {"the traveller", place(1.3, 0, 0), 0, ship_dial, read_deg}};
    const dvec3 whole_earth(0, earth_s, 0);
    static const std::map<std::string, Facts> all{
        // Names above rings: tests/hud/highlights_test.cpp has their places.
        {"first-minute.mark", {}},
        {"simultaneity.left", {}},
        {"simultaneity.middle", {}},
        {"simultaneity.right", {}},
        {"solar-system.earth_mark", {}},
        {"solar-system.saturn_mark", {}},
        {"street.mark", {}},
        {"twins.home", {}},
        {"twins.traveller", {}},
        {"voyage.alpha_mark", {}},
        {"voyage.centre_mark", {}},
        {"voyage.proxima_mark", {}},
        {"voyage.sisters_mark", {}},
        {"first-minute.title", {{}, straight(column)}},
        {"first-minute.end", {}},
        {"aurora.title", {}},
        {"aurora.end", {}},
        {"aurora.here", {{{"420", [](const Frame& f) { return f.away(dvec3(0)) * 299792.458 - 6371; }, 2}}, {}}},
        {"aurora.towards", {{{"{measured}", beta, 0.006}}, {}}},
        {"aurora.infrared", {{{"{measured}", beta, 0.006}}, {}}},
        {"aurora.air", {{{"{measured}", beta, 0.006}}, {}}},
        {"aurora.brake", {}},
        {"aurora.away", {{{"{measured}", beta, 0.006}}, {}}},
        {"aurora.question", {}},
        {"aurora.red", {}},
        {"aurora.green", {}},
        {"aurora.violet", {}},
        {"aurora.answer",
            {{{"{measured}", [](const Frame& f) { return std::sqrt((1 - f.beta()) / (1 + f.beta())); }, 0.006}}, {}}},
        {"aurora.stop", {}},
        {"rainbow.title", {}},
        {"rainbow.end", {}},
        {"simultaneity.title", {}},
        {"simultaneity.end", {}},
        {"solar-system.title", {}},
        {"solar-system.end", {{{"73", [](const Frame& f) { return f.away(dvec3(0)) / 60; }, 0.5}}, {}}},
        {"twins.title", {}},
        {"twins.end", {}},
        {"voyage.title", {}},
        {"voyage.end", {}},
        {"street.title", {}},
        {"street.faster", {{{"5", always(5), 0}, {"{measured}", beta, 0.006}}, {}}},
        {"street.corner", {{}, {{"the house beside us", [](const Frame& f) { return f.at + dvec3(5, 0, 0); }, 1}}}},
        {"street.ahead", {}},
        {"street.colours", {}},
        {"street.stop", {}},
        {"street.end", {}},
        {"street.try", {}},
        {"first-minute.here", {{{"twelve", to_column, 1e-9}}, straight(column)}},
        {"first-minute.guess", {{}, straight(column)}},
        {"first-minute.back", {{{"{measured}", size, 0.006}, {"{measured}", height, 0.01}}, straight(column)}},
        {"first-minute.question", {{}, straight(column)}},
        {"first-minute.farther", {}},
        {"first-minute.same", {}},
        {"first-minute.nearer", {}},
        {"first-minute.answer", {{{"{measured}", to_column, 0.006}}, straight(column)}},
        {"first-minute.return", {{{"{measured}", size, 0.008}}, straight(column)}},
        {"first-minute.as-before",
            {{{"{measured}", to_column, 0.006}, {"as wide", size, 0.01}, {"nearly as high", height, 0.15}},
                straight(column)}},
        {"first-minute.stop", {{}, straight(column)}},
        {"first-minute.home", {}},
        {"first-minute.try", {}},
        {"voyage.home", {{{"4.2", [=](const Frame& f) { return f.away(proxima); }, 0.05}}, straight(proxima)}},
        {"voyage.faster", {{{"{measured}", beta, 0.006}}, {}}},
        {"voyage.look_back", {{{"{measured}", [](const Frame& f) { return f.left(dvec3(0)); }, 0.006}}, {}}},
        {"voyage.look_ahead", {{{"{measured}", years, 0.006}}, {}}},
        {"voyage.brake",
            {{{"{measured}",
                 [](const Frame& f) {
                     return f.away({0, 0, -4.244064771850923});
                 },
                 0.006}},
                {}}},
        {"voyage.proxima", {{{"{measured}", years, 0.006}}, {{"Proxima", place(0, 0, -4.2441)}}}},
        {"voyage.question", {{{"3.5", years, 0.05}}, {}}},
        {"voyage.as_long", {{{"3.5", years, 0.05}}, {}}},
        {"voyage.longer", {{{"6", [](const Frame& f) { return f.time; }, 0.2}}, {}}},
        {"voyage.far_longer", {{{"12", always(12), 0}}, {}}}, // a wrong answer
        {"voyage.answer",
            {{{"{measured}", [](const Frame& f) { return f.time; }, 0.006}, {"4.2", always(4.244), 0.05}}, {}}},
        {"voyage.pleiades", {{{"403", [=](const Frame& f) { return f.away(pleiades); }, 2}}, straight(pleiades)}},
        {"voyage.crowd", {{{"{measured}", [](const Frame& f) { return f.gamma(); }, 0.6}}, {}}},
        {"voyage.spread", {{{"{measured}", [](const Frame& f) { return f.trip; }, 0.06}}, {}}},
        {"voyage.among",
            {{{"{measured}", [](const Frame& f) { return f.time; }, 0.6},
                 {"twelve", [](const Frame& f) { return f.trip; }, 0.5}},
                {}}},
        {"voyage.centre",
            {{{"26,700", always(8178 * 3.26156), 50}, {"twenty", always(2 * Half(8178 * 3.26156).on_board), 0.5}}, {}}},
        {"voyage.life", {{{"{measured}", [](const Frame& f) { return f.trip; }, 0.06}}, {}}},
        {"voyage.half", {{{"{measured}", [](const Frame& f) { return f.time; }, 0.6}, {"0.999999997", beta, 5e-10}}, {}}},
        {"voyage.try", {}},
        {"solar-system.earth",
            {{{"12", always(12), 0}, {"2026", always(2026), 0}}, {{"the whole Earth", place(0, 0, 0), 0, whole_earth, 12}}}},
        {"solar-system.down", {{}, {}, true}},
        {"solar-system.air", {{{"400", [](const Frame& f) { return f.away(dvec3(0)) * 299792.458 - 6371; }, 15}}, {}}},
        {"solar-system.shadow", {{}, {{"the Earth", place(0, 0, 0), 0, whole_earth}}}},
        {"solar-system.depart",
            {{{"73", [](const Frame& f) { return f.away(saturn_then) / 60; }, 0.5}},
                {{"the place of Saturn", [](const Frame&) { return saturn_then; }, 3},
                    {"the Earth", place(0, 0, 0), 0, whole_earth}}}},
        {"solar-system.faster", {{{"{measured}", beta, 0.006}}, {}}},
        {"solar-system.brake", {{{"{measured}", [](const Frame& f) { return f.away(saturn_then); }, 6}}, {}}},
        {"solar-system.there", {}},
        {"solar-system.saturn",
            {{{"{measured}", minutes, 0.06}},
                {{"Saturn", [](const Frame& f) { return f.at + dvec3(0.582790378366, 0.338137762192, -0.738930462672); }, 5,
                    {0, saturn_s, 0}, 5}}}},
        {"solar-system.back", {{{"{measured}", minutes, 0.06}}, {}}},
        {"solar-system.question", {{}, {{"the Earth beside the Sun", place(0, 0, 0), 15}}}},
        {"solar-system.no_time", {{{"3", light_left, 0.3}}, {}}},
        {"solar-system.ours", {{{"11", minutes, 0.5}}, {}}},
        {"solar-system.theirs", {{{"76", [](const Frame& f) { return f.time / 60; }, 0.5}}, {}}},
        {"solar-system.answer",
            {{{"{measured}", light_left, 0.006}, {"76", [](const Frame& f) { return f.time / 60; }, 0.5},
                 {"73", [](const Frame& f) { return f.away(dvec3(0)) / 60; }, 0.5}},
                {}}},
        {"solar-system.try", {}},
        {"rainbow.lamp", {{{"450", always(450), 0}}, {}}},
        {"rainbow.guess", {}},
        {"rainbow.faster", {{{"{measured}", beta, 0.006}}, {}}},
        {"rainbow.colours", {}},
        {"rainbow.question", {}},
        {"rainbow.ahead", {}},
        {"rainbow.abreast", {}},
        {"rainbow.behind", {}},
        {"rainbow.answer",
            {{{"{measured}", [](const Frame& f) { return std::acos((1 - 1 / f.gamma()) / f.beta()) / degree; },
                  0.06}, // D is 1
                 {"90", always(90), 0}},
                {}}},
        {"rainbow.look_back", {}},
        {"rainbow.back", {}},
        {"rainbow.look_ahead", {}},
        {"rainbow.front", {}},
        {"rainbow.stop", {}},
        {"rainbow.try", {}},
        {"simultaneity.here", {{}, {dial("the first clock", -10), dial("the last clock", 10)}}},
        {"simultaneity.light",
            {{{"{measured}",
                 [](const Frame& f) {
                     return f.left(dvec3(0)) - f.left({10, 0, 0});
                 },
                 0.006}},
                {dial("the first clock", -10), dial("the last clock", 10)}}},
        {"simultaneity.fly", {{{"half", [](const Frame& f) { return 2 * f.beta() - 0.5; }, 1e-9}}, {}}},
        {"simultaneity.now", {{}, {{"the middle clock", place(0, 0, 0), 1, clock_dial, read_deg}}}},
        {"simultaneity.question", {{}, {dial("the far left", -10), dial("the far right", 10)}}},
        {"simultaneity.same", {}},
        {"simultaneity.later", {}},
        {"simultaneity.earlier", {}},
        {"simultaneity.answer",
            {{{"{measured}",
                 [](const Frame& f) {
                     return f.left({10, 0, 0}) - f.left({-10, 0, 0});
                 },
                 0.006}},
                {}}},
        {"simultaneity.stop", {}},
        {"simultaneity.stopped", {{}, {dial("the left clock", -10)}}},
        {"simultaneity.try", {}},
        {"twins.here", {{{"8", always(8), 0}, {"0.8", always(0.8), 0}}, {home_dial, ships[1], gold}}},
        {"twins.leaves", {{}, {home_dial, dial_away}}},
        {"twins.far", {{}, {home_dial, gold}}},
        {"twins.question", {{{"6", travellers_clock, 0.05}}, {gold, home_dial, dial_away}}},
        {"twins.six", {{{"6", travellers_clock, 0.05}}, {}}},
        {"twins.ten", {{{"10", travellers_light, about}}, {}}},
        {"twins.eighteen", {{{"18", home_clock, about}}, {}}},
        {"twins.answer",
            {{{"{measured}", travellers_light, 0.006},
                 {"8", [](const Frame& f) { return home_clock(f) - travellers_light(f); }, about},
                 {"6", travellers_clock, 0.05}},
                ring}},
        {"twins.returns", {{}, {home_dial, dial_away}}},
        {"twins.meet",
            {{{"20", [](const Frame& f) { return home_clock(f) - 0.5; }, 0.05},
                 {"12", [](const Frame& f) { return travellers_clock(f) - 0.5; }, 0.05},
                 {"8", [](const Frame& f) { return home_clock(f) - travellers_clock(f); }, 0.05}},
                ships}},
        {"twins.aboard", {{}, {home_dial}}},
        {"twins.before", {{{"{measured}", now_at_home, 0.006}}, {home}}},
        {"twins.turn", {{{"{measured}", now_at_home, 0.06}}, {home}}},
        {"twins.leap",
            {{{"3.6", [](const Frame& f) { return f.time - 0.8 * 8; }, 0.05}, {"{measured}", now_at_home, 0.06}}, {home}}},
        {"twins.homeward", {{}, {home_dial}}},
        {"twins.both",
            {{{"20", [](const Frame& f) { return home_clock(f) - 0.5; }, 0.05},
                 {"12", [](const Frame& f) { return travellers_clock(f) - 0.5; }, 0.05}},
                ships}},
        {"twins.again", {{}, ships}},
        {"twins.try", {}},
    };
    return all;
}

std::string key_of(const std::string& text, const nlohmann::json& words)
{
    for (const auto& [key, value] : words.items())
        if (key.starts_with("tour.") && value == text)
            return key.substr(5);
    return "?";
}

double value_of(std::string figures)
{
    static const std::map<std::string, double> words{
        {"twelve", 12}, {"twenty", 20}, {"half", 0.5}, {"as wide", 1}, {"nearly as high", 1}};
    if (const auto found = words.find(figures); found != words.end())
        return found->second;
    std::erase(figures, ',');
    return std::stod(figures);
}

/// The shown number of a caption: what stands in the place of {measured}.
double shown_number(const std::string& text, const std::string& pattern)
{
    const std::size_t at = pattern.find("{measured}");
    const std::string before = pattern.substr(0, at), after = pattern.substr(at + 10);
    const std::size_t end = after.empty() ? text.size() : text.find(after);
    // An answer begins with the verdict.
    const std::size_t from = before.empty() ? text.rfind(' ', end - 1) + 1 : text.find(before) + before.size();
    const std::string figures = text.substr(from, end - from);
    const bool negative = figures.starts_with("−");
    return (negative ? -1 : 1) * std::stod(negative ? figures.substr(3) : figures);
}

TEST(CaptionTruth, EveryNumberIsListed)
{
    const std::regex keys("\\{measured\\}|(button|Taste|Knopf) \\d|\\d (or button|oder Taste) \\d|\\b1 g\\b");
    for (const char* language : {"en", "de"}) {
        const nlohmann::json words = words_file(language);
        std::size_t texts = 0;
        for (const auto& [key, value] : words.items()) {
            if (!key.starts_with("tour.") || key.find(".see-") != key.npos || key.find('.', 5) == key.npos)
                continue;
            const auto found = facts().find(key.substr(5));
            EXPECT_NE(found, facts().end()) << key << ": what does it say?";
            if (found == facts().end())
                continue;
            std::vector<std::string> listed;
            for (const Number& number : found->second.numbers)
                if (std::isdigit(number.text[0]))
                    listed.push_back(number.text);
            std::ranges::sort(listed);
            EXPECT_EQ(numbers_in(value, language[0] == 'd', keys), listed) << language << " " << key;
            const bool measured
                = std::ranges::any_of(found->second.numbers, [](const Number& n) { return n.text[0] == '{'; });
            EXPECT_EQ(value.get<std::string>().find("{measured}") != std::string::npos, measured) << key;
            ++texts;
        }
        EXPECT_EQ(texts, facts().size()) << language;
    }
}

TEST(CaptionTruth, EveryNumberAndThingIsThatOfTheFrame)
{
    const nlohmann::json english = words_file("en");
    std::set<std::string> met;
    for (const auto& [file, tour, half_view_deg] : shown_tours()) {
        const double unit_s = unit_s_of(file);
        const Show timed{tour, {}, unit_s, false};
        for (Touring touring = touring_at(timed); !touring.over; touring = advance(touring, timed, {}, 250'000'000)) {
            const Step& step = tour.steps[touring.step()];
            const Frame frame = frame_of(touring, half_view_deg);
            const std::string shown = caption_of(touring, timed, words(), {}).text;
            std::vector<std::string> patterns;
            if (!step.question)
                patterns = {step.caption};
            else if (touring.measured_answer)
                patterns = {step.question->explanation};
            else
                patterns = {step.question->ask};
            if (step.question)
                if (const auto* choices = std::get_if<std::vector<Choice>>(&step.question->answer))
                    for (const Choice& choice : *choices)
                        patterns.push_back(choice.text);
            if (1e-9 * double(touring.into_ns) <= title_s)
                patterns.push_back(step.title);
            for (const Highlight& highlight : step.highlights)
                patterns.push_back(highlight.name);
            for (std::size_t i = 0; i < patterns.size(); ++i) {
                if (patterns[i].empty())
                    continue;
                const std::string key = key_of(patterns[i], english);
                EXPECT_TRUE(facts().contains(key)) << file << " " << key << ": " << patterns[i];
                if (!facts().contains(key))
                    continue;
                const Facts& said = facts().at(key);
                met.insert(key);
                SCOPED_TRACE(key + " at " + std::to_string(1e-9 * double(touring.into_ns)) + " s of the step");
                for (const Number& number : said.numbers) {
                    const double is = number.is(frame);
                    EXPECT_NEAR(
                        is, number.text[0] == '{' ? shown_number(shown, patterns[i]) : value_of(number.text), number.within)
                        << number.text;
                }
                for (const Seen& seen : said.seen) {
                    EXPECT_TRUE(frame.sees(seen.at(frame))) << seen.what << " is not in view";
                    if (seen.within_deg > 0) {
                        EXPECT_LE(frame.off_middle_deg(seen.at(frame)), seen.within_deg) << seen.what;
                    }
                    if (seen.across != dvec3(0)) {
                        EXPECT_GE(frame.size_deg(seen.at(frame), seen.across), seen.least_deg)
                            << seen.what << " is too small";
                    }
                }
            }
        }
    }
    for (const auto& [key, said] : facts())
        EXPECT_TRUE(key.ends_with(".try") || met.contains(key)) << key << " is never shown";
}

} // namespace

} // namespace caption_truth_test
