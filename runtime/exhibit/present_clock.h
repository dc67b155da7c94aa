#pragma once
#include "runtime/render/device.h"
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace starbow {

/// Measures on a thread of its own when an image was on its screen (VK_KHR_present_wait).
class PresentClock {
public:
    using Clock = std::chrono::steady_clock;
    explicit PresentClock(Device& device);
    ~PresentClock();
    PresentClock(const PresentClock&) = delete;

    /// Starts the wait for one presented image; call it only while busy() is false.
    void start(vk::SwapchainKHR swapchain, std::uint64_t id);
    bool busy() const;
    /// The time of the last image; nothing if the driver did not report it within a tenth of a second.
    std::optional<Clock::time_point> shown() const;
    /// Waits until busy() is false; call it before the swapchain is destroyed.
    void wait_idle() const;

private:
    void wait_for_images();

    Device& device_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    vk::SwapchainKHR swapchain_; ///< the awaited image's, or null
    std::uint64_t id_ = 0;
    std::optional<Clock::time_point> shown_;
    bool ends_ = false;
    std::thread thread_;
};

} // namespace starbow
