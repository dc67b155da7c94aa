#include "tour_file.h"
#include "measure_reader.h"
#include "saying.h"
#include "shot_reader.h"
#include <limits>

namespace starbow {
namespace {

constexpr Range any_number{-1e12, 1e12};

struct Reader {
    const Words& words;
    const FindShot& find_shot;
    const Tour& tour;

    /// Reads a key of the words, or the text itself in some languages.
    std::string read_text(const Place& place) const
    {
        const Saying saying = read_saying(place);
        if (!saying.key.empty() && !words.tour(saying.key))
            complain(place,
                "is not a text in " + words.file.filename().string()
                    + "; a key there that begins with \"tour.\", or { \"en\": \"...\" } is right");
        return said(saying, words);
    }

    /// Throws if a caption has {measured} without a measure, or another placeholder.
    void check_measured(const Place& place, const std::string& text, bool is_measured) const
    {
        for (const std::string& name : placeholders(text))
            if (name != "measured" || !is_measured)
                complain(place,
                    "has {" + one_line(name, 40) + "} in its text; "
                        + (is_measured ? "{measured} alone is right" : "{measured} beside a \"measure\" is right"));
    }

    Shot read_cut(const Place& place) const
    {
        if (!place.json->is_string())
            return read_shot(place, false);
        const std::string name = text(place);
        const bool path = name.find('/') != name.npos || name.ends_with(".json");
        const Shot shot = load_shot(path ? (tour.file.parent_path() / name).lexically_normal() : find_shot(name));
        if (!path && shot.scene != tour.scene)
            complain(place,
                "is a shot in the scene " + one_line(shot.scene, 60) + "; one in the tour's, " + one_line(tour.scene, 60)
                    + ", is right");
        return shot;
    }

    Glide read_glide(const Place& place) const
    {
        if (place.json->is_string()) {
            const Shot shot = read_cut(place);
            return {shot.position, shot.u, shot.ship_from_cockpit, {}};
        }
        reject_unknown_members(place, {"time", "position", "velocity", "look", "up"});
        const Shot shot = read_shot(place, false);
        Glide glide;
        if (find_member(place, "time"))
            glide.time = shot.time;
        if (find_member(place, "position"))
            glide.position = shot.position;
        if (find_member(place, "velocity"))
            glide.u = shot.u;
        if (find_member(place, "look") || find_member(place, "up"))
            glide.ship_from_cockpit = shot.ship_from_cockpit;
        return glide;
    }

    Thrust read_thrust(const Place& place) const
    {
        reject_unknown_members(place, {"rapidity_per_s", "towards"});
        Thrust thrust{number(member(place, "rapidity_per_s"), {0, 1e6, true}), {}};
        if (auto p = find_member(place, "towards"))
            thrust.towards = unit_direction(*p);
        return thrust;
    }

    Turning read_turn(const Place& place) const
    {
        reject_unknown_members(place, {"look", "up"});
        member(place, "look");
        return {read_shot(place, false).ship_from_cockpit};
    }

    Try read_try(const Place& place) const
    {
        reject_unknown_members(place, {"mode", "max_gamma"});
        Try tried;
        if (auto p = find_member(place, "mode"))
            tried.mode = chosen(*p, flight_modes);
        if (auto p = find_member(place, "max_gamma"))
            tried.max_gamma = number(*p, {1.001, 1e6});
        return tried;
    }

    Question read_question(const Place& place) const
    {
        reject_unknown_members(place, {"ask", "measure", "choices", "number", "reach", "explanation", "explanation_s"});
        Question question;
        question.ask = read_text(member(place, "ask"));
        question.explanation = read_text(member(place, "explanation"));
        question.measure = read_measure(member(place, "measure"));
        check_measured(member(place, "ask"), question.ask, false);
        check_measured(member(place, "explanation"), question.explanation, true);
        take(place, "explanation_s", question.explanation_s, {0.5, 600});
        const auto choices = find_member(place, "choices"), set = find_member(place, "number"),
                   reach = find_member(place, "reach");
        if (choices.has_value() + set.has_value() + reach.has_value() != 1)
            complain(place, "needs one way to answer; exactly one of \"choices\", \"number\" and \"reach\" is right");
        if (choices) {
            std::vector<Choice> all;
            for (const Place& at : items(*choices, 2, 3, "choices")) {
                reject_unknown_members(at, {"text", "from", "below"});
                Choice choice{read_text(member(at, "text")), -std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
                take(at, "from", choice.from, any_number);
                take(at, "below", choice.below, any_number);
                if (!(choice.from < choice.below))
                    complain(at, "is never right; a \"from\" less than \"below\" is right");
                all.push_back(choice);
            }
            question.answer = all;
        } else if (set) {
            reject_unknown_members(*set, {"from", "to", "step", "tolerance"});
            NumberToSet wanted{number(member(*set, "from"), any_number), number(member(*set, "to"), any_number),
                number(member(*set, "step"), {0, 1e12, true}), number(member(*set, "tolerance"), {0, 1e12})};
            if (!(wanted.from < wanted.to))
                complain(member(*set, "to"), "is not above \"from\"; a greater number is right");
            question.answer = wanted;
        } else {
            reject_unknown_members(*reach, {"from", "to"});
            PlaceToReach wanted{number(member(*reach, "from"), any_number), number(member(*reach, "to"), any_number)};
            if (!(wanted.from < wanted.to))
                complain(member(*reach, "to"), "is not above \"from\"; a greater number is right");
            question.answer = wanted;
        }
        return question;
    }

    Step read_step(const Place& place, double usual_rate) const
    {
        reject_unknown_members(place,
            {"seconds", "describe", "ship_s_per_s", "ease_s", "caption", "measure", "effects", "exposure_ev", "question",
                "cut", "glide", "thrust", "turn", "try"});
        Step step{.seconds = number(member(place, "seconds"), {0.1, 3600})};
        step.ship_s_per_s = usual_rate;
        take(place, "ship_s_per_s", step.ship_s_per_s, {0, 1e12});
        if (auto p = find_member(place, "measure"))
            step.measure = read_measure(*p);
        if (auto p = find_member(place, "caption")) {
            step.caption = read_text(*p);
            check_measured(*p, step.caption, step.measure.has_value());
        }
        if (auto p = find_member(place, "describe"))
            step.description = read_text(*p);
        if (auto p = find_member(place, "effects"))
            step.effects = read_effects(*p);
        if (auto p = find_member(place, "exposure_ev"))
            step.exposure_ev = number(*p, {-60, 60});
        std::vector<std::string> motions;
        for (const char* name : {"cut", "glide", "thrust", "turn", "try"})
            if (find_member(place, name))
                motions.push_back(name);
        if (motions.size() > 1)
            complain(member(place, motions[1]), "conflicts with \"" + motions[0] + "\"; one motion in a step is right");
        if (auto p = find_member(place, "cut"))
            step.motion = Cut{read_cut(*p)};
        else if (auto p = find_member(place, "glide"))
            step.motion = read_glide(*p);
        else if (auto p = find_member(place, "thrust"))
            step.motion = read_thrust(*p);
        else if (auto p = find_member(place, "turn"))
            step.motion = read_turn(*p);
        else if (auto p = find_member(place, "try"))
            step.motion = read_try(*p);
        if (auto p = find_member(place, "ease_s")) {
            step.ease_s = vec2(*p, {0, 3600});
            if (step.ease_s.x + step.ease_s.y > step.seconds)
                complain(*p, "is longer than the step, " + shown(step.seconds) + " s; two times that fit are right");
            if (std::holds_alternative<Glide>(step.motion) || std::holds_alternative<Try>(step.motion))
                complain(
                    *p, "is for a ship that flies by itself; nothing here, or no \"glide\" or \"try\" beside it, is right");
        }
        if (auto p = find_member(place, "question")) {
            step.question = read_question(*p);
            const bool flies = std::holds_alternative<Try>(step.motion),
                       reaches = std::holds_alternative<PlaceToReach>(step.question->answer);
            if (flies != reaches)
                complain(*p,
                    flies ? "is asked while the visitor flies; \"reach\", or no \"try\" beside it, is right"
                          : "asks for a place to be reached; a \"try\" beside it is right");
        }
        return step;
    }
};

} // namespace

Tour load_tour(const std::filesystem::path& file, const Words& words, const FindShot& find_shot)
{
    const Document document = read_document(file);
    const Place top = root(document);
    reject_unknown_members(top, {"$schema", "scene", "again_after_s", "ship_s_per_s", "steps"});
    Tour tour{.file = file};
    tour.scene = text(member(top, "scene"));
    take(top, "again_after_s", tour.again_after_s, {5, 3600});
    double rate = 1;
    take(top, "ship_s_per_s", rate, {0, 1e12});
    const Reader reader{words, find_shot, tour};
    std::vector<Step> steps;
    for (const Place& place : items(member(top, "steps"), 1, 1000, "steps")) {
        steps.push_back(reader.read_step(place, rate));
        if (steps.size() == 1 && !std::holds_alternative<Cut>(steps[0].motion))
            complain(place, "begins nowhere; a \"cut\" in the first step is right");
    }
    tour.steps = std::move(steps);
    return tour;
}

} // namespace starbow
