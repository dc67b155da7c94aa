#include "choices.h"
#include <algorithm>

namespace starbow {
namespace {

struct SwitchedChoice {
    CommandKind kind;
    bool Choices::*member;
};
constexpr SwitchedChoice switched_choices[]{{CommandKind::range, &Choices::range},
    {CommandKind::sky_names, &Choices::sky_names}, {CommandKind::filter, &Choices::filter},
    {CommandKind::one_button, &Choices::one_button}, {CommandKind::left_handed, &Choices::left_handed}};

/// The choice that a command switches; null: none.
const SwitchedChoice* switched_by(CommandKind kind)
{
    const auto found = std::ranges::find(switched_choices, kind, &SwitchedChoice::kind);
    return found == std::end(switched_choices) ? nullptr : found;
}

} // namespace

bool switches_choice(CommandKind kind) { return switched_by(kind) != nullptr; }

bool apply(Choices& choices, const Command& command)
{
    switch (command.kind) {
    case CommandKind::language:
        choices.language = command.text;
        return true;
    case CommandKind::information:
        choices.information = information_named(command.text);
        return true;
    case CommandKind::inset:
        choices.inset = inset_view_named(command.text);
        return true;
    default:
        break;
    }
    const SwitchedChoice* const switched = switched_by(command.kind);
    if (switched)
        choices.*switched->member = command.on;
    return switched != nullptr;
}

void apply(Choices& choices, Switches pressed)
{
    choices.range ^= pressed[Switch::range];
    choices.filter ^= pressed[Switch::filter];
    choices.sky_names ^= pressed[Switch::sky_names];
    if (pressed[Switch::information])
        choices.information = after(choices.information);
    if (pressed[Switch::inset])
        choices.inset = after(choices.inset);
}

} // namespace starbow
