// Programmes of shows: the shipped one in every language, and wrong files.
#include "config/model/programme_file.h"
#include "config/model/shipped.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>

namespace programme_file_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

std::string refusal(const std::string& items)
{
    return complaint([&] { load_programme(write_text("show.json", R"({ "items": [)" + items + "] }")); });
}

} // namespace

TEST(ProgrammeFile, TheShippedOneHasNotesInEveryLanguageAndShowsWhatIsThere)
{
    const Programme programme = load_programme(shipped_file("programmes", "evening"));
    ASSERT_EQ(programme.items.size(), 6u);
    double minutes = 0;
    for (const ProgrammeItem& item : programme.items) {
        const auto& [kind, name] = shown_by(item);
        EXPECT_NO_THROW(shipped_file(kind + "s", name)) << name;
        for (const std::string& language : shipped_names("words"))
            EXPECT_TRUE(item.notes.texts.contains(language)) << name << ": " << language;
        minutes += item.minutes;
    }
    EXPECT_EQ(minutes, 30); // its comment says half an hour
    EXPECT_EQ(shown_by(programme.items[1]), (std::pair<std::string, std::string>("tour", "first-minute")));
}

TEST(ProgrammeFile, WrongItemsAreRefusedWithTheirPlace)
{
    const std::vector<std::pair<std::string, std::string>> wrong{
        {R"({ "tour": "rainbow", "scene": "avenue", "minutes": 3 })", "/items/0"},
        {R"({ "minutes": 3 })", "exactly one of \"tour\", \"scene\" and \"shot\" is right"},
        {R"({ "tour": "rainbow" })", "lacks \"minutes\""}, {R"({ "tour": "rainbow", "minutes": 0 })", "/items/0/minutes"},
        {R"({ "tour": "rainbows", "minutes": 3 })", "is not among the shipped tours; one of these is right: aurora, first-minute, "},
        {R"({ "shot": "../earth", "minutes": 3 })", "is not among the shipped shots"},
        {R"({ "tour": "rainbow", "minutes": 3, "notes": "Welcome" })", "is not an object; { \"en\": \"...\""},
        {R"({ "tour": "rainbow", "minutes": 3, "note": { "en": "Welcome" } })", "stands under an unknown name; \"notes\""},
        {"", "/items"}};
    for (const auto& [items, says] : wrong) {
        const std::string message = refusal(items);
        EXPECT_NE(message.find(says), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    EXPECT_NO_THROW(load_programme(
        write_text("show.json", R"({ "items": [{ "tour": "rainbow", "minutes": 2.5, "notes": { "en": "Welcome" } }] })")));
}

} // namespace programme_file_test
