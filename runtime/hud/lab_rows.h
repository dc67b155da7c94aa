#pragma once
#include "lab_quantities.h"
#include <span>

namespace starbow {

/// One measurement of the worksheet, at a shot's first instant or, without points, in a flight that begins there.
struct LabRow {
    std::string_view no, shot;
    std::string_view keys; ///< pressed in addition to the shot's effects; a ratio is that of the light with them over the
                           ///< light without
    std::string_view effects; ///< of --effects: the same for a still; empty without keys
    std::string_view points; ///< of --measure: one to aim at, or two that are marked
    LabQuantity of;
    double theory; ///< in the quantity's unit, to seven figures: more than any reading needs
    double error; ///< of an aim that is 0.1 degrees off, and of the instruments
    Key when; ///< in a flight: the moment
};

/// Every measurement of the worksheet, in order; docs/lab.md has the same rows.
std::span<const LabRow> lab_rows();

/// A section of the worksheet, which its rows' numbers begin with.
struct LabSection {
    char letter;
    Key says, formula;
};
const LabSection& section_of(const LabRow& row);

/// True if one still shows a row's quantity. By eye the direction where D is 1 needs a turn, with the spectrum's line in
/// view.
bool has_still(const LabRow& row, bool by_eye);
/// The command that draws a row's still. by_eye: with the instrument that is read, and without figures; otherwise it prints
/// the figures.
std::string still_command(const LabRow& row, bool by_eye);

} // namespace starbow
