#include "skew.h"
#include <algorithm>

namespace starbow {

void Skew::add(double s)
{
    last_[frames_ % last_.size()] = float(s);
    ++frames_;
    worst_ = std::max(worst_, s);
    worst_lately_ = std::max(worst_lately_, s);
}

double Skew::median_s() const
{
    std::array<float, 4096> sorted = last_;
    const std::size_t count = std::min(frames_, sorted.size());
    if (count == 0)
        return 0;
    std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.begin() + count);
    return sorted[count / 2];
}

} // namespace starbow
