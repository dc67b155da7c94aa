// Commands to a running exhibit: every kind goes through its words and back, and wrong words are refused with the right
// form.
#include "input/command.h"
#include "tests/support/files.h"

namespace command_test {

using namespace starbow;
using namespace starbow::testing;

namespace {

Command read(std::vector<std::string> words) { return command_of(words); }

Command effect_command(Effect which, bool on) { return {.kind = CommandKind::effect, .on = on, .effect = which}; }

} // namespace

TEST(Command, EveryKindComesBackFromItsWords)
{
    // A list of its own: what a docent types, and the command that is meant.
    const std::vector<std::pair<std::vector<std::string>, Command>> typed{{{"fade", "on"}, {CommandKind::fade, true}},
        {{"stop"}, {CommandKind::stop}}, {{"reset"}, {CommandKind::reset}},
        {{"tour", "twins"}, {CommandKind::tour, false, 0, "twins"}}, {{"next"}, {CommandKind::next}},
        {{"back"}, {CommandKind::back}}, {{"pause", "off"}, {CommandKind::pause}},
        {{"scene", "warm-wall"}, {CommandKind::scene, false, 0, "warm-wall"}},
        {{"shot", "chart-0.5"}, {CommandKind::shot, false, 0, "chart-0.5"}},
        {{"speed-limit", "2.5"}, {CommandKind::speed_limit, false, 2.5}},
        {{"aberration", "off"}, effect_command(Effect::aberration, false)},
        {{"doppler", "on"}, effect_command(Effect::doppler, true)},
        {{"headlight", "on"}, effect_command(Effect::headlight, true)},
        {{"false-colours", "on"}, effect_command(Effect::false_colours, true)},
        {{"unlock"}, {CommandKind::unlock, false, 0, ""}},
        {{"grip", "left, upper left corner"}, {CommandKind::grip, false, 0, "left, upper left corner"}},
        {{"move", "-3", "10"}, {.kind = CommandKind::move, .number = -3, .second = 10}},
        {{"move-back"}, {CommandKind::move_back}}, {{"as-saved", "on"}, {CommandKind::as_saved, true}},
        {{"keep"}, {CommandKind::keep}}, {{"beside", "at-rest"}, {CommandKind::inset, false, 0, "at-rest"}},
        {{"information", "guide"}, {CommandKind::information, false, 0, "guide"}},
        {{"exposure", "-1.5"}, {CommandKind::exposure, false, -1.5}}, {{"range", "on"}, {CommandKind::range, true, 0, ""}},
        {{"sky-names", "on"}, {CommandKind::sky_names, true, 0, ""}}, {{"filter", "on"}, {CommandKind::filter, true, 0, ""}},
        {{"slow-motion", "on"}, {CommandKind::slow_motion, true, 0, ""}},
        {{"one-button", "on"}, {CommandKind::one_button, true, 0, ""}},
        {{"left-handed", "off"}, {CommandKind::left_handed, false, 0, ""}},
        {{"comparison", "galilean"}, {CommandKind::comparison, false, 0, "galilean"}},
        {{"language", "de"}, {CommandKind::language, false, 0, "de"}},
        {{"caption", "Grüße an alle: γ = 4"}, {CommandKind::caption, false, 0, "Grüße an alle: γ = 4"}},
        {{"caption", ""}, {CommandKind::caption}}, {{"hold", "on"}, {CommandKind::hold, true}},
        {{"pointer", "-120.5", "30"}, {.kind = CommandKind::pointer, .number = -120.5, .second = 30}},
        {{"touch", "0.25", "1"}, {.kind = CommandKind::touch, .number = 0.25, .second = 1}},
        {{"item", "3"}, {.kind = CommandKind::item, .number = 3}},
        {{"layout", "dome"}, {CommandKind::layout, false, 0, "dome"}},
        {{"pattern", "grid"}, {CommandKind::pattern, false, 0, "grid"}},
        {{"quality", "fine"}, {CommandKind::quality, false, 0, "fine"}}, {{"restart"}, {CommandKind::restart}}};
    std::vector<bool> met(command_rules().size());
    for (const auto& [words, command] : typed) {
        EXPECT_EQ(read(words), command) << words[0];
        EXPECT_EQ(words_of(command), words);
        met[std::size_t(&rule_of(command) - command_rules().data())] = true;
    }
    for (std::size_t i = 0; i < met.size(); ++i)
        EXPECT_TRUE(met[i]) << command_rules()[i].name << " has no case here";
}

TEST(Command, WrongWordsAreRefusedWithTheRightForm)
{
    const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{{{}, "a name such as stop is right"},
        {{"warp", "9"}, "is not known"}, {{"stop", "now"}, "stop alone is right"},
        {{"fade"}, "fade on or fade off is right"}, {{"fade", "yes"}, "fade on or fade off is right"},
        {{"doppler", "on", "off"}, "doppler on or doppler off"}, {{"speed-limit", "1"}, "a number above 1 up to 1e6"},
        {{"exposure", "10.5"}, "exposure and a number from -10 to 10"}, {{"exposure", "nan"}, "from -10 to 10"},
        {{"speed-limit", "nan"}, "a number above 1"}, {{"speed-limit", "inf"}, "a number above 1"},
        {{"speed-limit", "2,5"}, "a number above 1"}, {{"scene", "../../etc/passwd"}, "scene and a name is right"},
        {{"scene", "/etc/passwd"}, "is not a name"}, {{"layout", "..."}, "is not a name"},
        {{"layout", ".json"}, "is not a name"}, {{"scene", std::string(65, 'a')}, "is not a name"},
        {{"caption", std::string(401, 'a')}, "at most 400 bytes"},
        {{"pointer", "30"}, "and a number from -90 to 90 is right"}, {{"pointer", "181", "0"}, "a number from -180 to 180"},
        {{"pointer", "0", "nan"}, "has the values 0 and nan"}, {{"touch", "0.5", "-0.1"}, "a number from 0 to 1"},
        {{"item", "0"}, "a number from 1 to 1000"}, {{"speed-limit", "1c"}, "such as 0.97c, is right"},
        {{"speed-limit", "0c"}, "such as 0.97c"}, {{"speed-limit", "0.97 c"}, "such as 0.97c"},
        {{"exposure", "0.5c"}, "exposure and a number from -10 to 10"}};
    for (const auto& [words, says] : wrong) {
        const std::string message = complaint([&] { read(words); });
        EXPECT_NE(message.find(says), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

/// beta = 3/5, 4/5 and 12/13 have the rational gammas 5/4, 5/3 and 13/5.
TEST(Command, ASpeedLimitMayBeAPartOfLightsSpeed)
{
    for (const auto& [text, gamma] : {std::pair{"0.6c", 5.0 / 4}, {"0.8c", 5.0 / 3}, {"0.9230769230769231c", 13.0 / 5}}) {
        EXPECT_NEAR(read({"speed-limit", text}).number, gamma, 1e-12);
        EXPECT_NEAR(speed_of(gamma), std::stod(text), 1e-12);
    }
}

TEST(Command, ACaptionHasNoControlCharacters)
{
    const Command command = read({"caption", "a\x1b[31mb\nc"});
    for (const unsigned char c : command.text)
        EXPECT_GE(c, 0x20);
}

TEST(Command, OnlyAnEngineerChangesDisplaysAndTheProgram)
{
    for (const CommandRule& rule : command_rules()) {
        const bool engineers = rule.name == "layout" || rule.name == "pattern" || rule.name == "quality"
            || rule.name == "unlock" || rule.name == "restart" || rule.name == "grip" || rule.name == "move"
            || rule.name == "move-back" || rule.name == "as-saved" || rule.name == "keep";
        EXPECT_EQ(rule.role, engineers ? Role::engineer : Role::docent) << rule.name;
    }
}

} // namespace command_test
