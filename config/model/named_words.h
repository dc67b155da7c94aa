#pragma once
#include "flying.h"
#include "information.h"
#include "inset_view.h"
#include "words.h"

namespace starbow {

// The texts of values that have names.

/// The texts of the effects by their names, and of those alone that are usual.
consteval std::array<Key, all_effects.size()> keys_of_effects(std::string_view prefix, bool usual_alone = false)
{
    std::array<Key, all_effects.size()> keys;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (all_effects[i].usual || !usual_alone)
            keys[i] = Key(prefix, all_effects[i].name);
    return keys;
}
consteval auto keys_of_usual_effects(std::string_view prefix) { return keys_of_effects(prefix, true); }
inline constexpr auto inset_view_words = keys_of("inset.", inset_view_names);
inline constexpr auto display_words = keys_of("remote.display.", information_names);
inline constexpr auto mode_words = keys_of("flight.", flight_mode_names);

} // namespace starbow
