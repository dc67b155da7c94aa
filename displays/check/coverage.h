#pragma once
#include "config/model/layout.h"
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// The unit direction that a point of a warped viewport shows, counted from the viewport's top left; nullopt where
/// nothing is shown. The projection alone lacks the warp.
using ViewRegion = std::function<std::optional<glm::dvec3>(const Output&, const Viewport&, glm::dvec2 pixel)>;

/// The part of the sky that one viewport shows to one eye. What viewports of a higher order hide does not count.
struct Coverage {
    int output, viewport; ///< in the layout and in the output
    Eye eye; ///< left or right, or middle where the layout has one eye
    ViewportObserver observer{};
    glm::ivec2 size{0}; ///< of the eye's picture

    /// Closed outlines that enclose the shown part by the even-odd rule. A point is an azimuth to the right, -180 to 180
    /// degrees, and an elevation, -90 to 90. At the map's edge they run along that edge.
    std::vector<std::vector<glm::dvec2>> outlines;

    double share = 0; ///< of the whole sphere
    std::optional<glm::dvec2> azimuths; ///< from, to; the latter is larger and may exceed 180; nullopt: all around
    glm::dvec2 elevations{0}; ///< lowest, highest; 0 where nothing is shown
    std::optional<glm::dvec3> looks; ///< the direction of the picture's middle
    double middle = 0, least = 0, most = 0; ///< pixels per degree; `middle` is 0 where the picture's middle shows nothing
    std::vector<bool> cells; ///< the shown cells of the sphere: rows from the lowest, each `lattice` cells to the degree
};

/// Cells per degree of the lattice on which coverages are counted.
constexpr int lattice = 2;
constexpr int lattice_columns = 360 * lattice, lattice_rows = 180 * lattice;

/// The middle of a cell, azimuth and elevation in degrees.
glm::dvec2 lattice_point(int column, int row);

/// The coverages in the layout's order; with two eyes first all of the left eye, then of the right. They are exact to the
/// lattice: shares to about a hundredth of themselves for a view of 10 degrees, outlines to 0.01 degrees. Corners are
/// rounded by a cell.
std::vector<Coverage> coverages(const Layout& layout, const ViewRegion& sight = {});

/// The part of the first coverage that the second shows too; 0 where the first shows nothing.
double shared_part(const Coverage& first, const Coverage& second);

} // namespace starbow
