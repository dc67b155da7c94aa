#pragma once
#include "describe_shot.h"
#include "tour_file.h"

namespace starbow {

// Tours, as config/json/describe.h says.

/// The source of a tour's texts and shots; `scene` is the scene of its named shots.
struct TourSource : Folder {
    const Words& words;
    const FindShot& find_shot;
    std::string scene;
};

/// A key of the words, or the text itself in some languages.
struct TourText {
    std::string read(const Place& place, const Folder& source) const;
    Json schema(Json&) const { return saying_schema("tour"); }
};
template <>
inline constexpr auto description<Choice> = describe<Choice>("choice",
    "A choice is right if the measured number is at least `from` and less than `below`.",
    needed("text", TourText{}, "Its text.", &Choice::text),
    field("from", Number{any_measured}, "The least right number, in the measure's unit.", &Choice::from),
    field("below", Number{any_measured}, "A right number is less than this, in the measure's unit.", &Choice::below));
static_assert(is_complete<Choice>());
void check(const Place& place, const Choice& choice, const Folder&);

template <>
inline constexpr auto description<NumberToSet> = describe<NumberToSet>("number",
    "The visitor sets a number; it is right within the tolerance of the measured one.",
    needed("from", Number{any_measured}, "The least number, in the measure's unit.", &NumberToSet::from),
    needed("to", Number{any_measured}, "The greatest number, in the measure's unit.", &NumberToSet::to),
    needed("step", Number{{0, 1e12, true}}, "From one number to the next, in the measure's unit.", &NumberToSet::step),
    needed("tolerance", Number{{0, 1e12}}, "The greatest error of a right number, in the measure's unit.",
        &NumberToSet::tolerance));
static_assert(is_complete<NumberToSet>());
void check(const Place& place, const NumberToSet& number, const Folder&);

template <>
inline constexpr auto description<PlaceToReach> = describe<PlaceToReach>("reach",
    "Beside a try: the visitor flies until the measured number is between these.",
    needed("from", Number{any_measured}, "The least number, in the measure's unit.", &PlaceToReach::from),
    needed("to", Number{any_measured}, "The greatest number, in the measure's unit.", &PlaceToReach::to));
static_assert(is_complete<PlaceToReach>());
void check(const Place& place, const PlaceToReach& wanted, const Folder&);

template <>
inline constexpr auto description<Question> = with_rules(
    describe<Question>("question", "A question, and one way to answer it.",
        needed("ask", TourText{}, "The question.", &Question::ask),
        needed("explanation", TourText{}, "The explanation, shown after any answer; {measured} stands for the number.",
            &Question::explanation),
        needed("measure", Object<Measure>{}, "", &Question::measure),
        field("explanation_s", Number{{0.5, 600}}, "The time for which the explanation is shown, seconds.",
            &Question::explanation_s),
        field("choices", List{Object<Choice>{}, 2, 3, "choices"}, "The choices, of which one or several are right.",
            &Question::answer),
        again("number", Object<NumberToSet>{}, "", &Question::answer),
        again("reach", Object<PlaceToReach>{}, "", &Question::answer), not_in_file(&Question::unattended_s)),
    R"({ "oneOf": [{ "required": ["choices"] }, { "required": ["number"] }, { "required": ["reach"] }] })");
static_assert(is_complete<Question>());
void check(const Place& place, const Question& question, const Folder&);

template <>
inline constexpr auto description<Highlight> = with_rules(
    describe<Highlight>("highlight", "A thing that a step speaks of: the picture has a ring with a name around it.",
        needed("name", TourText{}, "Its name, above the ring.", &Highlight::name),
        field("at", Numbers<3>{{-farthest, farthest}},
            "The thing's middle, [x, y, z] in scene units: in the world, or from a body's origin among its axes.",
            &Highlight::at),
        field("across", Number{{0, farthest}}, "The thing's diameter where it rests, scene units.", &Highlight::across),
        field("body", Text{}, "The scene's body that carries the thing; left out, the thing rests in the world.",
            &Highlight::body),
        field("globe", Text{}, "A globe of the scene's sky, by its name, in place of the other members.", &Highlight::globe),
        field("enlarged", Flag{},
            "While the thing looks smaller than 6 degrees, an inset shows it enlarged, with a line to its place.",
            &Highlight::enlarged)),
    R"({ "oneOf": [{ "required": ["at", "across"], "not": { "required": ["globe"] } },
        { "required": ["globe"], "not": { "anyOf": [{ "required": ["at"] }, { "required": ["across"] }, { "required": ["body"] }] } }] })");
static_assert(is_complete<Highlight>());
void check(const Place& place, const Highlight& highlight, const Folder&);

/// A shot's file, the name of a shipped one, or the shot itself.
struct CutForm {
    Cut read(const Place& place, const Folder& source) const;
    Json schema(Json& definitions) const;
};
template <>
inline constexpr auto description<Glide> = describe<Glide>("glide",
    "A smooth motion from the last step's end; missing members stay.",
    field("time", Number{{-farthest, farthest}},
        "The world's time at the end, scene units / c; left out, it advances by gamma for each second of the ship's.",
        &Glide::time),
    field(
        "position", Numbers<3>{{-farthest, farthest}}, "The place at the end, [x, y, z] in scene units.", &Glide::position),
    field("velocity", Velocity{}, "The velocity at the end.", &Glide::u),
    field("look", SomeDirection{}, "The direction straight ahead at the end, [x, y, z] of any length.",
        &Glide::ship_from_cockpit),
    again("up", SomeDirection{}, "The cockpit's up at the end, [x, y, z] of any length.", &Glide::ship_from_cockpit));
static_assert(is_complete<Glide>());
void check(const Place& place, Glide& glide, const Folder&);
/// A shot's file applies as a whole, except its time.
struct GlideForm {
    Glide read(const Place& place, const Folder& source) const;
    Json schema(Json& definitions) const;
};

template <>
inline constexpr auto description<Thrust> = describe<Thrust>("thrust",
    "Constant proper acceleration, along the nose or a direction among the ship's axes.",
    needed("rapidity_per_s", Number{{0, 1e6, true}}, "Rapidity per second of the ship's clock.", &Thrust::rapidity_per_s),
    field("towards", UnitDirection{}, "The direction among the ship's axes, [x, y, z] of any length; left out, the nose.",
        &Thrust::towards));
static_assert(is_complete<Thrust>());

template <>
inline constexpr auto description<Turning> = describe<Turning>("turn",
    "A straight flight while the nose turns smoothly to a view.",
    needed("look", SomeDirection{}, "The direction straight ahead, [x, y, z] of any length.", &Turning::ship_from_cockpit),
    again("up", SomeDirection{}, "The cockpit's up, [x, y, z] of any length.", &Turning::ship_from_cockpit));
static_assert(is_complete<Turning>());
void check(const Place& place, Turning& turning, const Folder&);

template <>
inline constexpr auto description<Try> = describe<Try>("try", "The visitor flies.",
    field("mode", Named{&flight_modes}, "The flight mode; left out, the exhibit's.", &Try::mode),
    field("max_gamma", Number{{1.001, 1e6}},
        "The Lorentz factor at full throttle, at most the exhibit's. 2.294 is 0.9 of light's speed, 7.089 is 0.99.",
        &Try::max_gamma));
static_assert(is_complete<Try>());

/// Seconds of the ship's clock in each of the visitor's.
constexpr Range ship_rate{0, 1e12};

template <>
inline constexpr auto description<Around> = with_rules(
    describe<Around>("around",
        "A step's motion on a display that surrounds the visitor, such as a dome, instead of its own: "
        "nearer to what would be small there.",
        field("cut", CutForm{}, "As the step's.", &Around::motion),
        again("glide", GlideForm{}, "As the step's.", &Around::motion)),
    R"({ "oneOf": [{ "required": ["cut"] }, { "required": ["glide"] }] })");
static_assert(is_complete<Around>());
void check_members(const Place& place, const Around*);

/// Two motions exclude each other.
constexpr const char* one_motion = R"({ "not": { "anyOf": [
    { "required": ["cut", "glide"] }, { "required": ["cut", "thrust"] }, { "required": ["cut", "turn"] },
    { "required": ["cut", "try"] }, { "required": ["glide", "thrust"] }, { "required": ["glide", "turn"] },
    { "required": ["glide", "try"] }, { "required": ["thrust", "turn"] }, { "required": ["thrust", "try"] },
    { "required": ["turn", "try"] }] } })";
template <>
inline constexpr auto description<Step> = with_rules(
    describe<Step>("step", "A part of the tour, with one motion at most.",
        needed("seconds", Number{{0.1, 3600}},
            "The step's length in the visitor's time, seconds; for a question the time to answer.", &Step::seconds),
        field("ship_s_per_s", Number{ship_rate},
            "Seconds of the ship's clock in each of the visitor's: slow and fast motion; 0: time stands still. "
            "Left out, the tour's.",
            &Step::ship_s_per_s),
        field("measure", Object<Measure>{}, "", &Step::measure),
        field("highlights", List{Object<Highlight>{}, 1, 2, "highlights"}, "The things that the step speaks of.",
            &Step::highlights),
        field("title", TourText{}, "A few words in large letters over the picture, which are read from afar.", &Step::title),
        field("caption", TourText{}, "The caption; {measured} stands for the measured number.", &Step::caption),
        field("describe", TourText{},
            "The step's picture described for people who cannot see it; read aloud where the exhibit speaks.",
            &Step::description),
        field("effects", Object<Effects>{}, "", &Step::effects),
        field("exposure_ev", Number{{-60, 60}},
            "The exposure, EV, reached at once with a cut, else by the step's end; left out, it stays.", &Step::exposure_ev),
        field("cut", CutForm{}, "A shot file, the name of one in config/shots, or the shot itself, without its scene.",
            &Step::motion),
        again("glide", GlideForm{}, "A smooth motion, or a shot file, which applies as a whole, except its time.",
            &Step::motion),
        again("thrust", Object<Thrust>{}, "", &Step::motion), again("turn", Object<Turning>{}, "", &Step::motion),
        again("try", Object<Try>{}, "", &Step::motion),
        field("ease_s", Numbers<2>{{0, 3600}},
            "Seconds in which the ship's time starts at the step's beginning and stops at its end; its sum stays. Not "
            "beside a "
            "glide, which is smooth by itself, or a try.",
            &Step::ease_s),
        field("question", Object<Question>{}, "", &Step::question), field("around", Object<Around>{}, "", &Step::around)),
    one_motion);
static_assert(is_complete<Step>());
void check_members(const Place& place, const Step*);
void check(const Place& place, const Step& step, const Folder&);

/// A number that `check` gives to the steps without one of their own.
struct UsualRate {
    Json schema(Json& definitions) const;
};
template <>
inline constexpr auto description<Tour> = describe_file<Tour>("tour",
    "A timeline of shots, flights and questions with captions. Texts are keys of the words in config/words that begin with "
    "\"tour.\", or the texts themselves by language. Lengths are scene units, times seconds.",
    needed("scene", Text{}, "The world: a scene file, or the name of one in config/scenes.", &Tour::scene),
    field("again_after_s", Number{{5, 3600}},
        "After the tour's end the visitor flies. The tour begins again when nobody has touched anything for this time, "
        "seconds.",
        &Tour::again_after_s),
    again<UsualRate, Tour>(
        "ship_s_per_s", UsualRate{}, "The usual value of every step: seconds of the ship's clock in each of the visitor's."),
    needed("steps", List{Object<Step>{}, 1, 1000, "steps"}, "The steps in order; the first is a cut.", &Tour::steps),
    not_in_file(&Tour::file));
static_assert(is_complete<Tour>());
void check(const Place& place, Tour& tour, const Folder&);

} // namespace starbow
