#pragma once
#include "config/model/information.h"
#include "film.h"

namespace starbow {

struct ReplayOptions {
    std::string replay, layout, out, size, frames, language; ///< size: "" as the layout's; frames: "A:B", "" for all
    FilmOptions film; ///< with a movie's name: a movie instead of frames
    long every = 1;
    bool hud = false;
    Information information = Information::laboratory; ///< on the head-up display
};

/// Flies a record again off-screen, and writes its frames as OUT/<output>-<frame>.png, or makes a movie of it. Returns the
/// exit status.
int render_replay(const ReplayOptions& options);

} // namespace starbow
