#pragma once
#include <algorithm>
#include <vector>

namespace starbow {

/// The middle of the values in order; of an even number of them the upper one. There is at least one.
inline double median(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace starbow
