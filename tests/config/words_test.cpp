// Every language has the same texts with the same placeholders, and no text is unused.
#include "config/model/effects.h"
#include "config/model/shipped.h"
#include "config/model/words.h"
#include "input/command.h"
#include "input/exhibit_state.h"
#include "tests/support/files.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace words_test {

using namespace starbow;
using namespace starbow::testing;
using nlohmann::json;

namespace {

/// The message for a shipped language's file after a change.
std::string message_after(const std::function<void(json&)>& change)
{
    json texts = json::parse(read_text(source_dir() / "config/words/en.json"), nullptr, true, true);
    change(texts);
    const std::filesystem::path file = write_text("words.json", texts.dump(1));
    return complaint([&] { load_words(file); });
}

} // namespace

TEST(Words, LanguagesHaveTheSameKeysAndPlaceholders)
{
    const Words& english = words("en");
    int languages = 0;
    for (const auto& file : shipped("config/words")) {
        SCOPED_TRACE(file.filename().string());
        const Words other = load_words(file);
        EXPECT_EQ(other.language, file.stem().string());
        for (const auto& [key, text] : english.texts) {
            const auto found = other.texts.find(key);
            ASSERT_NE(found, other.texts.end()) << key;
            auto holes = placeholders(text), others = placeholders(found->second);
            std::sort(holes.begin(), holes.end()), std::sort(others.begin(), others.end());
            EXPECT_EQ(holes, others) << key;
        }
        for (const auto& [key, text] : other.texts)
            EXPECT_TRUE(english.texts.contains(key)) << key;
        ++languages;
    }
    EXPECT_GE(languages, 2);
}

/// The sources and the remote's page name every key of the languages' files, except tours' texts, goals'
/// (tests/flight/goals_test.cpp), the insets', effects, modes of flight and the decimal sign.
TEST(Words, EveryKeyIsUsedInTheSources)
{
    std::string sources;
    for (const char* folder : {"runtime", "config/remote"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() / folder))
            if (entry.is_regular_file())
                sources += read_text(entry.path());
    for (const auto& [key, text] : words().texts) {
        const bool elsewhere = key.starts_with("tour.") || key.starts_with("goal.") || key.starts_with("inset.")
            || key.starts_with("flight.") || key.starts_with("name.") || key == "decimal_sign"
            || std::ranges::any_of(doing_names, [&](const char* doing) { return key == std::string("does.") + doing; });
        const bool of_effect = std::ranges::any_of(
            all_effects, [&](const EffectEntry& one) { return key.substr(key.find('.') + 1) == one.name; });
        EXPECT_TRUE(elsewhere || of_effect || sources.find(std::string("\"").append(key).append("\"")) != sources.npos)
            << key;
    }
}

/// Worlds, tours and views have one name each in every language, and no two of a kind have the same.
TEST(Words, EveryWorldTourAndViewHasAName)
{
    for (const std::string& language : shipped_names("words")) {
        const Words all = words_in(language);
        std::size_t named = 0;
        for (const auto& [kind, folder] : {std::pair{"scene", "scenes"}, {"tour", "tours"}, {"shot", "shots"}}) {
            std::set<std::string> names;
            for (const std::string& name : shipped_names(folder)) {
                EXPECT_TRUE(all.texts.contains(std::string("name.") + kind + "." + name))
                    << language << ": " << kind << " " << name;
                EXPECT_TRUE(names.insert(all.title(kind, name)).second) << all.title(kind, name) << " is the name of two";
            }
            named += names.size();
        }
        const auto known = std::ranges::count_if(all.texts, [](const auto& one) { return one.first.starts_with("name."); });
        EXPECT_EQ(std::size_t(known), named) << language << " names files that are not there";
    }
    EXPECT_EQ(words().title("scene", "a-sites-own"), "a-sites-own");
}

/// A speed in a view's name is its shot's, to the digits that the name gives.
TEST(Words, TheSpeedInAViewsNameIsItsShots)
{
    int speeds = 0;
    for (const std::string& language : shipped_names("words"))
        for (const std::string& name : shipped_names("shots")) {
            const std::string title = words_in(language).title("shot", name);
            std::smatch found;
            if (!std::regex_search(title, found, std::regex("0[.,]([0-9]+) c")))
                continue;
            ++speeds;
            const glm::dvec3 u = load_shot(shipped_file("shots", name)).u;
            const double beta = glm::length(u) / std::sqrt(1 + glm::dot(u, u)),
                         unit = std::pow(10, -double(found[1].length()));
            EXPECT_NEAR(std::stod(found[1]) * unit, beta, 0.5 * unit + 1e-9) << title;
        }
    EXPECT_GE(speeds, 20);
}

/// Every key that the sources name exists: that is, every text of the form of a key with a known first part.
TEST(Words, EveryKeyInTheSourcesExists)
{
    std::set<std::string> kinds;
    for (const auto& [key, text] : words().texts)
        if (const std::size_t dot = key.find('.'); dot != key.npos)
            kinds.insert(key.substr(0, dot));
    const std::regex quoted("\"([a-z]+)\\.([a-z_]+)\"");
    int count = 0;
    for (const char* folder : {"runtime", "config/remote"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() / folder)) {
            const std::string source = entry.is_regular_file() ? read_text(entry.path()) : "";
            for (std::sregex_iterator at(source.begin(), source.end(), quoted), end; at != end; ++at)
                if (kinds.contains((*at)[1]) && (*at)[2] != "json" && (*at)[2] != "h") {
                    EXPECT_TRUE(words().texts.contains((*at)[1].str() + "." + (*at)[2].str()))
                        << at->str() << " in " << entry;
                    ++count;
                }
        }
    EXPECT_GT(count, 120);
}

/// The remote's page makes a button for each command that switches something, and takes its word by the command's name.
TEST(Words, EverySwitchOfTheRemoteHasAWord)
{
    for (const CommandRule& rule : command_rules()) {
        std::string name(rule.name);
        std::ranges::replace(name, '-', '_');
        EXPECT_TRUE(rule.value != CommandValue::on || words().texts.contains("remote." + name)) << name;
    }
}

TEST(Words, WrongFilesAreRefused)
{
    EXPECT_NE(message_after([](json& t) { t.erase("hud.ship"); }).find("lacks \"hud.ship\""), std::string::npos);
    EXPECT_NE(message_after([](json& t) {
        t["hud.shop"] = "x";
    }).find("/hud.shop: \"x\" stands under an unknown name; \"hud.ship\""),
        std::string::npos);
    EXPECT_NE(message_after([](json& t) { t["tutorial.stop_button"] = "Press it"; })
                  .find("/tutorial.stop_button: \"Press it\" has other placeholders than this text needs; a text with "
                        "{button} is right"),
        std::string::npos);
    EXPECT_NE(
        message_after([](json& t) { t["hud.ship"] = "the {ship}"; }).find("a text with no { } is right"), std::string::npos);
    EXPECT_NE(message_after([](json& t) { t["hud.ship"] = 3; }).find("is not a text"), std::string::npos);
    EXPECT_NE(message_after([](json& t) { t = json::array(); }).find("is not an object"), std::string::npos);
}

TEST(Words, PlaceholdersAreFilled)
{
    EXPECT_EQ(filled("{a} and {b}, {a}", {{"a", "one"}, {"b", "2"}}), "one and 2, one");
    EXPECT_EQ(filled("nothing", {{"a", "1"}}), "nothing");
    EXPECT_EQ(placeholders("{number} of {all}"), (std::vector<std::string>{"number", "all"}));
    EXPECT_EQ(words("de").number("-3.25"), "-3,25");
    EXPECT_EQ(words()("tutorial.stop_button", {{"button", "7"}}), "Press button 7: full stop");
}

} // namespace words_test
