#pragma once
#include "controls.h"

namespace starbow {

/// The demands of the exhibit and its docent on a frame's flight. They act as the switches do, but nobody has pressed them.
struct Requests {
    Switches made, withheld;
    bool hands_in_menu = false; ///< the visitors' hands steer a menu, and nothing of them reaches the ship

    /// Demands that a switch acts, or that it does not even where it is pressed. The last demand holds.
    void set(Switch which, bool acts = true) { made.set(which, acts), withheld.set(which, !acts); }
    /// Adds later demands.
    void add(const Requests& later)
    {
        made = (made - later.withheld) | later.made, withheld = (withheld - later.made) | later.withheld;
        hands_in_menu |= later.hands_in_menu;
    }
};

/// The controls that fly: the hands' with the requests. It may be applied again to its own result.
inline Controls requested(Controls controls, const Requests& requests)
{
    if (requests.hands_in_menu) {
        static_cast<Steering&>(controls) = {.lever = controls.lever, .taken = controls.taken};
        static_cast<Switches&>(controls) = controls - switches_of(Presser::pilot);
    }
    static_cast<Switches&>(controls) = (controls - requests.withheld) | requests.made;
    return controls;
}

} // namespace starbow
