#pragma once
#include "config/json/reader.h"
#include "flying.h"

namespace starbow {

/// Reads the member "comfort" of an exhibit or of a record.
Comfort read_comfort(const Place& place);

} // namespace starbow
