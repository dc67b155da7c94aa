#pragma once
#include "config/model/layout.h"
#include "config/model/shot.h"
#include "world.h"

namespace starbow {

/// An observer's view of one of the world's rest frames.
struct RestFrameView {
    Shot shot; ///< the observer's instant in that frame's coordinates
    double E = 1; ///< e^rapidity of the aberration from that frame to the observer
    glm::dmat3 motion_from_frame{1}, motion_from_cockpit{1}; ///< turns
    bool now = false; ///< everything is shown at the ship's present: see EyeEvent
    double contraction = 1, beta = 0;
};

/// An observer at the ship's event: the visitor, or a viewport's own observer.
struct Observer {
    ViewportObserver observer;
    Shot shot; ///< the observer's instant in the world
    double E = 1; ///< e^rapidity in the world
    std::vector<RestFrameView> rest_frames; ///< by the world's rest frames, the world first
    double most_E() const; ///< the greatest E of all rest frames
};

/// The observer of a viewport. With Shot's comparison "now", everything is shown where it is simultaneous in the ship and
/// contracted, without aberration or shift. Without aberration, directions are those of an observer at rest in the world.
/// before: a list whose memory is reused.
Observer observer_of(
    const World& world, const Shot& ship, const ViewportObserver& observer, std::vector<RestFrameView> before = {});

/// The instant of a viewport's observer: the ship's event with another velocity. The boost between the two carries the
/// axes.
Shot shot_of(const Shot& ship, const ViewportObserver& observer);

} // namespace starbow
