#pragma once
#include "session.h"
#include <chrono>

namespace starbow {

/// Measures the frame rate over half a second, and redraws the head-up display's panel ten times a second.
class HudUpdater {
public:
    /// The panel for the next frame, `width` pixels wide. It is null if the visitor has switched it off, or beside a test
    /// pattern without a message to the builder.
    const Panel* update(const Session& session, const SceneFile& scene, double exposure_ev, int width);

    const Panel* panel() const { return panel_.size.x > 0 ? &panel_ : nullptr; } ///< the last one, null before the first

    Typesetter typesetter;

private:
    using Clock = std::chrono::steady_clock;
    Readings readings_of(const Session& session, const SceneFile& scene, double exposure_ev) const;

    Panel panel_;
    Clock::time_point drawn_{}, since_ = Clock::now();
    int frames_ = 0;
    double rate_ = 0; ///< frames a second
};

} // namespace starbow
