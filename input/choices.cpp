#include "choices.h"

namespace starbow {

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
    case CommandKind::range:
        choices.range = command.on;
        return true;
    case CommandKind::sky_names:
        choices.sky_names = command.on;
        return true;
    case CommandKind::one_button:
        choices.one_button = command.on;
        return true;
    case CommandKind::left_handed:
        choices.left_handed = command.on;
        return true;
    default:
        return false;
    }
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
