#pragma once
#include "enum_set.h"
#include "switches.h"
#include <array>
#include <string_view>

namespace starbow {

/// The effects' switches, as in the paper "Real Time Relativity". Without aberration directions are the world's, without
/// Doppler colours are as at rest, without headlight there is no D^3.
enum class Effect : std::uint8_t {
    aberration,
    doppler,
    headlight,
    false_colours, ///< infrared as red, the visible as green, ultraviolet as blue
    count
};
using EffectSet = EnumSet<Effect>;

struct EffectEntry {
    Effect which;
    std::string_view name; ///< in files; a command has - for _, keys of words the name itself after hud., menu., remote.
    Switch pressed; ///< turns it on and off
    bool usual; ///< on where nothing else is said; the display and the visitors' menu name those, the others are a guide's
    char letter; ///< in the guide's window
    const char* says; ///< in the schema
};
/// Every effect once. Files, records, machines, remotes, the menu and the display loop over them.
inline constexpr std::array all_effects{
    EffectEntry{Effect::aberration, "aberration", Switch::aberration, true, 'A',
        "true: directions are those that the observer sees; false: the world's."},
    EffectEntry{
        Effect::doppler, "doppler", Switch::doppler, true, 'D', "true: colours are shifted; false: they are as at rest."},
    EffectEntry{Effect::headlight, "headlight", Switch::headlight, true, 'E',
        "true: the light ahead is concentrated, by the cube of the Doppler factor."},
    EffectEntry{Effect::false_colours, "false_colours", Switch::false_colours, false, 'F',
        "true: infrared is shown as red, the visible as green, ultraviolet as blue."},
};
static_assert(has_each_in_order(all_effects, &EffectEntry::which, Effect::count), "a new effect belongs in the list above");

constexpr const EffectEntry& entry_of(Effect which) { return all_effects[std::size_t(which)]; }
inline constexpr EffectSet usual_effects = [] {
    EffectSet usual;
    for (const EffectEntry& one : all_effects)
        usual.set(one.which, one.usual);
    return usual;
}();

/// The effects of a list such as "aberration,headlight"; "none": none. Throws InputError for an unknown name.
EffectSet effects_named(std::string_view list);

/// The comparisons: velocities that simply add, or everything at the ship's present, as if light came at once.
enum class Comparison { none, galilean, no_light_delay };
constexpr std::array<const char*, 3> comparison_names = {"none", "galilean", "no-light-delay"};
constexpr Comparison after(Comparison comparison)
{
    return Comparison((std::size_t(comparison) + 1) % comparison_names.size());
}
/// Throws InputError for an unknown name.
Comparison comparison_named(std::string_view name);

/// The effects that a picture shows.
struct Effects {
    EffectSet on = usual_effects;
    Comparison comparison = Comparison::none;

    constexpr bool operator[](Effect one) const { return on[one]; }
    /// The same with one effect, and without one.
    constexpr Effects with(Effect one) const { return {on | EffectSet{one}, comparison}; }
    constexpr Effects without(Effect one) const { return {on - EffectSet{one}, comparison}; }
};

} // namespace starbow
