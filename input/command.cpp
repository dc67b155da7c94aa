#include "command.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include <algorithm>
#include <array>
#include <charconv>

namespace starbow {
namespace {

using enum CommandKind;
using Value = CommandValue;

constexpr std::array kinds{CommandRule{fade, "fade", Role::docent, Value::on},
    CommandRule{stop, "stop", Role::docent, Value::none}, CommandRule{reset, "reset", Role::docent, Value::none},
    CommandRule{tour, "tour", Role::docent, Value::name}, CommandRule{next, "next", Role::docent, Value::none},
    CommandRule{back, "back", Role::docent, Value::none}, CommandRule{pause, "pause", Role::docent, Value::on},
    CommandRule{scene, "scene", Role::docent, Value::name}, CommandRule{shot, "shot", Role::docent, Value::name},
    CommandRule{speed_limit, "speed-limit", Role::docent, Value::number, {1, 1e6, true}},
    CommandRule{exposure, "exposure", Role::docent, Value::number, {-most_exposure_ev, most_exposure_ev}},
    CommandRule{range, "range", Role::docent, Value::on}, CommandRule{slow_motion, "slow-motion", Role::docent, Value::on},
    CommandRule{one_button, "one-button", Role::docent, Value::on},
    CommandRule{left_handed, "left-handed", Role::docent, Value::on},
    CommandRule{comparison, "comparison", Role::docent, Value::name},
    CommandRule{inset, "beside", Role::docent, Value::name},
    CommandRule{information, "information", Role::docent, Value::name},
    CommandRule{language, "language", Role::docent, Value::name}, CommandRule{caption, "caption", Role::docent, Value::text},
    CommandRule{hold, "hold", Role::docent, Value::on}, CommandRule{layout, "layout", Role::engineer, Value::name},
    CommandRule{pattern, "pattern", Role::engineer, Value::name},
    CommandRule{quality, "quality", Role::engineer, Value::name}, CommandRule{unlock, "unlock", Role::engineer, Value::none},
    CommandRule{restart, "restart", Role::engineer, Value::none}};

static_assert(has_each_in_order(kinds, &CommandRule::kind, effect));

/// The shortest digits that mean this number.
std::string digits_of(double number)
{
    std::array<char, 32> digits;
    const auto [end, error] = std::to_chars(digits.begin(), digits.end(), number);
    return std::string(digits.data(), std::size_t(end - digits.data()));
}

/// The same as people write it: 1e6.
std::string plain_digits_of(double number)
{
    std::string digits = digits_of(number);
    if (const std::size_t at = digits.find("e+0"); at != digits.npos)
        digits.replace(at, 3, "e");
    return digits;
}

std::string form_of(const CommandRule& rule)
{
    const std::string name(rule.name);
    switch (rule.value) {
    case Value::none:
        return name + " alone";
    case Value::on:
        return name + " on or " + name + " off";
    case Value::number:
        return name + (rule.range.above ? " and a number above " : " and a number from ") + plain_digits_of(rule.range.least)
            + (rule.range.above ? " up to " : " to ") + plain_digits_of(rule.range.most);
    case Value::name:
        return name + " and a name";
    case Value::text:
        break;
    }
    return name + " and a text of at most " + std::to_string(most_command_text) + " bytes";
}

[[noreturn]] void refuse(const CommandRule& rule, const std::string& problem)
{
    throw InputError("the command " + std::string(rule.name) + " " + problem + "; " + form_of(rule) + " is right");
}

/// Names of shipped files only: letters, digits, -, _ and dots within; NAME.json would be a path. So no command leads to
/// another folder.
bool is_name(std::string_view text)
{
    return !text.empty() && text.size() <= 64 && text.front() != '.' && !text.ends_with(".json")
        && std::ranges::all_of(text, [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_'
                   || c == '.';
           });
}

} // namespace

std::span<const CommandRule> command_rules()
{
    static const std::vector<CommandRule> all = [] {
        static std::array<std::string, all_effects.size()> names;
        std::vector<CommandRule> rules(kinds.begin(), kinds.end());
        for (const EffectEntry& one : all_effects) {
            std::string& name = names[std::size_t(one.which)] = dashed(one.name);
            rules.push_back({.kind = effect, .name = name, .role = Role::docent, .value = Value::on, .effect = one.which});
        }
        return rules;
    }();
    return all;
}

const CommandRule& rule_of(const Command& command)
{
    return command_rules()[std::size_t(command.kind) + (command.kind == effect ? std::size_t(command.effect) : 0)];
}

Command command_of(std::span<const std::string> words)
{
    if (words.empty())
        throw InputError("a command has no name; a name such as stop is right");
    const std::span<const CommandRule> rules = command_rules();
    const auto rule = std::ranges::find(rules, words[0], &CommandRule::name);
    if (rule == rules.end()) {
        std::string all;
        for (const CommandRule& known : rules)
            all += (all.empty() ? "" : ", ") + std::string(known.name);
        throw InputError("the command " + one_line(words[0], 40) + " is not known; one of these is right: " + all);
    }
    if (words.size() != (rule->value == Value::none ? 1 : 2))
        refuse(*rule, "has " + std::to_string(words.size() - 1) + " values");
    Command command{.kind = rule->kind, .effect = rule->effect};
    const std::string value = words.size() > 1 ? words[1] : "";
    switch (rule->value) {
    case Value::none:
        break;
    case Value::on:
        if (value != "on" && value != "off")
            refuse(*rule, "has the value " + one_line(value, 40));
        command.on = value == "on";
        break;
    case Value::number: {
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), command.number);
        const CommandRange& range = rule->range;
        const bool within = range.above ? command.number > range.least : command.number >= range.least;
        if (error != std::errc() || end != value.data() + value.size() || !(within && command.number <= range.most))
            refuse(*rule, "has the value " + one_line(value, 40));
        break;
    }
    case Value::name:
        if (!is_name(value))
            refuse(*rule, "has the value " + one_line(value, 40) + ", which is not a name of a shipped file");
        command.text = value;
        break;
    case Value::text:
        if (value.size() > most_command_text)
            refuse(*rule, "has a text of " + std::to_string(value.size()) + " bytes");
        command.text = one_line(value, most_command_text);
        break;
    }
    return command;
}

std::vector<std::string> words_of(const Command& command)
{
    const CommandRule& rule = rule_of(command);
    std::vector<std::string> words{std::string(rule.name)};
    switch (rule.value) {
    case Value::none:
        break;
    case Value::on:
        words.emplace_back(command.on ? "on" : "off");
        break;
    case Value::number:
        words.push_back(digits_of(command.number));
        break;
    case Value::name:
    case Value::text:
        words.push_back(command.text);
        break;
    }
    return words;
}

std::string text_of(const Command& command)
{
    std::string line;
    for (const std::string& word : words_of(command))
        line += (line.empty() ? "" : " ") + word;
    return line;
}

} // namespace starbow
