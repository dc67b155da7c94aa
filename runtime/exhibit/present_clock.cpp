#include "present_clock.h"
#include "runtime/operation/waits.h"

namespace starbow {

PresentClock::PresentClock(Device& device)
    : device_(device)
    , thread_([this] { wait_for_images(); })
{
}

PresentClock::~PresentClock()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void PresentClock::start(vk::SwapchainKHR swapchain, std::uint64_t id)
{
    const std::lock_guard lock(mutex_);
    swapchain_ = swapchain;
    id_ = id;
    shown_.reset();
    changed_.notify_all();
}

bool PresentClock::busy() const
{
    const std::lock_guard lock(mutex_);
    return bool(swapchain_);
}

std::optional<PresentClock::Clock::time_point> PresentClock::shown() const
{
    const std::lock_guard lock(mutex_);
    return shown_;
}

void PresentClock::wait_idle() const
{
    const LimitedWait reporting("the report of a shown picture (vkWaitForPresentKHR)");
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !swapchain_; });
}

void PresentClock::wait_for_images()
{
    constexpr std::uint64_t patience_ns = 100'000'000;
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return ends_ || swapchain_; });
        if (ends_)
            return;
        const vk::SwapchainKHR swapchain = swapchain_;
        const std::uint64_t id = id_;
        lock.unlock();
        const VkResult result
            = device_.device.getDispatcher()->vkWaitForPresentKHR(*device_.device, swapchain, id, patience_ns);
        const Clock::time_point now = Clock::now();
        lock.lock();
        if (result == VK_SUCCESS)
            shown_ = now;
        swapchain_ = nullptr;
        changed_.notify_all();
    }
}

} // namespace starbow
