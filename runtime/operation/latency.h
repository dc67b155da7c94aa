#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace starbow {

/// The stations of one frame, nanoseconds of the steady clock.
struct FrameTimes {
    std::int64_t report_ns = 0; ///< arrival of the last device report that the frame shows; 0: none yet
    std::int64_t read_ns = 0; ///< the controls are read
    std::int64_t handed_ns = 0; ///< the program's own part is done; the present call begins
    std::int64_t shown_ns = 0; ///< the present call has returned
    bool compiled = false; ///< the frame made pipelines, which a flight does once
};

/// The percentile by nearest rank: the smallest value such that at least `part` (above 0, up to 1) of the values do not
/// exceed it. 0 without values.
double percentile(std::vector<double> values, double part);

/// The latency from a device to the screen, over the frames of a flight. A frame that made pipelines tells of the compiler
/// and not of the flight, and the frame after it shows reports that waited for the compiler: both are counted apart.
class Latency {
public:
    void add(const FrameTimes& times);

    std::size_t frames() const { return own_ms_.size(); }
    std::size_t reports() const { return report_ms_.size(); } ///< frames that were the first to show a report
    double seconds() const { return frames() ? 1e-9 * double(last_.shown_ns - first_ns_) : 0; } ///< first to last frame

    std::size_t apart() const { return apart_ms_.size(); } ///< frames in which, or before which, pipelines were made

    /// A table for people.
    std::string describe() const;

    // Milliseconds, one for each frame, or for each frame that shows a new report.
    const std::vector<double>& report_ms() const { return report_ms_; } ///< its arrival to the present call's return
    const std::vector<double>& frame_ms() const { return frame_ms_; } ///< from one present call's return to the next
    const std::vector<double>& own_ms() const { return own_ms_; } ///< controls read to the present call: no waiting
    const std::vector<double>& present_ms() const { return present_ms_; } ///< the present call, which may wait
    /// From a reading of the controls, or a report that arrived later than it, to the return of the next frame's present
    /// call. No report takes longer, whenever it arrives.
    const std::vector<double>& bound_ms() const { return bound_ms_; }

private:
    FrameTimes last_; ///< of any frame; before the first all are 0
    std::int64_t first_ns_ = 0;
    std::vector<double> report_ms_, frame_ms_, own_ms_, present_ms_, bound_ms_, apart_ms_;
};

} // namespace starbow
