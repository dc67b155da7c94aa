#pragma once
#include <array>
#include <cstddef>
#include <utility>

namespace starbow {

/// The skew of the outputs' pictures of one frame, over a flight.
class Skew {
public:
    bool on_screen = false; ///< timed when the driver shows the pictures; otherwise when the window system gets them
    void add(double s);
    std::size_t frames() const { return frames_; }
    double median_s() const; ///< median of the last 4096 frames; 0 before the first
    double worst_s() const { return worst_; } ///< worst of all frames
    double take_worst_s() { return std::exchange(worst_lately_, 0); } ///< worst since the last call

private:
    std::array<float, 4096> last_{};
    std::size_t frames_ = 0;
    double worst_ = 0, worst_lately_ = 0;
};

} // namespace starbow
