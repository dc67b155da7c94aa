#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// The present state of a throttle's lever.
struct Lever {
    std::string device; ///< the same again after it is plugged in anew
    int axis = 0;
    double place = 0; ///< 0 to 1
    std::int64_t moved_ns = 0; ///< as AxisHealth::moved_ns
};

/// Chooses among several levers: many sticks have a small one of their own beside the throttle that a visitor holds.
class LeverChoice {
public:
    /// The place of the lever that was moved last; of several unmoved ones, the lowest. When its device is unplugged, none
    /// counts until another is moved or the device is back: a forgotten lever must not seize the ship.
    std::optional<double> place(std::span<const Lever> levers, std::int64_t now_ns);

private:
    std::string device_; ///< of the chosen lever; empty: none yet
    int axis_ = 0;
    bool there_ = false;
    std::int64_t claim_ns_ = 0; ///< another lever must have been moved later than this
};

} // namespace starbow
