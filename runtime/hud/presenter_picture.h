#pragma once
#include "presenter_sheet.h"
#include "small_picture.h"
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace starbow {

class Typesetter;

/// A rectangle of the window, pixels.
struct PresenterBox {
    glm::ivec2 corner{0}, size{0};
    bool holds(glm::ivec2 at) const
    {
        return glm::all(glm::greaterThanEqual(at, corner)) && glm::all(glm::lessThan(at, corner + size));
    }
};

/// The places of a sheet's parts in a window.
struct PresenterPlaces {
    PresenterBox picture, facts, programme, cues, list, said; ///< programme: of size 0 where there is none
    std::vector<PresenterBox> choices, keys; ///< in the sheet's order
};
PresenterPlaces places_of(const PresenterSheet& sheet, glm::ivec2 size);

/// The part of the picture's place that a picture of this size fills, in its own shape; of size 0: nothing.
PresenterBox shown_box(const PresenterBox& place, glm::ivec2 picture);

/// The key at a place of the window; 0: none.
int key_at(const PresenterSheet& sheet, glm::ivec2 size, glm::ivec2 at);

/// The window's pixels, four bytes each (red, green, blue, opaque; or blue first), sRGB, from the top.
struct PresenterPicture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> texels;
    double tightest = 1; ///< the smallest part of its planned size that a label, a state or a choice was shrunk to
};
/// Paints a sheet. out: receives the picture; its memory is used again.
void paint(const PresenterSheet& sheet, const SmallPicture& view, const Thumbnails& thumbnails, const Typesetter& typesetter,
    glm::ivec2 size, bool blue_first, PresenterPicture& out);

} // namespace starbow
