#pragma once
#include "lab_class.h"
#include <span>

namespace starbow {

/// A part of a page: the groups' readings in a picture of deviations in uncertainties, and their statistics by group and by
/// quantity.
std::string readings_section(std::span<const LabGroup> groups, const Words& words);

/// All readings as a CSV text (RFC 4180): group, quantity, line of its file, reading, uncertainty, theory, deviation in
/// uncertainties. Empty without readings.
std::string readings_csv(std::span<const LabGroup> groups);
/// The first column's name with the comma behind it, with which the CSV texts of a class begin.
inline constexpr std::string_view class_csv_begin = "group,";

} // namespace starbow
