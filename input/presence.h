#pragma once
#include "controls.h"
#include <array>
#include <optional>

namespace starbow {

/// Decides whether somebody is there, from the controls that the health of the devices has let through. Only a change is
/// a sign: a stick that is left tilted, a book on a key, and an axis that is left out because it is worn, are nobody's.
class Presence {
public:
    /// Takes a frame's controls. dt_s: since the frame before. Returns true if a key or a button went down, an axis moved by
    /// more than a worn one's trembling, or a tracked head moved.
    bool take(const Controls& controls, double dt_s);

private:
    static constexpr std::size_t rates = 10;
    // The values after each one's last move:
    std::array<double, rates> resting_{};
    std::optional<double> lever_{};
    std::optional<Head> head_{};
};

/// The least move of an axis that counts; the axis runs to 1. A worn axis wanders by some hundredths, and a hand moves a
/// stick farther.
constexpr double least_move = 0.1;
/// The least move and turn of a head that count. A tracker's noise is some millimetres and tenths of a degree.
constexpr double least_head_m = 0.02, least_head_rad = 0.05;

} // namespace starbow
