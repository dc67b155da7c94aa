#pragma once
#include "runtime/machines/picture_state.h"
#include "session.h"
#include <chrono>

namespace starbow {

/// Measures the frame rate over half a second, and writes the head-up display's text ten times a second.
class HudUpdater {
public:
    /// The text in the next frame. There is none if the visitor has switched the display off, and beside a test pattern
    /// without a message to the builder.
    std::optional<HudText> update(const Session& session, const SceneFile& scene, double exposure_ev);
    const HudText& written() const { return written_; } ///< the last text, also where it is not shown

private:
    using Clock = std::chrono::steady_clock;
    Readings readings_of(const Session& session, const SceneFile& scene, double exposure_ev) const;

    HudText written_;
    Clock::time_point written_at_{}, since_ = Clock::now();
    int frames_ = 0;
    double rate_ = 0; ///< frames a second
};

} // namespace starbow
