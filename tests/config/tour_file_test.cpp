// Tour files: the shipped ones in every language, and wrong files. The editors' schema must agree with the reader.
#include "config/model/shipped.h"
#include "config/model/tour_file.h"
#include "runtime/flight/tour.h"
#include "runtime/hud/hud.h"
#include "runtime/hud/signs.h"
#include "tests/support/files.h"
#include "tests/support/schema_check.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace tour_file_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

bool schema_accepts(const json& tour) { return starbow::testing::schema_accepts("tour", tour); }

std::filesystem::path shipped_shot(const std::string& name) { return source_dir() / "config/shots" / (name + ".json"); }

Tour tour_of(const std::string& text, const std::string& language = "en")
{
    return load_tour(write_text("tour.json", text), words(language), shipped_shot);
}

/// The reader's message, or "" for a valid tour.
std::string message_for(const std::string& text)
{
    try {
        tour_of(text);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// A tour with this as its second step.
std::string with(const std::string& step)
{
    return R"({ "scene": "avenue", "steps": [{ "seconds": 1, "cut": "start" }, { "seconds": 2, )" + step + " }] }";
}

const std::string question
    = R"("ask": { "en": "?" }, "explanation": { "en": "{measured}" }, "measure": { "quantity": "gamma" }, "number": { "from": 1, "to": 9, "step": 0.5, "tolerance": 0.2 })";

} // namespace

TEST(TourFile, ShippedToursAreReadInEveryLanguage)
{
    int count = 0;
    for (const auto& file : shipped("config/tours")) {
        SCOPED_TRACE(file.filename().string());
        const json text = json::parse(read_text(file), nullptr, true, true);
        EXPECT_TRUE(schema_accepts(text));
        for (const auto& language : shipped("config/words")) {
            const Tour tour = load_tour(file, load_words(language), shipped_shot);
            EXPECT_EQ(tour.steps.size(), text["steps"].size());
            EXPECT_TRUE(std::filesystem::exists(scene_of(tour))) << tour.scene;
            for (const Step& step : tour.steps)
                EXPECT_TRUE(step.question || !step.caption.empty() || !step.title.empty())
                    << "a step needs a title, a caption or a question";
        }
        ++count;
    }
    EXPECT_GE(count, 4);
}

/// Every text of a tour is used by some tour.
TEST(TourFile, EveryTourTextIsUsed)
{
    std::string tours;
    for (const auto& file : shipped("config/tours"))
        tours += read_text(file);
    for (const auto& [key, text] : words().texts)
        EXPECT_TRUE(!key.starts_with("tour.") || tours.find(std::string("\"").append(key).append("\"")) != tours.npos)
            << key;
}

/// Every text fits in three lines with letters of at least a ninth of the panel's height, in every language.
TEST(TourFile, TextsFitTheDisplay)
{
    const Typesetter typesetter;
    constexpr double height = 200, width = height / panel_aspect, smallest = height / 9;
    const auto lines = [&](const std::string& text) {
        return wrapped(filled(text, {{"measured", "0.0000"}}), 0.93 * width, [&](const std::string& line) {
            return typesetter.width_of(line, int(smallest));
        }).size();
    };
    EXPECT_LE(draw_title(typesetter, std::string(60, 'W'), int(width)).size.x, width + 1) << "one long word";
    for (const auto& file : shipped("config/tours"))
        for (const auto& language : shipped("config/words")) {
            const Words texts = load_words(language);
            for (const Step& step : load_tour(file, texts, shipped_shot).steps) {
                EXPECT_LE(lines(step.caption), 3u) << step.caption;
                const Panel title = draw_title(typesetter, step.title, int(width));
                EXPECT_LE(title.size.x, width + 1) << step.title; // beside the display's own width
                EXPECT_LE(title.size.y, 3.7 * title_letters * width + 2) << step.title << " is longer than two lines";
                if (step.question) {
                    EXPECT_LE(lines(step.question->ask), 2u) << step.question->ask;
                    constexpr Key prefixes[]{"touring.right", "touring.wrong", "touring.answer"};
                    for (const Key prefix : prefixes)
                        EXPECT_LE(lines(texts(prefix) + " " + step.question->explanation), 3u) << step.question->explanation;
                }
            }
        }
}

TEST(TourFile, EveryMemberIsRead)
{
    const std::string text = R"({ "scene": "clocks", "again_after_s": 33, "ship_s_per_s": 0.5, "steps": [
        { "seconds": 1.5, "cut": { "time": 7, "position": [1, 2, 3], "velocity": { "direction": [0, 0, 2], "gamma": 4 } },
          "title": { "de": "Titel", "en": "title" }, "caption": { "de": "deutsch", "en": "english" }, "exposure_ev": -2 },
        { "seconds": 2, "ship_s_per_s": 3, "glide": { "position": [4, 5, 6], "time": 9 },
          "caption": "tour.first-minute.back", "measure": { "quantity": "reading_s", "at": [1, 0, 0], "relative_to": [0, 1, 0] } },
        { "seconds": 3, "ease_s": [0.5, 1], "thrust": { "rapidity_per_s": 0.25, "towards": [0, 3, 0] }, "effects": { "doppler": false } },
        { "seconds": 4, "turn": { "look": [1, 0, 0] } },
        { "seconds": 5, "question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "explanation_s": 4, "measure": { "quantity": "beta" },
          "choices": [{ "text": { "en": "a" }, "below": 0.5 }, { "text": { "en": "b" }, "from": 0.5 }] } },
        { "seconds": 6, "try": { "mode": "newtonian", "max_gamma": 7 },
          "question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "measure": { "quantity": "gamma" }, "reach": { "from": 2, "to": 3 } } },
        { "seconds": 7 } ] })";
    EXPECT_TRUE(schema_accepts(json::parse(text)));
    const Tour tour = tour_of(text), german = tour_of(text, "de");
    EXPECT_EQ(tour.scene, "clocks");
    EXPECT_EQ(tour.again_after_s, 33);
    ASSERT_EQ(tour.steps.size(), 7u);
    const Shot& shot = std::get<Cut>(tour.steps[0].motion).shot;
    EXPECT_EQ(shot.time, 7);
    EXPECT_EQ(shot.position, glm::dvec3(1, 2, 3));
    EXPECT_NEAR(shot.u.z, std::sqrt(15.0), 1e-15 * 15);
    EXPECT_EQ(tour.steps[0].seconds, 1.5);
    EXPECT_EQ(tour.steps[0].ship_s_per_s, 0.5);
    EXPECT_EQ(tour.steps[0].caption, "english");
    EXPECT_EQ(german.steps[0].caption, "deutsch");
    EXPECT_EQ(tour.steps[0].title, "title");
    EXPECT_EQ(tour.steps[1].title, "");
    EXPECT_EQ(german.steps[4].question->ask, "?") << "English replaces a missing language";
    EXPECT_EQ(tour.steps[0].exposure_ev, -2);
    const Glide& glide = std::get<Glide>(tour.steps[1].motion);
    EXPECT_EQ(glide.position, glm::dvec3(4, 5, 6));
    EXPECT_EQ(glide.time, 9);
    EXPECT_FALSE(glide.u || glide.ship_from_cockpit) << "members that are not given stay";
    EXPECT_EQ(tour.steps[1].ship_s_per_s, 3);
    EXPECT_EQ(tour.steps[1].measure->quantity, Measure::Quantity::reading_s);
    EXPECT_EQ(tour.steps[1].measure->at, glm::dvec3(1, 0, 0));
    EXPECT_EQ(tour.steps[1].measure->relative_to, glm::dvec3(0, 1, 0));
    const Thrust& thrust = std::get<Thrust>(tour.steps[2].motion);
    EXPECT_EQ(thrust.rapidity_per_s, 0.25);
    EXPECT_EQ(thrust.towards, glm::dvec3(0, 1, 0));
    EXPECT_EQ(tour.steps[2].ease_s, glm::dvec2(0.5, 1));
    EXPECT_FALSE(tour.steps[2].effects->on[Effect::doppler]);
    EXPECT_TRUE(tour.steps[2].effects->on[Effect::headlight]);
    EXPECT_EQ(std::get<Turning>(tour.steps[3].motion).ship_from_cockpit, orientation({1, 0, 0}, {0, 1, 0}));
    const auto& choices = std::get<std::vector<Choice>>(tour.steps[4].question->answer);
    ASSERT_EQ(choices.size(), 2u);
    EXPECT_EQ(choices[0].below, 0.5);
    EXPECT_EQ(choices[1].from, 0.5);
    EXPECT_EQ(choices[1].text, "b");
    EXPECT_EQ(tour.steps[4].question->explanation_s, 4);
    EXPECT_EQ(std::get<Try>(tour.steps[5].motion).mode, FlightMode::newtonian);
    EXPECT_EQ(std::get<Try>(tour.steps[5].motion).max_gamma, 7);
    EXPECT_EQ(std::get<PlaceToReach>(tour.steps[5].question->answer).to, 3);
    EXPECT_TRUE(std::holds_alternative<Coast>(tour.steps[6].motion));
}

TEST(TourFile, WrongToursAreRefusedByReaderAndSchema)
{
    for (const auto& [text, problem] :
        std::vector<std::pair<std::string, std::string>>{
            {with(R"("caption": "hello")"), "/steps/1/caption: \"hello\" is not a text in en.json"},
            {with(R"("caption": {})"), "/steps/1/caption: {} is not a text"},
            {with(R"("measure": { "what": "gamma" })"),
                "/steps/1/measure/what: \"gamma\" stands under a name of older files"},
            {with(R"("measure": { "quantity": "gamma", "against": [0, 0, 0] })"), "\"relative_to\" is its name now"},
            {with(R"("measure": { "quantity": "size" })"), "/steps/1/measure: {\"quantity\":\"size\"} lacks \"at\""},
            {with(R"("measure": { "quantity": "gamma", "at": [0, 0, 0] })"),
                "/steps/1/measure/at: [0,0,0] is a place too many"},
            {with(R"("cut": "start", "thrust": { "rapidity_per_s": 1 })"), "/steps/1/thrust: "},
            {with(R"("glide": { "effects": {} })"), "/steps/1/glide/effects"},
            {with(R"("around": {})"), "/steps/1/around: {} needs one motion; exactly one of"},
            {with(R"("around": { "cut": "start", "glide": {} })"), "needs one motion"},
            {with(R"("around": { "thrust": { "rapidity_per_s": 1 } })"), "/steps/1/around"},
            {with(R"("highlights": [{ "name": { "en": "x" }, "at": [0, 0, 0], "across": 1, "globe": "Earth" }])"),
                "has a globe, whose place and size are known, and \"at\""},
            {with(R"("highlights": [{ "name": { "en": "x" }, "body": "train" }])"), "/steps/1/highlights/0: "},
            {with(R"("highlights": [{ "name": { "en": "x" }, "globe": "Earth", "body": "train" }])"),
                "/steps/1/highlights/0/body: \"train\" conflicts with"},
            {with(
                 R"("question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "measure": { "quantity": "gamma" } })"),
                "needs one way to answer"}}) {
        EXPECT_NE(message_for(text).find(problem), std::string::npos) << message_for(text);
        EXPECT_FALSE(schema_accepts(json::parse(text))) << text;
    }
    // The schema can't express these rules.
    for (const auto& [text, problem] :
        std::vector<std::pair<std::string, std::string>>{
            {R"({ "scene": "avenue", "steps": [{ "seconds": 1 }] })", "/steps/0: {\"seconds\":1} begins nowhere"},
            {R"({ "scene": "avenue", "steps": [{ "seconds": 1, "cut": "start", "around": { "glide": {} } }] })",
                "/steps/0/around: {\"glide\":{}} begins nowhere"},
            {R"({ "scene": "clocks", "steps": [{ "seconds": 1, "cut": "start" }] })",
                "/steps/0/cut: \"start\" is a shot in the scene avenue"},
            {with(R"("caption": "tour.no.such")"), "is not a text in en.json"},
            {with(R"("caption": "tour.first-minute.back")"), "has {measured} in its text"},
            {with(R"("measure": { "quantity": "gamma" }, "title": { "en": "{measured}" })"),
                "/steps/1/title: {\"en\":\"{measured}\"} has a number's place"},
            {with(R"("highlights": [{ "name": { "en": "{measured}" }, "at": [0, 0, 0], "across": 1 }])"),
                "/steps/1/highlights/0/name: {\"en\":\"{measured}\"} has a number's place"},
            {with(R"("ease_s": [1, 1.1])"), "/steps/1/ease_s: [1,1.1] is longer than the step"},
            {with(R"("ease_s": [1, 1], "glide": {})"), "/steps/1/ease_s: "},
            {with(R"("thrust": { "rapidity_per_s": 1, "towards": [0, 0, 0] })"), "points nowhere"},
            {with(R"("try": {}, "question": { )" + question + " }"), "/steps/1/question: "},
            {with(
                 R"("question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "measure": { "quantity": "gamma" }, "reach": { "from": 1, "to": 2 } })"),
                "asks for a place to be reached"},
            {with(
                 R"("question": { "ask": { "en": "?" }, "explanation": { "en": "!" }, "measure": { "quantity": "gamma" }, "choices": [{ "text": { "en": "a" }, "from": 2, "below": 2 }, { "text": { "en": "b" } }] })"),
                "/choices/0: "}})
        EXPECT_NE(message_for(text).find(problem), std::string::npos) << message_for(text);
}

} // namespace tour_file_test
