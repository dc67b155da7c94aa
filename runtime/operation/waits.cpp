#include "waits.h"
#include "config/json/folder.h"
#include "config/json/whole_file.h"
#include "log.h"
#include "messages.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <new>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace starbow {
namespace {

/// Limit of a wait where nobody watches, s: commands such as `render` draw pictures that take minutes.
constexpr double unwatched_s = 600;
constexpr std::chrono::milliseconds look_every(100);

/// The open waits of the thread that draws, the innermost last. Never destroyed, because the process may end anywhere.
struct OpenWaits {
    std::mutex mutex;
    std::vector<LimitedWait*> waits;
    double limit_s = unwatched_s;
};
OpenWaits& open_waits()
{
    static auto& only = *new OpenWaits;
    return only;
}

/// The time that this process' threads have computed, and have waited for a processor while they could compute, s; zeros
/// where the system does not say.
std::pair<double, double> thread_times()
{
    std::pair<double, double> sum{0, 0};
    try {
        each_entry("/proc/self/task", [&](const char* task) {
            double computed_ns = 0, starved_ns = 0;
            std::array<char, 100> text{};
            RegularFile(std::filesystem::path("/proc/self/task") / task / "schedstat")
                .read(std::span(text).first(text.size() - 1));
            if (std::sscanf(text.data(), "%lf %lf", &computed_ns, &starved_ns) == 2)
                sum.first += 1e-9 * computed_ns, sum.second += 1e-9 * starved_ns;
        });
    } catch (const std::bad_alloc&) { // all of the time counts then
    }
    return sum;
}

} // namespace

double counted_s(double ran_s, double computed_s, double starved_s, bool loads)
{
    const double progress = std::max(starved_s, 0.0) + (loads ? std::max(computed_s, 0.0) : 0);
    constexpr double least = 0.05; // threads that compute or starve without an end are a hang, too
    return std::max(ran_s - progress, least * ran_s);
}

LimitedWait::LimitedWait(std::string_view what) noexcept
{
    OpenWaits& now = open_waits();
    const std::lock_guard lock(now.mutex);
    long_ = !now.waits.empty() && now.waits.back()->long_;
    limit_s_ = now.limit_s * (long_ ? 4 : 1);
    begin(what);
}

LimitedWait::LimitedWait(std::string_view what, double limit_s) noexcept
    : limit_s_(limit_s)
    , long_(true)
{
    const std::lock_guard lock(open_waits().mutex);
    begin(what);
}

void LimitedWait::begin(std::string_view what)
{
    try {
        what_ = what;
        open_waits().waits.push_back(this);
    } catch (const std::bad_alloc&) { // nobody watches this wait then; it may be a destructor's
    }
}

LimitedWait::~LimitedWait()
{
    OpenWaits& now = open_waits();
    const std::lock_guard lock(now.mutex);
    std::erase(now.waits, this);
    if (!now.waits.empty())
        now.waits.back()->waited_s_ = 0;
}

void LimitedWait::restart()
{
    const std::lock_guard lock(open_waits().mutex);
    waited_s_ = 0;
}

void give_up(const std::string& what, double waited_s)
{
    static std::atomic_flag given_up;
    if (given_up.test_and_set())
        for (;;) // another thread ends the process
            pause();
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", waited_s);
    write_log(LogKind::hung,
        what + " has not come for " + text + " s; the program ends with " + std::to_string(exit_hung)
            + " without waiting any longer");
    flush_messages(1);
    _exit(exit_hung);
}

struct WaitWatch::Thread {
    std::mutex mutex;
    std::condition_variable changed;
    bool ends = false;
    std::thread thread{[this] { look(); }};

    void look()
    {
        using Clock = std::chrono::steady_clock;
        for (Clock::time_point last = Clock::now();;) {
            {
                std::unique_lock lock(mutex);
                if (changed.wait_for(lock, look_every, [this] { return ends; }))
                    return;
            }
            const Clock::time_point now = Clock::now();
            // A longer time since the last look means that this thread did not run either.
            const auto ran = std::min<Clock::duration>(now - last, 2 * look_every);
            last = now;
            const auto [what, waited_s] = overdue(std::chrono::duration<double>(ran).count());
            if (!what.empty())
                give_up(what, waited_s);
        }
    }

    std::pair<double, double> times{0, 0}; ///< thread_times at the last look

    /// Adds the time to the innermost wait. Returns its name once it is beyond its limit.
    std::pair<std::string, double> overdue(double ran_s)
    {
        const auto [computed_s, starved_s] = std::exchange(times, thread_times());
        OpenWaits& now = open_waits();
        const std::lock_guard lock(now.mutex);
        if (now.waits.empty())
            return {};
        LimitedWait& inner = *now.waits.back();
        inner.waited_s_ += counted_s(ran_s, times.first - computed_s, times.second - starved_s, inner.long_);
        return {inner.waited_s_ > inner.limit_s_ ? inner.what_ : "", inner.waited_s_};
    }
};

WaitWatch::WaitWatch(double limit_s)
{
    {
        const std::lock_guard lock(open_waits().mutex);
        open_waits().limit_s = limit_s;
    }
    thread_ = std::make_unique<Thread>();
}

WaitWatch::~WaitWatch()
{
    {
        const std::lock_guard lock(thread_->mutex);
        thread_->ends = true;
    }
    thread_->changed.notify_all();
    thread_->thread.join();
    const std::lock_guard lock(open_waits().mutex);
    open_waits().limit_s = unwatched_s;
}

} // namespace starbow
