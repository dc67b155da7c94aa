#pragma once
#include "config/json/reader.h"
#include "exposing.h"

namespace starbow {

/// Reads the members that an exhibit's file and a flight's record share.
Exposing read_exposing(const Place& place);

} // namespace starbow
