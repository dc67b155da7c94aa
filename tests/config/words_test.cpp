// Every language has the same texts with the same placeholders, and no text is unused.
#include "config/model/effects.h"
#include "config/model/words.h"
#include "input/command.h"
#include "tests/support/files.h"
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
            || key.starts_with("flight.") || key.starts_with("menu.scene.") || key.starts_with("menu.tour.")
            || key == "decimal_sign";
        const bool of_effect = std::ranges::any_of(
            all_effects, [&](const EffectEntry& one) { return key.substr(key.find('.') + 1) == one.name; });
        EXPECT_TRUE(elsewhere || of_effect || sources.find(std::string("\"").append(key).append("\"")) != sources.npos)
            << key;
    }
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
