#include "command.h"
#include "config/json/error.h"
#include "config/json/reader.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace starbow {
namespace {

using enum CommandKind;
using Value = CommandValue;

/// Steps of one move: half the width of a picture by its corner's handle.
constexpr double most_move = 2000;

constexpr std::array kinds{CommandRule{fade, "fade", Role::docent, Value::on},
    CommandRule{stop, "stop", Role::docent, Value::none}, CommandRule{reset, "reset", Role::docent, Value::none},
    CommandRule{tour, "tour", Role::docent, Value::name}, CommandRule{next, "next", Role::docent, Value::none},
    CommandRule{back, "back", Role::docent, Value::none}, CommandRule{pause, "pause", Role::docent, Value::on},
    CommandRule{scene, "scene", Role::docent, Value::name}, CommandRule{shot, "shot", Role::docent, Value::name},
    CommandRule{speed_limit, "speed-limit", Role::docent, Value::number, {1, 1e6, true}},
    CommandRule{exposure, "exposure", Role::docent, Value::number, {-most_exposure_ev, most_exposure_ev}},
    CommandRule{range, "range", Role::docent, Value::on}, CommandRule{sky_names, "sky-names", Role::docent, Value::on},
    CommandRule{filter, "filter", Role::docent, Value::on}, CommandRule{slow_motion, "slow-motion", Role::docent, Value::on},
    CommandRule{one_button, "one-button", Role::docent, Value::on},
    CommandRule{left_handed, "left-handed", Role::docent, Value::on},
    CommandRule{comparison, "comparison", Role::docent, Value::name},
    CommandRule{inset, "beside", Role::docent, Value::name},
    CommandRule{information, "information", Role::docent, Value::name},
    CommandRule{language, "language", Role::docent, Value::name}, CommandRule{caption, "caption", Role::docent, Value::text},
    CommandRule{hold, "hold", Role::docent, Value::on},
    CommandRule{pointer, "pointer", Role::docent, Value::place, {-180, 180}, {}, {-90, 90}},
    CommandRule{touch, "touch", Role::docent, Value::place, {0, 1}, {}, {0, 1}},
    CommandRule{item, "item", Role::docent, Value::number, {1, 1000}},
    CommandRule{layout, "layout", Role::engineer, Value::name}, CommandRule{pattern, "pattern", Role::engineer, Value::name},
    CommandRule{quality, "quality", Role::engineer, Value::name}, CommandRule{unlock, "unlock", Role::engineer, Value::none},
    CommandRule{grip, "grip", Role::engineer, Value::text},
    CommandRule{move, "move", Role::engineer, Value::place, {-most_move, most_move}, {}, {-most_move, most_move}},
    CommandRule{move_back, "move-back", Role::engineer, Value::none},
    CommandRule{as_saved, "as-saved", Role::engineer, Value::on}, CommandRule{keep, "keep", Role::engineer, Value::none},
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

/// "from -10 to 10", "above 1 up to 1e6".
std::string form_of(const CommandRange& range)
{
    return (range.above ? "above " : "from ") + plain_digits_of(range.least) + (range.above ? " up to " : " to ")
        + plain_digits_of(range.most);
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
        return name + " and a number " + form_of(rule.range)
            + (rule.kind == speed_limit ? ", or a part of light's speed such as 0.97c," : "");
    case Value::place:
        return name + ", a number " + form_of(rule.range) + ", and a number " + form_of(rule.second);
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

/// A number within a range; nullopt for any other text.
std::optional<double> number_in(std::string_view text, const CommandRange& range)
{
    double number = 0;
    const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
    const bool within = range.above ? number > range.least : number >= range.least;
    if (error != std::errc() || end != text.end() || !(within && number <= range.most))
        return {};
    return number;
}

/// A speed limit as gamma: 2.5, or 0.97c.
std::optional<double> limit_in(std::string_view text, const CommandRange& range)
{
    if (!text.ends_with('c'))
        return number_in(text, range);
    const std::optional<double> speed = number_in(text.substr(0, text.size() - 1), {0, 1, true});
    const double gamma = speed ? 1 / std::sqrt((1 - *speed) * (1 + *speed)) : 0;
    return gamma > range.least && gamma <= range.most ? std::optional(gamma) : std::nullopt;
}

} // namespace

double speed_of(double gamma) { return std::sqrt((gamma - 1) * (gamma + 1)) / gamma; }

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
    if (words.size() != (rule->value == Value::none ? 1 : rule->value == Value::place ? 3 : 2))
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
        const auto number = rule->kind == speed_limit ? limit_in(value, rule->range) : number_in(value, rule->range);
        if (!number)
            refuse(*rule, "has the value " + one_line(value, 40));
        command.number = *number;
        break;
    }
    case Value::place: {
        const auto first = number_in(value, rule->range), second = number_in(words[2], rule->second);
        if (!first || !second)
            refuse(*rule, "has the values " + one_line(value, 40) + " and " + one_line(words[2], 40));
        command.number = *first, command.second = *second;
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
    case Value::place:
        words.push_back(digits_of(command.number)), words.push_back(digits_of(command.second));
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
