#pragma once
#include "frame.h"

struct GLFWwindow;

namespace starbow {

/// GLFW, from first to last window. Throws InputError where no window system answers.
struct WindowSystem {
    WindowSystem();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
};
/// Whether a window system answers at all.
bool has_display();

/// One output of a layout on the screen.
class Window {
public:
    Window(Device& device, const Output& output);
    ~Window();
    Window(Window&& other) noexcept;

    GLFWwindow* handle() const { return window_; }
    bool closed() const;
    void switch_full_screen();

    /// Gets the next picture to draw into. False if there is none to be had now: minimised, or changing its size. Makes the
    /// swapchain anew where the window has changed; size() is then the new size.
    bool acquire();
    glm::ivec2 size() const { return size_; }
    Target target() const;
    vk::Semaphore acquired() const { return *acquired_; }
    vk::Semaphore drawn() const { return *drawn_[image_]; }
    vk::SwapchainKHR swapchain() const { return *swapchain_; }
    std::uint32_t image() const { return image_; }
    void presented(vk::Result result);

private:
    bool make_swapchain();

    Device* device_;
    GLFWwindow* window_ = nullptr;
    vk::raii::SurfaceKHR surface_ = nullptr;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    vk::Format format_ = vk::Format::eUndefined;
    glm::ivec2 size_{0}, windowed_place_{0}, windowed_size_{0};
    bool stale_ = true;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    vk::raii::Semaphore acquired_ = nullptr;
    std::vector<vk::raii::Semaphore> drawn_;
    std::uint32_t image_ = 0;
};

} // namespace starbow
