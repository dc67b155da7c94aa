#include "exhibit_state.h"

namespace starbow {

bool apply(Effects& effects, const Command& command)
{
    if (command.kind == CommandKind::effect)
        effects.on.set(command.effect, command.on);
    else if (command.kind == CommandKind::comparison)
        effects.comparison = comparison_named(command.text);
    else
        return false;
    return true;
}

ExhibitState after(ExhibitState state, const Command& command)
{
    if (apply(state.effects, command))
        return state;
    for (const SwitchedState& one : switched_states)
        if (one.kind == command.kind)
            state.*one.member = command.on;
    switch (command.kind) {
    case CommandKind::information:
        state.information = information_named(command.text);
        break;
    case CommandKind::beside:
        state.beside = beside_named(command.text);
        break;
    case CommandKind::speed_limit:
        state.max_gamma = command.number;
        break;
    case CommandKind::exposure:
        state.exposure_ev = command.number;
        break;
    case CommandKind::language:
        state.language = command.text;
        break;
    case CommandKind::caption:
        state.caption = command.text;
        break;
    default:
        break; // it depends on the exhibit
    }
    return state;
}

} // namespace starbow
