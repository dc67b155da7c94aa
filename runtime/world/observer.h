#pragma once
#include "config/model/layout.h"
#include "config/model/shot.h"
#include "world.h"

namespace starbow {

/// Someone who looks, before what stands still in one of the world's frames.
struct RestFrameView {
    Shot shot; ///< the instant, as that frame has it
    double E = 1; ///< e^rapidity of directions, from that frame to the observer's
    glm::dmat3 motion_from_frame{1}, motion_from_cockpit{1}; ///< turns
    bool now = false; ///< everything is shown where it is now: EyeEvent's members
    double contraction = 1, beta = 0;
};

/// Someone who looks at the ship's place and time: the visitor, or another observer that a viewport has.
struct Observer {
    ViewportObserver observer;
    Shot shot; ///< his instant
    double E = 1; ///< e^rapidity in the world
    std::vector<RestFrameView> layers; ///< of the world's frames, the world first
    double most_E() const; ///< of the rapidities in all frames
};

/// Everything where it is now: what is simultaneous in the ship, contracted there, without aberration or shift.
/// Without aberration directions are those that someone sees who rests in the world.
Observer observer_of(const World& world, const Shot& ship, const ViewportObserver& observer,
    std::vector<RestFrameView> before = {}); ///< before: whose memory is taken over

/// The ship's instant for an observer: its event, another velocity, the axes carried there by the boost between them.
Shot shot_of(const Shot& ship, const ViewportObserver& observer);

} // namespace starbow
