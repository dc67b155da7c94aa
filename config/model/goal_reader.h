#pragma once
#include "config/json/reader.h"
#include "goal.h"

namespace starbow {

/// Reads a scene's goals. Throws InputError.
std::vector<Goal> read_goals(const Place& place);

} // namespace starbow
