#include "spoken.h"

namespace starbow {
namespace {

/// The moment in a tour. It changes when a text shall begin.
std::string moment_of(const Session& session, const TourPlayer& tour)
{
    return session.content.tour_name + "/" + std::to_string(tour.step()) + (tour.answered() ? "a" : "") + "/"
        + session.words.language;
}

/// A tour's text: sentence after sentence.
std::string text_of_tour(const Session& session, const TourPlayer& tour)
{
    std::string all;
    const auto add = [&](const std::string& text) {
        if (text.empty())
            return;
        const bool ends = text.ends_with('.') || text.ends_with('!') || text.ends_with('?');
        all += (all.empty() ? "" : " ") + text + (ends ? "" : ".");
    };
    if (!tour.answered()) {
        add(tour.title()); // the moment begins with the step
        add(tour.description());
    }
    if (const auto caption = tour.caption(session.words, session.devices.hid().capabilities())) {
        add(caption->text);
        if (caption->right < 0)
            for (const std::string& choice : caption->choices)
                add(choice);
    }
    return all;
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
