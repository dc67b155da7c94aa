#pragma once
#include "localised_text.h"
#include "measure.h"
#include <limits>
#include <vector>

namespace starbow {

/// A measure's number is at least `from` and below `below`.
struct GoalCondition {
    Measure measure;
    double from = -std::numeric_limits<double>::infinity(), below = std::numeric_limits<double>::infinity();
};

/// Something for a visitor to find or to do in a world. It is reached while all conditions hold.
struct Goal {
    LocalisedText ask, reward;
    std::vector<GoalCondition> conditions;
};

} // namespace starbow
