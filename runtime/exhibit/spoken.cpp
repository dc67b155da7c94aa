#include "spoken.h"

namespace starbow {
namespace {

/// Without the sign that leads a goal's line.
std::string without_sign(const std::string& line)
{
    const std::size_t space = line.find(' ');
    return space == line.npos ? line : line.substr(space + 1);
}

std::string with_stop(const std::string& text)
{
    return text.empty() || text.ends_with('.') || text.ends_with('!') || text.ends_with('?') ? text : text + ".";
}

} // namespace

Spoken spoken_now(const Session& session, const SceneFile& scene)
{
    const Words& words = session.words;
    if (session.guide && !session.guide->over()) {
        const std::optional<Caption> caption = session.guide->caption(words, session.hid.capabilities());
        Spoken spoken{.moment = session.programme.tour_name + "/" + std::to_string(session.guide->step())
                + (session.guide->answered() ? "a" : "") + "/" + words.language,
            .text = session.guide->answered() ? "" : session.guide->description()};
        const auto add = [&](const std::string& text) {
            if (!text.empty())
                spoken.text += (spoken.text.empty() ? "" : " ") + with_stop(text);
        };
        if (caption) {
            add(caption->text);
            if (caption->right < 0)
                for (const std::string& choice : caption->choices)
                    add(choice);
        }
        return spoken;
    }
    const std::string line = session.information == Information::laboratory || session.guide || !in_hand(session.visit)
        ? ""
        : goal_line(session.goals, scene.goals, words);
    return {.moment = line, .text = line.empty() ? "" : without_sign(line)};
}

void speak(Session& session, const SceneFile& scene)
{
    if (!session.speaker)
        return;
    Spoken now = spoken_now(session, scene);
    if (now.moment == session.spoken)
        return;
    session.speaker->say(now.text, session.words.language);
    session.spoken = std::move(now.moment);
}

} // namespace starbow
