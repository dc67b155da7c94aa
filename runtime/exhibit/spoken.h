#pragma once
#include "session.h"

namespace starbow {

/// The text that is to be read aloud now. `moment` changes when a text shall begin, and not with the numbers in it.
struct Spoken {
    std::string moment, text;
};
/// Of a tour each step's description and caption, a question with its choices, and its answer; of a free flight the goal
/// that is asked for, or its reward. Empty otherwise.
Spoken spoken_now(const Session& session, const SceneFile& scene);

/// Reads aloud what has become due since the last frame, where the exhibit speaks.
void speak(Session& session, const SceneFile& scene);

} // namespace starbow
