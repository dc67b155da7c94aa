#include "spoken.h"

namespace starbow {
namespace {

/// The moment in a tour. It changes when a text shall begin.
std::string moment_of(const Session& session, const TourPlayer& tour)
{
    return session.content.tour_name + "/" + std::to_string(tour.step()) + (tour.answered() ? "a" : "") + "/"
        + session.words.language;
}

std::string text_of_tour(const Session& session, const TourPlayer& tour)
{
    std::vector<std::string> texts;
    if (!tour.answered()) // the moment begins with the step
        texts = {tour.title(), tour.description()};
    if (const auto caption = tour.caption(session.words, session.devices.hid().capabilities())) {
        texts.push_back(caption->text);
        const auto& question = tour.steps()[tour.step()].question;
        if (question && !tour.answered() && std::holds_alternative<std::vector<Choice>>(question->answer))
            texts.insert(texts.end(), caption->choices.begin(), caption->choices.end());
    }
    return sentences(texts);
}

} // namespace

void speak(Session& session, const SceneFile& scene)
{
    if (!session.speaker)
        return;
    const TourPlayer* tour = session.source->over() ? nullptr : session.tour();
    std::string moment = tour  ? moment_of(session, *tour)
        : seeks_goals(session) ? goal_text(session.goals, scene.goals, session.words)
                               : "";
    if (moment == session.spoken)
        return;
    session.speaker->say(tour ? text_of_tour(session, *tour) : moment, session.words.language);
    session.spoken = std::move(moment);
}

} // namespace starbow
