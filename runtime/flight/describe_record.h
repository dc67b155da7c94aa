#pragma once
#include "config/model/describe_exhibit.h"
#include "config/model/describe_scene.h"
#include "config/model/describe_shot.h"
#include "record.h"
#include "shaders/shared_structs.h"

namespace starbow {

// The lines of a flight's record, as config/json/describe.h says. They have no schema, because nobody writes them by hand.
// An instant's velocity and directions stand as the flight has them, not in a shot file's forms, which round.

constexpr Range any_rate{-1e3, 1e3}; ///< wide enough for any device, narrow enough to prevent overflow
constexpr Range any_place{-1e15, 1e15};
constexpr double most_ns = 9e15; ///< a hundred days; whole numbers below it are doubles

/// A quaternion, w first.
struct Quaternion {
    glm::dquat read(const Place& place, const Folder&) const;
    Json written(const glm::dquat& turn) const { return {turn.w, turn.x, turn.y, turn.z}; }
};
/// A whole number beyond an int.
struct Count {
    double most;
    std::int64_t read(const Place& place, const Folder&) const;
    Json written(std::int64_t value) const { return value; }
};
struct DigestText {
    std::uint64_t read(const Place& place, const Folder&) const;
    Json written(std::uint64_t value) const { return shown_digest(value); }
};
/// A flag that a file names by its opposite.
struct Unless {
    bool read(const Place& place, const Folder&) const { return !boolean(place); }
    Json written(bool value) const { return !value; }
};

template <>
inline constexpr auto description<RecordedShot> = describe<Shot>("start", "The flight's first instant.",
    field("time", Number{any_place}, "The world's time, scene units / c.", &Shot::time),
    field("position", Numbers<3>{any_place}, "The ship's place, scene units.", &Shot::position),
    field("u", Numbers<3>{any_place}, "The ship's proper velocity in the world, gamma beta.", &Shot::u),
    field("ship_from_cockpit", Quaternion{}, "The turn from the cockpit's axes to the ship's.", &Shot::ship_from_cockpit),
    field("effects", Object<Effects>{}, "", &Shot::effects),
    field("exposure_ev", Number{{-60, 60}}, "The exposure, EV.", &Shot::exposure_ev),
    not_in_file(&Shot::scene)); // the header's "scene"
static_assert(is_complete<Shot, RecordedShot>());

/// Six numbers: the lowest corner, the highest.
struct Corners {
    AlignedBox read(const Place& place, const Folder&) const;
    Json written(const AlignedBox& box) const;
};
template <>
inline constexpr auto description<Pace> = describe<Pace>("pace", "The pace at which visitors gain speed among things.",
    field("per_s2", Number{{0, 1e30}}, "Rapidity per second for each second to the nearest thing.", &Pace::per_s2),
    field("least", Number{{0, 1e15}}, "A nearer thing counts as so far away, scene units.", &Pace::least),
    needed("things", List{Corners{}, 0, 10'000, "things"}, "The boxes around things at rest.", &Pace::things));
static_assert(is_complete<Pace>());

/// A polynomial's coefficients, the constant first.
struct Polynomial {
    using Path = decltype(Solid::path);
    Path read(const Place& place, const Folder& folder) const;
    Json written(const Path& path) const;
};
template <>
inline constexpr auto description<Solid> = describe<Solid>("solid", "A ball that no visitor flies into.",
    needed("radius", Number{{0, 1e15}}, "Its radius, scene units.", &Solid::radius),
    needed("span", Number{{0, 1e15, true}}, "The unit of the polynomial's time, scene units / c.", &Solid::span),
    needed("path", Polynomial{}, "Its middle's path, a polynomial of the world's time.", &Solid::path));
static_assert(is_complete<Solid>());

template <>
inline constexpr auto description<RecordedFlying> = with_fields(description<Flying>,
    field("boundary", Object<Boundary>{}, "", &Flying::boundary), field("pace", Object<Pace>{}, "", &Flying::pace),
    field("solids", List{Object<Solid>{}, 0, 100, "solid balls"}, "The world's solid balls.", &Flying::solids),
    field("comfort", Brief<Comfort>{}, "", &Flying::comfort));
static_assert(is_complete<Flying, RecordedFlying>());

template <>
inline constexpr auto description<RecordHeader> = describe<RecordHeader>("record", "A record's first line.",
    needed("starbow_record", Whole{1, record_version}, "The version of records.", &RecordHeader::version),
    needed("scene", Text{}, "The world: a shipped scene's name, or a path.", &RecordHeader::scene),
    needed("scene_digest", DigestText{}, "The digest of the scene's files.", &RecordHeader::scene_digest),
    needed("layout", Text{}, "The layout: a shipped one's name, or a path.", &RecordHeader::layout),
    needed("layout_digest", DigestText{}, "The digest of the layout's files.", &RecordHeader::layout_digest),
    needed("pattern", Text{}, "The first test pattern of the outputs.", &RecordHeader::pattern),
    needed("seconds_per_time_unit", Number{{0, 1e60, true}}, "The scene's unit of time, seconds.",
        &RecordHeader::seconds_per_time_unit),
    needed("start", Object<RecordedShot>{}, "", &RecordHeader::start),
    needed("flying", Object<RecordedFlying>{}, "", &RecordHeader::rules),
    needed("exposure", Object<Exposing>{}, "", &RecordHeader::exposing),
    again(
        "calm", Within{Flag{}, &RecordHeader::exposing, &Exposing::calm}, "The exhibit is calm.", &RecordHeader::exposing));
static_assert(is_complete<RecordHeader>());

/// The numbers that the range mode's curve follows, as range_curve.h has them.
struct RangeGoal {
    std::vector<double> read(const Place& place, const Folder&) const;
    Json written(const std::vector<double>& goal) const { return goal; }
};
/// A remote's command, as its words.
struct CommandWords {
    Command read(const Place& place, const Folder&) const;
    Json written(const Command& command) const { return words_of(command); }
};
/// A switch that is pressed.
struct Pressed {
    Switch which;
    void read_into(const Place& place, RecordEntry& entry, const Folder&) const
    {
        entry.controls.set(which, boolean(place));
    }
    Json written(const Controls& controls) const { return controls[which]; }
};
/// A number of the controls.
template <class Form, class... Inner> constexpr auto control(const char* name, Form form, const char* says, Inner... inner)
{
    return again(name, Within(form, &RecordEntry::controls, inner...), says, &RecordEntry::controls);
}
template <> inline constexpr auto description<RecordEntry> = []<std::size_t... i>(std::index_sequence<i...>)
{
    return describe<RecordEntry>("frame", "A frame of a record.",
        needed("dt_ns", Count{1e9}, "Its time, nanoseconds.", &RecordEntry::dt_ns),
        field("skipped_ns", Count{most_ns}, "A stall before it, nanoseconds.", &RecordEntry::skipped_ns),
        field("unseen", Unless{}, "No window showed it.", &RecordEntry::shown),
        field("exposure_ev", Number{any_rate}, "The automatic exposure, EV.", &RecordEntry::exposure_ev),
        field("light", Number{{0, 1}}, "The part that a calm exhibit keeps of the light.", &RecordEntry::light),
        field("ranged", Flag{}, "A curve shows everything at once.", &RecordEntry::ranged),
        field("range_goal", RangeGoal{}, "The numbers that the curve follows from now on.", &RecordEntry::range_goal),
        control("lever", Number{{0, 1}}, "The throttle's place.", &Steering::lever),
        control("faster", Number{any_rate}, "The throttle keys' rate.", &Steering::throttle_rate),
        control("push", Numbers<3>{any_rate}, "Thrusters: right, up, back.", &Steering::push),
        control("turn", Numbers<3>{any_rate}, "Rates of turn: pitch up, yaw left, roll left.", &Steering::turn),
        control("look_rad", Numbers<2>{any_rate}, "The look's change to the left and up, radians.", &Looking::look_rad),
        control("head_m", Numbers<3>{any_rate}, "The head's displacement, metres.", &Looking::head, &Head::moved_m),
        control("head_turned", Quaternion{}, "The head's turn.", &Looking::head, &Head::turned),
        control("exposure", Number{any_rate}, "The exposure's change.", &Looking::exposure),
        control("choose", Whole{-1000, 1000}, "The choice among the alignment's numbers.", &AlignmentSteps::choose),
        control("turn_by", Whole{-1000, 1000}, "The chosen number's change, steps.", &AlignmentSteps::turn_by),
        again(all_switches[i].name.data(), Pressed{all_switches[i].which}, "", &RecordEntry::controls)...,
        control("taken", Flag{}, "The guide has the stick.", &Steering::taken),
        field("commands", List{CommandWords{}, 1, 1000, "commands"}, "A remote's commands before the frame.",
            &RecordEntry::commands),
        not_in_file(&RecordEntry::controls)); // named one by one above
}
(std::make_index_sequence<all_switches.size()>());
static_assert(is_complete<RecordEntry>());

template <>
inline constexpr auto description<RecordCheck> = describe<RecordCheck>("check", "The flight's state after some ticks.",
    needed("ticks", Count{most_ns}, "The milliseconds flown.", &RecordCheck::ticks),
    needed("digest", DigestText{}, "The state's digest.", &RecordCheck::digest),
    field("last", Flag{}, "The flight ended here.", &RecordCheck::last));
static_assert(is_complete<RecordCheck>());

} // namespace starbow
