#pragma once
#include "config/model/layout.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// The unit direction that a point of a viewport with a warp file shows, the viewport's top left being (0, 0); nothing where
/// nothing is shown. The projection alone does not know.
using ViewRegion = std::function<std::optional<glm::dvec3>(const Output&, const Viewport&, glm::dvec2 pixel)>;

/// The part of the sky that one viewport shows to one eye.
struct Coverage {
    int output, viewport; ///< in the layout and in the output
    Eye eye; ///< left or right, or middle where the layout has one eye
    ViewportObserver observer{};
    glm::ivec2 size{0}; ///< pixels that the eye's picture of it has

    /// Azimuth to the right and elevation in degrees, from -180 to 180 and from -90 to 90: closed outlines that enclose what
    /// is shown by the even-odd rule. Where it goes on behind the map's edge they run along that edge.
    std::vector<std::vector<glm::dvec2>> outlines;

    double share = 0; ///< of the whole sphere
    std::optional<glm::dvec2> azimuths; ///< from, to, the latter the larger and maybe beyond 180; nothing: all around
    glm::dvec2 elevations{0}; ///< lowest, highest; of nothing shown 0
    std::optional<glm::dvec3> looks; ///< what the picture's middle shows
    double middle = 0, least = 0, most = 0; ///< pixels per degree; in the picture's middle 0 where nothing is shown there
    std::vector<bool> cells; ///< what of the sphere it shows: rows from the lowest, each `lattice` cells to the degree
};

/// Cells to a degree of the lattice that coverages are counted on.
constexpr int lattice = 2;
constexpr int lattice_columns = 360 * lattice, lattice_rows = 180 * lattice;

/// The middle of a cell, azimuth and elevation in degrees.
glm::dvec2 lattice_point(int column, int row);

/// In the layout's order; of a layout with two eyes first all of the left eye, then of the right. Exact but for the lattice:
/// shares to about a hundredth of themselves for a view of 10 degrees, outlines to 0.01 degrees, corners rounded by a cell.
std::vector<Coverage> coverages(const Layout& layout, const ViewRegion& sight = {});

/// Of what the first shows, the part that the second shows too; 0 where the first shows nothing.
double shared_part(const Coverage& first, const Coverage& second);

/// To the right by the azimuth, then up by the elevation.
glm::dvec3 direction_of(glm::dvec2 azimuth_elevation_deg);
glm::dvec2 azimuth_elevation_deg(const glm::dvec3& direction);

} // namespace starbow
