#pragma once
#include "config/json/describe.h"
#include "goal.h"
#include "shot_reader.h"

namespace starbow {

// Shots, measures and goals, as config/json/describe.h says.

inline const std::vector<std::pair<std::string_view, Comparison>> comparisons{{comparison_names[0], Comparison::none},
    {comparison_names[1], Comparison::galilean}, {comparison_names[2], Comparison::no_light_delay}};
/// An effect that is shown or not.
template <Effect which> struct Shows {
    void read_into(const Place& place, Effects& effects, const Folder&) const { effects.on.set(which, boolean(place)); }
    Json written(const EffectSet& on) const { return on[which]; }
    Json schema(Json& definitions) const { return Flag{}.schema(definitions); }
};
template <Effect which> constexpr auto effect_field()
{
    const EffectEntry& one = entry_of(which);
    if constexpr (which == Effect{})
        return field(one.name.data(), Shows<which>{}, one.says, &Effects::on);
    else
        return again(one.name.data(), Shows<which>{}, one.says, &Effects::on);
}
template <> inline constexpr auto description<Effects> = []<std::size_t... i>(std::index_sequence<i...>)
{
    return describe<Effects>("effects", "The effects of relativity that are shown.", effect_field<Effect(i)>()...,
        field("comparison", Named{&comparisons},
            "Another world to compare with: galilean, where velocities simply add; no-light-delay, where light comes at "
            "once.",
            &Effects::comparison));
}
(std::make_index_sequence<all_effects.size()>());
static_assert(is_complete<Effects>());

/// A direction of any length above 0, as a unit vector.
struct UnitDirection {
    glm::dvec3 read(const Place& place, const Folder&) const { return unit_direction(place); }
    Json schema(Json&) const;
};
/// The same, which `check` reads.
struct SomeDirection {
    Json schema(Json& definitions) const { return UnitDirection{}.schema(definitions); }
};
/// The schema of what read_velocity reads.
Json velocity_schema(Json& definitions);
/// gamma beta, from a direction and one of gamma, beta and rapidity.
struct Velocity {
    glm::dvec3 read(const Place& place, const Folder&) const { return read_velocity(place); }
    Json schema(Json& definitions) const { return velocity_schema(definitions); }
};
template <>
inline constexpr auto description<Shot> = describe_file<Shot>("shot",
    "One frozen instant: a place, a time and a velocity in a scene. Lengths are in the scene's units, times in units / c.",
    needed("scene", Text{}, "The world: a scene's name, or the path of its file.", &Shot::scene),
    field("time", Number{{-farthest, farthest}}, "The world's time, scene units / c.", &Shot::time),
    field("position", Numbers<3>{{-farthest, farthest}}, "The ship's place, [x, y, z] in scene units.", &Shot::position),
    field("velocity", Velocity{}, "The ship's velocity in the world; left out, it is at rest.", &Shot::u),
    field("look", SomeDirection{}, "The direction straight ahead among the ship's axes, [x, y, z] of any length.",
        &Shot::ship_from_cockpit),
    again(
        "up", SomeDirection{}, "The cockpit's up, [x, y, z] of any length, not parallel to look.", &Shot::ship_from_cockpit),
    field("effects", Object<Effects>{}, "", &Shot::effects),
    field("exposure_ev", Number{{-60, 60}}, "The exposure, EV: each step doubles the light.", &Shot::exposure_ev));
static_assert(is_complete<Shot>());
void check(const Place& place, Shot& shot, const Folder&);

constexpr Range any_measured{-1e12, 1e12};
template <>
inline constexpr auto description<Measure> = with_rules(
    describe<Measure>("measure", "A number that follows from the ship's state.",
        needed("quantity", Named{&measures},
            "The quantity. ship_s, world_s: clocks, seconds; younger_s: the time since the start by the world's clock, less "
            "that by "
            "the ship's; trip_s: the ship's clock since the last cut; distance: to `at`, scene units; angle_deg: of the "
            "seen "
            "direction of `at` from the motion, degrees; doppler: D of light from `at`; doppler_ahead: D along the motion; "
            "size: "
            "the angular size of a small thing at `at`, over that at the start; reading_s: the seen reading of a clock at "
            "`at`; "
            "now_s: its reading at the ship's present; own_colour_deg: the angle from the motion at which D is 1.",
            &Measure::quantity),
        field("at", Numbers<3>{{-farthest, farthest}}, "A place at rest in the world, [x, y, z] in scene units.",
            &Measure::at),
        field("relative_to", Numbers<3>{{-farthest, farthest}}, "The quantity at this place is subtracted; scene units.",
            &Measure::relative_to),
        field("over", Number{{0, farthest, true}}, "The quantity is divided by this number. No unit.", &Measure::over)),
    R"({ "if": { "properties": { "quantity": { "enum": ["distance", "angle_deg", "doppler", "size", "reading_s", "now_s"] } } },
        "then": { "required": ["at"] }, "else": { "not": { "anyOf": [{ "required": ["at"] }, { "required": ["relative_to"] }] } } })");
static_assert(is_complete<Measure>());
void check(const Place& place, const Measure& measure, const Folder&);

/// The schema of a text by language, or of a key of the words that begins with `prefix` and a dot.
Json saying_schema(const std::string& prefix);
/// A text of a goal: a key of the words, or the text in some languages.
struct GoalText {
    LocalisedText read(const Place& place, const Folder&) const;
    Json schema(Json&) const { return saying_schema("goal"); }
};
template <>
inline constexpr auto description<GoalCondition> = describe<GoalCondition>("condition",
    "A number of the ship's state that is at least `from` and below `below`.",
    needed("measure", Object<Measure>{}, "", &GoalCondition::measure),
    field("from", Number{any_measured}, "The least number, in the measure's unit.", &GoalCondition::from),
    field("below", Number{any_measured}, "The number is less than this, in the measure's unit.", &GoalCondition::below));
static_assert(is_complete<GoalCondition>());
void check(const Place& place, const GoalCondition& condition, const Folder&);

template <>
inline constexpr auto description<Goal> = describe<Goal>("goal", "Something for a visitor to find or to do in a world.",
    needed("ask", GoalText{}, "The task: a key of the words that begins with goal., or a text by language.", &Goal::ask),
    needed(
        "reward", GoalText{}, "The text after the task is done: a key of the words, or a text by language.", &Goal::reward),
    needed("conditions", List{Object<GoalCondition>{}, 1, 5, "conditions"}, "All of them must hold for half a second.",
        &Goal::conditions));
static_assert(is_complete<Goal>());

} // namespace starbow
