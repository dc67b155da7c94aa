#pragma once
#include <algorithm>
#include <cstdint>
#include <thread>
#include <vector>

namespace starbow {

/// Calls work(first row, one past the last) for bands of whole rows, on all cores. The result does not depend on the number
/// of threads where no row depends on another.
template <class Work> void by_rows(int rows, Work&& work)
{
    const int bands = std::clamp(int(std::thread::hardware_concurrency()), 1, std::max(rows, 1));
    std::vector<std::jthread> threads;
    auto first = [&](int band) { return int(std::int64_t(rows) * band / bands); };
    for (int band = 1; band < bands; ++band)
        threads.emplace_back([&, band] { work(first(band), first(band + 1)); });
    work(0, first(1));
}

} // namespace starbow
