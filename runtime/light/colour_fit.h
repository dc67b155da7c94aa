#pragma once
#include "colour_table.h"

namespace starbow {

/// Represents many spectra by a few coefficients so that sums of coefficients have the spectra's colours at every D: the
/// colours of a table are rows x columns, colours [row][coefficient] times coefficients [spectrum][coefficient]. The fit
/// is least squares in differences of colour: relative to a spectrum's own luminance in that row, and in each sensor by
/// the slope of CIELAB's cube root. It also weighs the rounding of stored coefficients to 11 bits, so that no sum
/// consists of large terms that cancel. The method alternates between rows and columns (weighted low-rank
/// approximation, Gabriel and Zamir 1979), from the spectra that differ most as a start.

/// The coefficients of each spectrum, [spectrum * count + coefficient], none above 1/4. first: the table that must fit
/// best; second: one that counts less. Both have the same spectra, more than `count`. importance: the factor of each
/// spectrum's errors.
std::vector<double> fit_columns(
    const ColourTable& first, const ColourTable& second, std::span<const double> importance, int count);

/// The colours of the coefficients in one row, that of the spectra's colours `seen`.
std::vector<glm::dvec3> fit_row(
    std::span<const glm::dvec3> seen, std::span<const double> importance, std::span<const double> columns, int count);

} // namespace starbow
