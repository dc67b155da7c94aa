#pragma once
#include <string>

namespace starbow {

struct ReplayOptions {
    std::string replay, layout, out, size, frames, language; ///< size: "" as the layout's; frames: "A:B", "" for all
    long every = 1;
    bool hud = false;
};

/// Flies a record again off-screen and writes its frames as OUT/<output>-<frame>.png. Returns the exit status.
int render_replay(const ReplayOptions& options);

} // namespace starbow
