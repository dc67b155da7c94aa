#pragma once
#include "present_clock.h"
#include "runtime/operation/monitors.h"
#include "runtime/render/frame_renderer.h"
#include "runtime/render/scaled_picture.h"
#include <chrono>

struct GLFWwindow;

namespace starbow {

/// GLFW's lifetime. Throws InputError where no window system answers.
struct WindowSystem {
    WindowSystem();
    ~WindowSystem();
    WindowSystem(const WindowSystem&) = delete;
};
/// Exit status of a program whose X server has ended. It logs that, does its ExitWork, and ends at once, without
/// destructors.
constexpr int exit_no_display = 5;
/// Work of a program that ends so, for as long as the object lives: the innermost first. Make it only on the thread that
/// draws.
class ExitWork {
public:
    explicit ExitWork(std::function<void()> work);
    ~ExitWork();
    ExitWork(const ExitWork&) = delete;

private:
    std::function<void()> work_;
};

/// True if a window system answers. GLFW then runs from here on.
bool has_display();

/// A size in pixels for a message: "160x120".
std::string text_of(glm::ivec2 size);

/// One output of a layout on the screen.
class Window {
public:
    /// place: none gives a window with a frame where the desktop puts it; otherwise a bare window that stays at its
    /// place. aside: no frame waits for the window, it does not take the keyboard from the others, and its pictures are
    /// copied into it. Throws InputError where it can't be opened.
    Window(Device& device, const Output& output, const std::optional<WindowPlace>& place, bool aside = false);
    ~Window();
    Window(Window&& other) noexcept;

    GLFWwindow* handle() const { return window_; }
    bool closed() const;
    /// True where its pictures change with those of other windows and machines (VK_NV_present_barrier).
    bool barrier() const { return barrier_; }
    /// To the monitor that shows most of the window, and back. For a window without a place.
    void switch_full_screen();
    /// Moves a bare window to its place, also after a window manager has moved it.
    void put(const WindowPlace& place);

    /// Acquires the next image. Returns false if none is available now: the window is minimised, changes its size, or the
    /// window system holds the images longer than a tenth of a second. Makes the swapchain and the surface anew where
    /// necessary; size() is then the new size.
    bool acquire();
    /// Draws a smaller picture from now on, until the window has another size. Throws InputError where the device has no
    /// room even for that.
    void draw_smaller(Pipelines& pipelines, glm::ivec2 size);
    /// These two enclose the drawing of target() with its layout transitions. The second scales a smaller picture up.
    void begin_picture(vk::CommandBuffer commands) const;
    void end_picture(vk::CommandBuffer commands) const;
    bool held() const { return late_; } ///< the last acquire() timed out
    glm::ivec2 size() const { return size_; }
    Target target() const;
    bool readable() const { return readable_ && !smaller_; } ///< target() can be copied
    vk::Format format() const { return format_; } ///< undefined until there is a swapchain
    vk::Semaphore acquired() const { return *acquired_; }
    vk::Semaphore drawn() const { return *drawn_[image_]; }
    vk::Image picture() const { return images_[image_]; } ///< the window's own, without a smaller one
    vk::SwapchainKHR swapchain() const { return *swapchain_; }
    std::uint32_t image() const { return image_; }
    void presented(vk::Result result);
    PresentClock* clock() { return clock_.get(); } ///< null where the driver does not report when images are on the screen

private:
    using Clock = std::chrono::steady_clock;
    void let_go(); ///< releases the swapchain and the surface
    void make_surface();
    Target window_target() const;
    bool make_swapchain();
    glm::ivec2 possible(glm::ivec2 size);
    vk::Result try_acquire();

    Device* device_;
    std::string name_;
    GLFWwindow* window_ = nullptr;
    vk::raii::SurfaceKHR surface_ = nullptr;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    vk::Format format_ = vk::Format::eUndefined;
    glm::ivec2 size_{0}, windowed_place_{0}, windowed_size_{0};
    glm::ivec2 refused_{0}; ///< the last size of the window that was beyond the device's limit
    bool bare_ = false;
    bool aside_ = false;
    bool readable_ = false;
    bool barrier_ = false; ///< the swapchain's
    bool stale_ = true; ///< the swapchain
    bool lost_ = false; ///< the surface
    bool late_ = false; ///< the last acquire timed out: the other windows don't wait for this one again
    Clock::time_point made_{}; ///< the swapchain
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    std::unique_ptr<ScaledPicture> smaller_; ///< where the device has no room for a picture of the window's size
    vk::raii::Semaphore acquired_ = nullptr;
    std::vector<vk::raii::Semaphore> drawn_;
    std::uint32_t image_ = 0;
    std::unique_ptr<PresentClock> clock_;
};

} // namespace starbow
