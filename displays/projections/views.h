#pragma once
#include "picture.h"
#include <span>
#include <vector>

namespace starbow {

/// A view: one eye's part of an output, made from a viewport by the packing. The renderer has no other description of a
/// display.
struct View {
    std::size_t output, viewport; ///< of the layout; in a preview those of the shown output
    int layer = 0; ///< index of the output's layer: the views of one layer share no pixels
    int canvas = 0; ///< index of the packing's canvas: 1 is the right eye's where each eye has a whole picture
    glm::ivec2 corner{0}, size{1}; ///< pixels of the canvas
    Picture picture;
    bool projection_given = true; ///< as the viewport's
    glm::dvec2 picture_from_pixel{1}; ///< the view's point p, in pixels from its corner, is the picture's p * this
    Eye eye = Eye::middle;
    ViewportObserver observer{};
    glm::dvec3 head_m{0}; ///< between the eyes; picture.eye_m is this eye
};

/// The layer of each viewport of an output: the first in which it overlaps none before it. All are 0 where none overlap.
std::vector<int> layers_of(const Output& output);

/// The number of a packing's canvases: 1, or 2 where each eye has a picture of the whole output's size.
int canvas_count(Packing packing);

/// All views of an output of the layout, in the order of its viewports, left before right. size: pixels; it may differ from
/// the layout's.
std::vector<View> views_of(const Layout& layout, std::size_t output, glm::ivec2 size);

/// The places of the layout's other outputs in a preview of `size` pixels: x, y, width, height; nullopt for the preview
/// itself.
std::vector<glm::ivec4> preview_cells(const Layout& layout, std::size_t preview, glm::ivec2 size);

} // namespace starbow
