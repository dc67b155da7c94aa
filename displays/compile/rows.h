#pragma once
#include <algorithm>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace starbow {

/// Calls work(first row, one past the last) for bands of whole rows, on all cores. The result does not depend on the number
/// of threads where no row depends on another. What a band throws is thrown here, once all have ended.
template <class Work> void by_rows(int rows, Work&& work)
{
    const int bands = std::clamp(int(std::thread::hardware_concurrency()), 1, std::max(rows, 1));
    std::vector<std::exception_ptr> thrown(std::size_t(bands) - 1);
    auto first = [&](int band) { return int(std::int64_t(rows) * band / bands); };
    {
        std::vector<std::jthread> threads;
        for (int band = 1; band < bands; ++band)
            threads.emplace_back([&, band] {
                try {
                    work(first(band), first(band + 1));
                } catch (...) {
                    thrown[std::size_t(band) - 1] = std::current_exception();
                }
            });
        work(0, first(1));
    }
    for (const std::exception_ptr& one : thrown)
        if (one)
            std::rethrow_exception(one);
}

} // namespace starbow
