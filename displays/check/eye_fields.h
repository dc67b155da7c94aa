#pragma once
#include "config/model/layout.h"
#include <vector>

namespace starbow {

/// The layout with the light that its eyes see, for measuring that light in pictures: no curve of a screen's input and no
/// ramps between projectors, no operator's window, and a place of its own for each eye's pixels where a packing mixes the
/// eyes. Its pixels are coarser: nearly all of an output's are at most pixel_rad wide, and no picture is enlarged. Throws
/// InputError for a layout that can be read but not drawn.
Layout seen_layout(Layout layout, double pixel_rad);

/// A pixel of an output's picture as an eye sees it.
struct EyePixel {
    std::size_t output; ///< of the layout
    glm::ivec2 at; ///< from the output's top left
    glm::dvec3 direction; ///< unit, the cockpit's frame
    double solid_angle_sr; ///< of the eye's sky; where several pixels show one direction, each has its part
    glm::dvec3 factor, addend; ///< of the light that is seen, by masks and calibrations: shown = seen * factor + addend
};

/// All that one eye sees of one observer's sky.
struct EyeField {
    Eye eye = Eye::middle;
    ViewportObserver observer;
    std::vector<EyePixel> pixels; ///< without those that show nothing, or hardly any light
};

/// What the eyes see of a layout that seen_layout returned: the left and the right eye, or the middle where the layout has
/// one eye. A viewport without an eye of its own belongs to both. Throws InputError.
std::vector<EyeField> eye_fields(const Layout& seen);

} // namespace starbow
