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
    /// Turns into the axes of the cube map. Below about half the speed of light they are those of an observer at rest: z
    /// straight ahead, y the cockpit's up. A change of the heading then moves no texel, as it hardly moves the picture.
    /// Above, they are the motion axes: there float directions keep their precision, and the tiles follow D.
    glm::dmat3 cube_from_frame{1}, cube_from_motion{1};
    bool aligned() const { return cube_from_motion == glm::dmat3(1); } ///< the cube map has the motion axes
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
/// before: the same observer's rest frames in the picture before, or none; its memory is reused. Axes of cube maps change
/// only at a speed somewhat above or below the one at which they changed before, so that they don't flicker between two.
Observer observer_of(
    const World& world, const Shot& ship, const ViewportObserver& observer, std::vector<RestFrameView> before = {});

/// The instant of a viewport's observer: the ship's event with another velocity. The boost between the two carries the
/// axes.
Shot shot_of(const Shot& ship, const ViewportObserver& observer);

} // namespace starbow
