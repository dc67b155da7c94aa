#pragma once
#include "config/json/reader.h"
#include "measure.h"

namespace starbow {

/// Reads a measure of a tour or a goal. Throws InputError.
Measure read_measure(const Place& place);

} // namespace starbow
