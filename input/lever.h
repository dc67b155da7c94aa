#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// The present state of a throttle's lever.
struct Lever {
    std::string device; ///< the same after it is plugged in again
    int axis = 0;
    double place = 0; ///< 0 to 1
    std::int64_t moved_ns = 0; ///< as AxisHealth::moved_ns
};

/// Chooses among several levers: many sticks have a small one of their own beside the visitor's throttle.
class LeverChoice {
public:
    /// The place of the lever moved last; among unmoved ones, the lowest. After its device is unplugged there is none
    /// until another is moved or the device is back, so that a forgotten lever can't seize the ship.
    std::optional<double> place(std::span<const Lever> levers, std::int64_t now_ns);

private:
    std::string device_; ///< of the chosen lever; empty: none yet
    int axis_ = 0;
    bool there_ = false;
    std::int64_t claim_ns_ = 0; ///< another lever must have been moved later than this
};

} // namespace starbow
