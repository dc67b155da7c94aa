#pragma once
#include <chrono>
#include <sys/resource.h>
#include <thread>
#include <time.h>

namespace starbow::testing {

/// Waits until the condition holds. Returns false after a minute, which no machine needs for what a test waits for.
template <class Condition> bool until(Condition&& condition)
{
    for (const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1); !condition();) {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

/// Processor time of this process, all its threads together, s. It hardly depends on what else the machine does.
inline double processor_seconds()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// The time that a step of the calling thread takes by its own doing, s. A step that sleeps or waits for another thread
/// takes all of its time; any other takes its time on the processor, without the time that the machine gives to others
/// meanwhile.
template <class Step> double own_seconds(Step&& step)
{
    const auto waits = [] {
        rusage used{};
        getrusage(RUSAGE_THREAD, &used);
        return used.ru_nvcsw;
    };
    const auto worked_s = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
    };
    const long waits_before = waits();
    const double worked_before_s = worked_s();
    const auto began = std::chrono::steady_clock::now();
    step();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    return waits() > waits_before ? took.count() : worked_s() - worked_before_s;
}

} // namespace starbow::testing
