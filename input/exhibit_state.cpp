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
    if (apply(state.effects, command) || apply(static_cast<Choices&>(state), command))
        return state;
    for (const SwitchedState& one : switched_states)
        if (one.kind == command.kind)
            state.*one.member = command.on;
    if (command.kind == CommandKind::speed_limit)
        state.max_gamma = command.number;
    else if (command.kind == CommandKind::exposure)
        state.exposure_ev = command.number;
    else if (command.kind == CommandKind::item)
        state.item = int(command.number), state.item_s = 0;
    else if (command.kind == CommandKind::caption)
        state.caption = command.text;
    return state; // anything else depends on the exhibit
}

} // namespace starbow
