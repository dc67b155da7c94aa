#pragma once
#include "present_clock.h"
#include "runtime/operation/monitors.h"
#include "runtime/render/frame_renderer.h"
#include <chrono>

struct GLFWwindow;

namespace starbow {

/// GLFW, from first to last window. Throws InputError where no window system answers.
struct WindowSystem {
    WindowSystem();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
};
/// Whether a window system answers at all. Where it does, GLFW runs from here on.
bool has_display();

/// Waits until the device has nothing to do, or is lost.
void settle(Device& device) noexcept;

/// One output of a layout on the screen.
class Window {
public:
    /// Without a place the window has a frame, and opens where the desktop likes it; with one it is bare and stays there.
    /// Throws InputError where it can't be opened.
    Window(Device& device, const Output& output, const std::optional<WindowPlace>& place);
    ~Window();
    Window(Window&& other) noexcept;

    GLFWwindow* handle() const { return window_; }
    bool closed() const;
    /// Of a window without a place.
    void switch_full_screen();
    /// Moves a bare window to a place, also back to it where a window manager has moved it.
    void put(const WindowPlace& place);

    /// Gets the next picture to draw into. False if there is none to be had now: minimised, changing its size, or held by
    /// the window system longer than a tenth of a second. Makes the swapchain, and the surface, anew where they are spent;
    /// size() is then the new size.
    bool acquire();
    glm::ivec2 size() const { return size_; }
    Target target() const;
    vk::Format format() const { return format_; } ///< undefined until a swapchain was made
    vk::Semaphore acquired() const { return *acquired_; }
    vk::Semaphore drawn() const { return *drawn_[image_]; }
    vk::SwapchainKHR swapchain() const { return *swapchain_; }
    std::uint32_t image() const { return image_; }
    void presented(vk::Result result);
    PresentClock* clock() { return clock_.get(); } ///< null where the driver does not tell when pictures are shown

private:
    using Clock = std::chrono::steady_clock;
    void let_go(); ///< of the swapchain and the surface
    void make_surface();
    bool make_swapchain();
    vk::Result try_acquire();

    Device* device_;
    std::string name_;
    GLFWwindow* window_ = nullptr;
    vk::raii::SurfaceKHR surface_ = nullptr;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    vk::Format format_ = vk::Format::eUndefined;
    glm::ivec2 size_{0}, windowed_place_{0}, windowed_size_{0};
    bool bare_ = false;
    bool stale_ = true; ///< the swapchain
    bool lost_ = false; ///< the surface
    bool late_ = false; ///< the last acquire ran out of time: the others don't wait for this window again
    Clock::time_point made_{}; ///< the swapchain
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    vk::raii::Semaphore acquired_ = nullptr;
    std::vector<vk::raii::Semaphore> drawn_;
    std::uint32_t image_ = 0;
    std::unique_ptr<PresentClock> clock_;
};

} // namespace starbow
