#pragma once
#include "tour.h"

namespace starbow {

/// A tour that nobody touches, frame by frame.
class TourFilm {
public:
    /// The show must outlive the film; nobody visits it.
    TourFilm(const Show& show, long frames_per_s)
        : show_(show)
        , frames_per_s_(frames_per_s)
        , touring_(touring_at(show))
    {
    }
    /// The number of frames.
    long frames() const;
    /// A frame's time since the tour's start.
    std::int64_t time_ns(long frame) const;
    /// The tour at a frame, counted from 0; no frame before the last call's.
    const Touring& at(long frame);

private:
    const Show& show_;
    long frames_per_s_, frame_ = 0;
    Touring touring_;
};

} // namespace starbow
