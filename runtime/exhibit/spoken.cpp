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
    const auto caption = tour.caption(session.words, session.devices.hid().capabilities());
    const std::string text = caption ? caption->text : "";
    return tour.answered() ? sentences({text}) : text_to_read(tour.steps()[tour.step()], text);
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
