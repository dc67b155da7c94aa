#pragma once
#include "layout.h"
#include "patch.h"

namespace starbow {

/// A number of a layout that a builder may turn on site, with the picture before the eyes.
struct Adjustable {
    std::string name; ///< for people: "dome, tilt"
    std::string pointer; ///< to its place in the layout's file
    std::size_t output = 0, viewport = 0;
    enum class What { tilt, rotation, yaw, pitch, roll, blend_power, hud_elevation } what = What::tilt;
    double step = 0.1; ///< of one key press: degrees, or the power's own unit
};

/// All of a layout's: of each viewport its dome's tilt and rotation or its picture's turn, of all the blend's power and the
/// head-up display's height.
std::vector<Adjustable> adjustables(const Layout& layout);

double value_of(const Layout& layout, const Adjustable& adjustable);

/// The layout with one number turned by `steps`, kept in the range that its file may have.
Layout adjusted(Layout layout, const Adjustable& adjustable, double steps);

/// What differs, as changes of the first layout's file.
std::vector<Change> changes(const Layout& saved, const Layout& now);

} // namespace starbow
