// Texts that are read aloud are heard to their end: the speech of espeak-ng itself, measured, is shorter than the step in
// which it begins, and a tour that waits for its texts shows the same flight.
#include "config/model/shipped.h"
#include "runtime/visit/read_aloud.h"
#include "runtime/visit/tour_player.h"
#include "runtime/world/open_scene.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>

namespace read_aloud_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

struct Speech {
    double seconds, level_db; ///< of full scale, the root of the mean square
};

/// The speech of espeak-ng, which has Speaker's options here and writes into a file.
Speech spoken(const std::string& text, const std::string& language)
{
    const auto words = write_text("spoken.txt", text), wave = scratch("spoken.wav");
    const std::string command
        = "espeak-ng -v " + language + " -s 150 -w '" + wave.string() + "' -f '" + words.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const std::string bytes = read_text(wave);
    EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWAVE");
    std::uint32_t rate = 0;
    std::memcpy(&rate, bytes.data() + 24, 4);
    const std::size_t samples = (bytes.size() - 44) / 2;
    double squares = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        std::int16_t sample;
        std::memcpy(&sample, bytes.data() + 44 + 2 * i, 2);
        squares += double(sample) * sample;
    }
    return {double(samples) / rate, 10 * std::log10(squares / double(samples)) - 20 * std::log10(32768.0)};
}

std::vector<std::string> tours()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "config/tours"))
        names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

} // namespace

TEST(ReadAloud, EachTextOfEachTourIsReadBeforeTheNextBegins)
{
    double quietest = 0, loudest = -100;
    int texts = 0, cut_before = 0;
    for (const std::string language : {"en", "de"})
        for (const std::string& name : tours()) {
            const Tour silent = tour_in(name, words_in(language)), tour = paced_to_be_read(silent);
            for (std::size_t i = 0; i < tour.steps.size(); ++i) {
                const Step& step = tour.steps[i];
                std::vector<std::pair<std::string, double>> all{{text_to_read(step), step.seconds}};
                if (step.question) {
                    all[0].second = std::min(step.seconds, step.question->unattended_s);
                    all.emplace_back(words_in(language)("touring.wrong") + " "
                            + filled(step.question->explanation, {{"measured", "12.34"}}),
                        step.question->explanation_s);
                }
                for (const auto& [text, seconds] : all) {
                    if (text.empty() || (++texts % 4 != 0 && !all_cases()))
                        continue;
                    const Speech speech = spoken(text, language);
                    EXPECT_LT(speech.seconds, seconds) << name << " " << language << " step " << i << ": " << text;
                    // An estimate that is far too long would make visitors wait.
                    EXPECT_GT(speech.seconds + 4, reading_s(text) * 0.8) << text;
                    cut_before += &text == &all[0].first && speech.seconds > silent.steps[i].seconds;
                    quietest = std::min(quietest, speech.level_db), loudest = std::max(loudest, speech.level_db);
                }
            }
        }
    EXPECT_GT(texts, 150);
    EXPECT_GT(cut_before, 10); // without the pace many steps were too short
    // One loudness in both languages: nobody has to turn it.
    EXPECT_LT(loudest - quietest, 4) << quietest << " " << loudest;
    std::printf("%d texts, %d longer than their steps without the pace; %.1f to %.1f dB of full scale\n", texts, cut_before,
        quietest, loudest);
}

// A character that a voice leaves out or spells would be no word.
TEST(ReadAloud, HasNothingThatAVoiceCannotSay)
{
    for (const std::string language : {"en", "de"})
        for (const std::string& name : tours())
            for (const Step& step : tour_in(name, words_in(language)).steps)
                for (const std::string& text :
                    {text_to_read(step), step.question ? step.question->explanation : std::string()})
                    for (const char* mark :
                        {"γ", "β", "τ", "°", "→", "←", "·", "×", "²", "½", "%", "/", "=", "<", ">", "_", "…"})
                        EXPECT_EQ(text.find(mark), std::string::npos) << mark << " in " << text;
}

TEST(ReadAloud, JoinsTextsAsSentences)
{
    EXPECT_EQ(sentences({"", "One", "Two!", "", "Three?"}), "One. Two! Three?");
    EXPECT_EQ(sentences({}), "");
    EXPECT_EQ(reading_s(""), 0);
    // Figures take longer than letters, and a letter of two bytes as long as one of one.
    EXPECT_GT(reading_s("1234"), reading_s("abcd"));
    EXPECT_DOUBLE_EQ(reading_s("Größe"), reading_s("Grade"));
}

// The flight at each part of each step is that of the silent tour: place, velocity and the ship's clock.
TEST(ReadAloud, AWaitingTourShowsTheSameFlight)
{
    for (const std::string& name : tours()) {
        const Tour silent = tour_in(name, words_in("en")), tour = paced_to_be_read(silent);
        const double unit_s = open_scene(scene_of(silent)).seconds_per_time_unit();
        TourPlayer as_written(silent, {}, unit_s, {.visitors = false}),
            read(silent, {}, unit_s, {.visitors = false, .read_aloud = true});
        for (std::size_t i = 0; i < tour.steps.size(); ++i) {
            if (std::holds_alternative<Try>(tour.steps[i].motion) || tour.steps[i].question)
                continue;
            for (const TourPlayer* which : {&as_written, &read})
                ASSERT_LE(which->step(), i) << name;
            const auto at_part_of = [&](TourPlayer& player, double part) {
                while (player.step() < i && !player.over())
                    player.advance({}, std::int64_t(1e6));
                const double seconds = player.steps()[i].seconds;
                player.advance({}, std::llround(1e9 * (player.left_s() - (1 - part) * seconds)));
                return player.flight().ship;
            };
            for (const double part : {0.3, 0.9}) {
                const Ship a = at_part_of(as_written, part), b = at_part_of(read, part);
                ASSERT_EQ(as_written.step(), i);
                ASSERT_EQ(read.step(), i);
                const double size = 1 + glm::length(a.position.total()) + std::abs(a.time.total());
                EXPECT_LT(glm::distance(a.position.total(), b.position.total()), 1e-7 * size) << name << " step " << i;
                EXPECT_LT(glm::distance(a.u.total(), b.u.total()), 1e-7 * (1 + glm::length(a.u.total()))) << name << i;
                EXPECT_LT(std::abs(a.time.total() - b.time.total()), 1e-7 * size) << name << " step " << i;
            }
        }
    }
}

// Another language takes another time: the part of the step that is over stays, and the ship where it is.
TEST(ReadAloud, AnotherLanguageLeavesTheShipWhereItIs)
{
    const Tour english = tour_in("first-minute", words_in("en")), german = tour_in("first-minute", words_in("de"));
    TourPlayer player(english, {}, open_scene(scene_of(english)).seconds_per_time_unit(), {.read_aloud = true});
    for (int frame = 0; frame < 1000 && player.step() < 1; ++frame)
        player.advance({}, 50'000'000);
    for (int frame = 0; frame < 60; ++frame)
        player.advance({}, 50'000'000);
    ASSERT_EQ(player.step(), 1u);
    const double before_s = player.steps()[1].seconds;
    const Ship before = player.flight().ship;
    player.reword(german);
    EXPECT_NE(player.steps()[1].seconds, before_s);
    player.advance({}, 1);
    EXPECT_LT(glm::distance(player.flight().ship.position.total(), before.position.total()), 1e-6);
    EXPECT_LT(glm::distance(player.flight().ship.u.total(), before.u.total()), 1e-6);
}

} // namespace read_aloud_test
