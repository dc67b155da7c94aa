#pragma once
#include "head_tracker.h"
#include "hid.h"
#include "keyboard.h"
#include <memory>

namespace starbow {

/// All devices of a visitor: keyboard, mouse and pads, sticks, and a head tracker.
class Devices {
public:
    using Clock = std::chrono::steady_clock;
    /// tracking: none: there is no head tracker. log: is called with a line for the log, from any thread.
    Devices(std::vector<Profile> profiles, const std::optional<HeadTracking>& tracking, LogTo log)
        : log_(log)
        , hid_(std::move(profiles), std::move(log))
    {
        track(tracking);
    }

    /// The controls at `now`, all devices together. windows, grabbed and time_ns: as Keyboard::read's. dt_s: since the last
    /// reading. left_handed: the hands change places.
    template <class Windows>
    Controls read(
        const Windows& windows, bool grabbed, std::int64_t time_ns, double dt_s, bool left_handed, Clock::time_point now)
    {
        Controls controls = keyboard_.read(windows, grabbed, time_ns, dt_s, hid_.kinds(), left_handed);
        hid_.left_handed(left_handed);
        hid_.add(dt_s, controls);
        if (tracker_)
            controls.head = tracker_->read(now);
        return controls;
    }
    /// True once after these characters were typed in a row.
    bool typed(std::string_view code) { return keyboard_.typed(code); }
    /// Keyboard::write and Keyboard::take_written.
    void write(bool writes) { keyboard_.write(writes); }
    std::string take_written() { return keyboard_.take_written(); }
    /// Another visitor's hands come: what the last ones have left tilted, open or held counts once it has reported again.
    void forget() { hid_.forget(), keyboard_.forget(); }
    /// Another layout has another head tracker, or none. One whose rules are the same goes on.
    void track(const std::optional<HeadTracking>& tracking)
    {
        if (tracker_ && tracking && tracker_->tracking() == *tracking)
            return;
        tracker_.reset(); // its port may be the next one's
        if (tracking)
            tracker_ = std::make_unique<HeadTracker>(*tracking, log_);
    }

    const Hid& hid() const { return hid_; }
    const HeadTracker* tracker() const { return tracker_.get(); } ///< null: there is none

private:
    LogTo log_;
    Keyboard keyboard_;
    Hid hid_;
    std::unique_ptr<HeadTracker> tracker_;
};

} // namespace starbow
