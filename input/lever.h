#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace starbow {

/// A throttle's lever, as its device tells now.
struct Lever {
    std::string device; ///< the same again when it is plugged in anew
    int axis = 0;
    double place = 0; ///< 0 to 1
    std::int64_t moved_ns = 0; ///< as AxisHealth has it
};

/// Which of several levers counts: many sticks have a small one of their own beside the throttle that a visitor holds.
class LeverChoice {
public:
    /// The place of the lever that was moved last; of several that no one has moved yet, the lowest. When that one's device
    /// is unplugged, none counts until another is moved or it is back: a forgotten lever must not seize the ship.
    std::optional<double> place(std::span<const Lever> levers, std::int64_t now_ns);

private:
    std::string device_; ///< of the lever that counts; empty: none has yet
    int axis_ = 0;
    bool there_ = false;
    std::int64_t claim_ns_ = 0; ///< another must have been moved later than this
};

} // namespace starbow
