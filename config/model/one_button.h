#pragma once

namespace starbow {

/// Flying with one button: the choices are shown in turn, and a press takes the shown one.
struct OneButton {
    double scan_s = 1.5; ///< each choice is shown for so long
    double act_s = 1; ///< a short press acts for so long
};

} // namespace starbow
