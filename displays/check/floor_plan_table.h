#pragma once
#include "coverage.h"

namespace starbow {

/// A coverage as a row of text, for exhibit builders.
struct FloorPlanRow {
    int output; ///< in the layout
    std::string name; ///< "wall", or "wall/1" where the output has several viewports; with two eyes it names the eye
    std::string projection; ///< "fisheye (equidistant), 180° across, tilted 30°"
    std::string spans; ///< "azimuth −40° to 40°, elevation −31.2° to 31.2°"
    std::string sky; ///< "7.8 %"
    std::string pixels; ///< "800 x 600"
    std::string per_degree; ///< "9.1 in the middle, 9.1 to 15.3"
};

/// A row for each coverage of the layout; a viewport that shows both eyes alike has one row for both.
std::vector<FloorPlanRow> floor_plan_rows(const Layout& layout, const std::vector<Coverage>& coverages);

/// A line for each pair of coverages of one eye that share more than a thousandth of either, largest first. Equal lines
/// of both eyes are merged.
std::vector<std::string> overlap_lines(const Layout& layout, const std::vector<Coverage>& coverages);

std::string viewport_name(const Layout& layout, int output, int viewport);
std::string packing_words(Packing packing); ///< "side by side, half"

/// A number with at most one decimal and a minus sign of full width.
std::string short_number(double number);

} // namespace starbow
