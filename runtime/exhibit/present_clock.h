#pragma once
#include "runtime/render/device.h"
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace starbow {

/// Asks the driver, on a thread of its own, when a picture was seen on its screen (VK_KHR_present_wait).
class PresentClock {
public:
    using Clock = std::chrono::steady_clock;
    explicit PresentClock(Device& device);
    ~PresentClock();
    PresentClock(const PresentClock&) = delete;

    /// One question at a time.
    void ask(vk::SwapchainKHR swapchain, std::uint64_t id);
    bool asking() const;
    /// Of the last question; nothing where no answer came within a tenth of a second.
    std::optional<Clock::time_point> shown() const;
    /// Returns when nothing is asked: before the swapchain goes.
    void rest() const;

private:
    void answer();

    Device& device_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    vk::SwapchainKHR swapchain_; ///< that is asked about, or null
    std::uint64_t id_ = 0;
    std::optional<Clock::time_point> shown_;
    bool ends_ = false;
    std::thread thread_;
};

} // namespace starbow
