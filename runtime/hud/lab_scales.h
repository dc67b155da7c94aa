#pragma once
#include "hud.h"
#include <vector>

namespace starbow {

/// A scale that an instrument's strip has: from `low` to `high`, logarithmic, with ticks of which every fifth is longer and
/// every tenth has its number.
struct LabScale {
    struct Tick {
        double at;
        int rank; ///< 0: short, 1: longer, 2: with its number
    };
    double low = 1, high = 10;
    std::vector<Tick> ticks;

    /// The place of a value between the ends, 0 to 1; beyond them for values beyond.
    double across(double value) const;
};

/// The spectroscope's scale, nm, on which a wavelength lies: 2.4 times as far from end to end. It changes in steps of 2, so
/// that it tells no more of the wavelength than its numbers do.
LabScale spectroscope_scale(double nm);
/// The photometer's scale, on which a light lies: one power of ten with room to each side.
LabScale photometer_scale(double light);

/// The spectroscope: a dark strip with the line of `nm` as bright as any, as wide as its slit, above its scale; and a
/// sentence. The strip is to be read to a third of a short tick.
constexpr double slit_part = 0.004; ///< standard deviation of the line over its wavelength
Panel draw_spectroscope(const Typesetter& typesetter, const Words& words, double nm, glm::ivec2 size);
/// The photometer: a bar as bright as `light` above steps of a tenth's tenth root, whose values are at the scale, and a
/// sentence. A step is 12 % brighter than the one before.
constexpr double photometer_steps = 20; ///< for a power of ten
Panel draw_photometer(const Typesetter& typesetter, const Words& words, double light, glm::ivec2 size);

/// Draws lines of text from the top of an empty plate, as large as they fit.
Panel draw_lines(const Typesetter& typesetter, const std::vector<std::string>& lines, glm::ivec2 size);

} // namespace starbow
