#pragma once
#include "exposing.h"
#include "reader.h"

namespace starbow {

/// The part that an exhibit's file and a flight's record share.
Exposing read_exposing(const Place& place);

} // namespace starbow
