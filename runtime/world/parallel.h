#pragma once
#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace starbow {

/// Calls work(i) for 0 to count - 1 in all processors; shows the done part from `from` to `to`.
inline void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work,
    const std::function<void(double)>& progress, double from, double to)
{
    std::atomic<std::size_t> next = 0;
    const auto run = [&](bool shows) {
        for (std::size_t i = next++; i < count; i = next++) {
            work(i);
            if (shows && progress)
                progress(from + (to - from) * double(i) / double(count));
        }
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
        threads.emplace_back([&] { run(false); });
    run(true);
}

} // namespace starbow
