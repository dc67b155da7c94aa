#pragma once
#include "session.h"

namespace starbow {

/// Has a new text read aloud where the exhibit speaks: of a tour each step's description and caption, a question with its
/// choices, and the answer; of a free flight the requested goal, or its reward. A text begins with its moment, and does not
/// begin anew with the numbers in it.
void speak(Session& session, const SceneFile& scene);

} // namespace starbow
