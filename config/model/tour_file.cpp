#include "describe_tour.h"

namespace starbow {
namespace {

constexpr const char* motions[]{"cut", "glide", "thrust", "turn", "try"};

const TourSource& of_tour(const Folder& source) { return static_cast<const TourSource&>(source); }

/// Throws if a text has {measured} without a measure, or another placeholder.
void check_measured(const Place& place, const std::string& text, bool is_measured)
{
    for (const std::string& name : placeholders(text))
        if (name != "measured" || !is_measured)
            fail_at(place,
                "has {" + one_line(name, 40) + "} in its text; "
                    + (is_measured ? "{measured} alone is right" : "{measured} beside a \"measure\" is right"));
}

/// Throws if a text that stands without a number has a placeholder.
void check_plain(const Place& place, const std::string& text)
{
    if (!placeholders(text).empty())
        fail_at(place, "has a number's place in its text, which the caption alone has; words without { } are right");
}

/// The schema of a file's name, or of an object instead.
Json name_or(const Json& object) { return {{"oneOf", {{{"type", "string"}, {"minLength", 1}}, object}}}; }

} // namespace

std::string TourText::read(const Place& place, const Folder& source) const
{
    const Words& words = of_tour(source).words;
    const LocalisedText saying = read_saying(place);
    if (!saying.key.empty() && !words.tour(saying.key))
        fail_at(place,
            "is not a text in " + words.file.filename().string()
                + "; a key there that begins with \"tour.\", or { \"en\": \"...\" } is right");
    return said(saying, words);
}

void check(const Place& place, const Choice& choice, const Folder&)
{
    if (!(choice.from < choice.below))
        fail_at(place, "is never right; a \"from\" less than \"below\" is right");
}

void check(const Place& place, const NumberToSet& number, const Folder&)
{
    if (!(number.from < number.to))
        fail_at(member(place, "to"), "is not above \"from\"; a greater number is right");
}

void check(const Place& place, const PlaceToReach& wanted, const Folder&)
{
    if (!(wanted.from < wanted.to))
        fail_at(member(place, "to"), "is not above \"from\"; a greater number is right");
}

void check(const Place& place, const Question& question, const Folder&)
{
    check_measured(member(place, "ask"), question.ask, false);
    check_measured(member(place, "explanation"), question.explanation, true);
    int ways = 0;
    for (const char* name : {"choices", "number", "reach"})
        ways += find_member(place, name).has_value();
    if (ways != 1)
        fail_at(place, "needs one way to answer; exactly one of \"choices\", \"number\" and \"reach\" is right");
}

void check(const Place& place, const Highlight& highlight, const Folder&)
{
    check_plain(member(place, "name"), highlight.name);
    const bool is_globe = find_member(place, "globe").has_value();
    for (const char* name : {"at", "across"})
        if (find_member(place, name).has_value() == is_globe)
            fail_at(place,
                is_globe ? "has a globe, whose place and size are known, and \"" + std::string(name)
                        + "\"; one of them alone is right"
                         : "is nowhere; \"at\" with \"across\", or a \"globe\", is right");
    if (is_globe && find_member(place, "body"))
        fail_at(member(place, "body"), "conflicts with \"globe\"; one of them alone is right");
}

Cut CutForm::read(const Place& place, const Folder& source) const
{
    if (!place.json->is_string())
        return {read_shot(place, false)};
    const TourSource& tour = of_tour(source);
    const std::string name = text(place);
    const bool path = name.find('/') != name.npos || name.ends_with(".json");
    const Shot shot = load_shot(path ? (tour.path / name).lexically_normal() : tour.find_shot(name));
    if (!path && shot.scene != tour.scene)
        fail_at(place,
            "is a shot in the scene " + one_line(shot.scene, 60) + "; one in the tour's, " + one_line(tour.scene, 60)
                + ", is right");
    return {shot};
}

Json CutForm::schema(Json& definitions) const { return name_or(Varied<Shot>{{.without = "scene"}}.schema(definitions)); }

void check(const Place& place, Glide& glide, const Folder&)
{
    if (find_member(place, "look") || find_member(place, "up"))
        glide.ship_from_cockpit = read_orientation(place);
}

Glide GlideForm::read(const Place& place, const Folder& source) const
{
    if (!place.json->is_string())
        return starbow::read<Glide>(place, source);
    const Shot shot = CutForm{}.read(place, source).shot;
    return {shot.position, shot.u, shot.ship_from_cockpit, {}};
}

Json GlideForm::schema(Json& definitions) const { return name_or(Object<Glide>{}.schema(definitions)); }

void check(const Place& place, Turning& turning, const Folder&) { turning.ship_from_cockpit = read_orientation(place); }

void check_members(const Place& place, const Around*)
{
    if (find_member(place, "cut").has_value() == find_member(place, "glide").has_value())
        fail_at(place, "needs one motion; exactly one of \"cut\" and \"glide\" is right");
}

void check_members(const Place& place, const Step*)
{
    std::vector<std::string> given;
    for (const char* name : motions)
        if (find_member(place, name))
            given.emplace_back(name);
    if (given.size() > 1)
        fail_at(member(place, given[1]), "conflicts with \"" + given[0] + "\"; one motion in a step is right");
}

void check(const Place& place, const Step& step, const Folder&)
{
    if (const auto caption = find_member(place, "caption"))
        check_measured(*caption, step.caption, step.measure.has_value());
    if (const auto title = find_member(place, "title"))
        check_plain(*title, step.title);
    if (const auto ease = find_member(place, "ease_s")) {
        if (step.ease_s.x + step.ease_s.y > step.seconds)
            fail_at(*ease, "is longer than the step, " + shown(step.seconds) + " s; two times that fit are right");
        if (std::holds_alternative<Glide>(step.motion) || std::holds_alternative<Try>(step.motion))
            fail_at(
                *ease, "is for a ship that flies by itself; nothing here, or no \"glide\" or \"try\" beside it, is right");
    }
    if (step.question) {
        const bool flies = std::holds_alternative<Try>(step.motion),
                   reaches = std::holds_alternative<PlaceToReach>(step.question->answer);
        if (flies != reaches)
            fail_at(member(place, "question"),
                flies ? "is asked while the visitor flies; \"reach\", or no \"try\" beside it, is right"
                      : "asks for a place to be reached; a \"try\" beside it is right");
    }
}

Json UsualRate::schema(Json& definitions) const
{
    Json schema = Number{ship_rate}.schema(definitions);
    schema["default"] = 1;
    return schema;
}

void check(const Place& place, Tour& tour, const Folder&)
{
    double rate = 1;
    read_optional(place, "ship_s_per_s", rate, ship_rate);
    const std::vector<Place> steps = elements(member(place, "steps"));
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (!find_member(steps[i], "ship_s_per_s"))
            tour.steps[i].ship_s_per_s = rate;
    if (tour.steps[0].around && !std::holds_alternative<Cut>(tour.steps[0].around->motion))
        fail_at(member(steps[0], "around"), "begins nowhere; a \"cut\" in the first step is right");
    if (!std::holds_alternative<Cut>(tour.steps[0].motion))
        fail_at(steps[0], "begins nowhere; a \"cut\" in the first step is right");
}

Tour seen_on(Tour tour, bool surrounds)
{
    for (Step& step : tour.steps)
        if (surrounds && step.around)
            std::visit([&](auto& motion) { step.motion = std::move(motion); }, step.around->motion);
    return tour;
}

Tour load_tour(const std::filesystem::path& file, const Words& words, const FindShot& find_shot)
{
    const Document document = read_document(file);
    const Place top = root(document);
    const auto scene = top.json->is_object() ? find_member(top, "scene") : std::nullopt; // names of shots are of this scene
    const TourSource source{
        {file.parent_path()}, words, find_shot, scene && scene->json->is_string() ? scene->json->get<std::string>() : ""};
    Tour tour = read<Tour>(top, source);
    tour.file = file;
    return tour;
}

} // namespace starbow
