#pragma once
#include "config/json/patch.h"
#include "layout.h"

namespace starbow {

/// A number of a layout that a builder may turn on site, with the picture before the eyes.
struct Adjustable {
    std::string name; ///< for people: "dome, tilt"
    /// Where it stands in the layout's file. Several where projectors share a dome and the number: they are turned together.
    struct Spot {
        std::string pointer;
        std::size_t output = 0, viewport = 0;
    };
    std::vector<Spot> spots;
    enum class What { tilt, rotation, yaw, pitch, roll, blend_power, hud_elevation } what = What::tilt;
    double step = 0.1; ///< of one key press: degrees, or the power's own unit
};

/// All of a layout's: of all domes that agree on it the tilt and the rotation, of each viewport its dome's or its picture's
/// turn, of all the blend's power and the head-up display's height.
std::vector<Adjustable> adjustables(const Layout& layout);

double value_of(const Layout& layout, const Adjustable& adjustable);

/// The layout with one number turned by `steps`, kept in the range that its file may have.
Layout adjusted(Layout layout, const Adjustable& adjustable, double steps);

/// What differs, as changes of the first layout's file. What the first has not is left out.
std::vector<Change> changes(const Layout& saved, const Layout& now);

/// A layout that was read anew, with what was turned since it was read before (from `kept` to `turned`): but for numbers
/// that the file itself has changed.
Layout turned_again(Layout fresh, const Layout& kept, const Layout& turned);

} // namespace starbow
