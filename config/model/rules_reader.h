#pragma once
#include "config/json/reader.h"
#include "exposing.h"
#include "flying.h"

namespace starbow {

// An exhibit's rules that a flight's record holds, too. Throw InputError.

Comfort read_comfort(const Place& place);
/// Without the members that have their usual values.
nlohmann::ordered_json written_comfort(const Comfort& comfort);
Exposing read_exposing(const Place& place);

} // namespace starbow
