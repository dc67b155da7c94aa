#pragma once
#include "config/model/layout.h"

namespace starbow {

/// The matrices that combine two eyes in one colour picture, linear Rec. 709.
struct Anaglyph {
    glm::dmat3 left, right;
};

/// nullopt for packings without coloured glasses.
inline std::optional<Anaglyph> anaglyph(Packing packing)
{
    // Written row by row. Red-cyan keeps every channel as it is. The other two are Eric Dubois's least-squares matrices for
    // sRGB primaries and typical glasses, made for linear light (A projection method to generate anaglyph stereo images,
    // 2001, and its tables).
    auto rows = [](const glm::dmat3& left, const glm::dmat3& right) {
        return Anaglyph{glm::transpose(left), glm::transpose(right)};
    };
    switch (packing) {
    case Packing::anaglyph_red_cyan:
        return rows({1, 0, 0, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 1, 0, 0, 0, 1});
    case Packing::anaglyph_dubois:
        return rows({0.4561, 0.500484, 0.176381, -0.0400822, -0.0378246, -0.0157589, -0.0152161, -0.0205971, -0.00546856},
            {-0.0434706, -0.0879388, -0.00155529, 0.378476, 0.73364, -0.0184503, -0.0721527, -0.112961, 1.2264});
    case Packing::anaglyph_amber_blue:
        return rows({1.062, -0.205, 0.299, -0.026, 0.908, 0.068, -0.038, -0.173, 0.022},
            {-0.016, -0.123, -0.017, 0.006, 0.062, -0.017, 0.094, 0.185, 0.911});
    default:
        return {};
    }
}

} // namespace starbow
