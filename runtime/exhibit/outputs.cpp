#include "outputs.h"
#include "config/json/error.h"
#include "desktop.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/waits.h"
#include "runtime/render/debug.h"
#include "runtime/render/live_copy.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <unistd.h>

namespace starbow {
namespace {

std::string glfw_says()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// Discards a target's contents and makes it ready for drawing.
void discard(vk::CommandBuffer commands, const Target& target)
{
    constexpr auto drawn = Stage::eColorAttachmentOutput;
    transition(commands, target.image, vk::ImageLayout::eUndefined, drawn, {}, vk::ImageLayout::eColorAttachmentOptimal,
        drawn, Access::eColorAttachmentWrite);
}

/// Makes a drawn target ready for its presentation.
void hand_over(vk::CommandBuffer commands, const Target& target)
{
    constexpr auto drawn = Stage::eColorAttachmentOutput;
    transition(commands, target.image, vk::ImageLayout::eColorAttachmentOptimal, drawn, Access::eColorAttachmentWrite,
        vk::ImageLayout::ePresentSrcKHR, drawn, {});
}

/// A size with the same shape whose sides are at most so long.
glm::ivec2 within(glm::ivec2 size, int most)
{
    const double shrink = std::min(1.0, double(most) / std::max(size.x, size.y));
    return glm::max(glm::ivec2(glm::dvec2(size) * shrink), 1);
}

/// Shrinks a window to its screen: otherwise a part of its picture would be hidden, on a dome the front.
glm::ivec2 fit_to_screen(glm::ivec2 size)
{
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor)
        return size;
    glm::ivec2 corner, area;
    glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &area.x, &area.y);
    double shrink = std::min({1.0, double(area.x) / size.x, double(area.y) / size.y});
    return shrink > 0 ? glm::max(glm::ivec2(glm::dvec2(size) * shrink), 1) : size;
}

/// GLFW 3.4 tries Wayland first, and libwayland prints an error if there is no server.
bool open_window_system()
{
#ifdef GLFW_PLATFORM
    if (!std::getenv("WAYLAND_DISPLAY"))
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    return glfwInit();
}

/// The monitor that shows the largest part of a window; the primary one if none shows any. Null without monitors.
GLFWmonitor* monitor_of(GLFWwindow* window)
{
    WindowPlace own;
    glfwGetWindowPos(window, &own.corner.x, &own.corner.y);
    glfwGetWindowSize(window, &own.size.x, &own.size.y);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    std::vector<WindowPlace> places(std::size_t(std::max(count, 0)));
    for (std::size_t i = 0; i < places.size(); ++i) {
        glfwGetMonitorPos(monitors[i], &places[i].corner.x, &places[i].corner.y);
        const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
        places[i].size = mode ? glm::ivec2(mode->width, mode->height) : glm::ivec2(0);
    }
    const auto own_monitor = largest_share(own, places);
    return own_monitor ? monitors[*own_monitor] : glfwGetPrimaryMonitor();
}

} // namespace

std::string text_of(glm::ivec2 size) { return std::to_string(size.x) + "x" + std::to_string(size.y); }

namespace {

/// The innermost last. Never destroyed, because the process may end anywhere.
std::vector<const std::function<void()>*>& last_works()
{
    static auto& only = *new std::vector<const std::function<void()>*>;
    return only;
}

/// A function of GLFW or Xlib that is there where GLFW is made for X11.
template <class Function> Function* find_function(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// The process ends here: Xlib has no state for a display that has gone, and its next call may crash.
void end_without_display(void*, void*)
{
    write_log(LogKind::display_gone,
        "the X server has ended; the program ends with " + std::to_string(exit_no_display)
            + ", because its windows are gone");
    for (auto work = last_works().rbegin(); work != last_works().rend(); ++work)
        (**work)();
    flush_messages(1);
    std::fflush(nullptr);
    _exit(exit_no_display);
}

/// Without this, Xlib ends the process by exit() once the X server has gone.
void watch_x_server()
{
    const auto display_of_glfw = find_function<void*()>("glfwGetX11Display");
    const auto on_error = find_function<void*(int (*)(void*))>("XSetIOErrorHandler");
    const auto on_exit = find_function<void(void*, void (*)(void*, void*), void*)>("XSetIOErrorExitHandler");
    if (!display_of_glfw || !on_error || !on_exit || !display_of_glfw())
        return; // another window system
    on_error([](void*) { return 0; }); // without a message of Xlib's own
    on_exit(display_of_glfw(), end_without_display, nullptr);
}

} // namespace

ExitWork::ExitWork(std::function<void()> work)
    : work_(std::move(work))
{
    last_works().push_back(&work_);
}

ExitWork::~ExitWork() { last_works().pop_back(); }

WindowSystem::WindowSystem()
{
    const auto server = forget_dead_window_manager();
    if (!open_window_system())
        throw InputError("No window can be opened (" + glfw_says()
            + "): start a desktop session, or set DISPLAY, or use 'starbow render'");
    watch_x_server();
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

bool has_display()
{
    const auto server = forget_dead_window_manager();
    return open_window_system();
}

Window::Window(Device& device, const Output& output, const std::optional<WindowPlace>& place, bool aside)
    : device_(&device)
    , name_(output.name)
    , bare_(place.has_value())
    , aside_(aside)
{
    if (!glfwVulkanSupported())
        throw InputError(
            "The window system shows no Vulkan pictures: install mesa-vulkan-drivers or the GPU maker's Vulkan driver");
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_RESIZABLE, output.resizable && !place);
    glfwWindowHint(GLFW_DECORATED, !place);
    glfwWindowHint(GLFW_FLOATING, output.whole_monitor); // above the desktop's panels
    glfwWindowHint(GLFW_VISIBLE, !place); // a bare window appears only at its place
    glfwWindowHint(GLFW_FOCUSED, !aside);
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, !aside);
    const glm::ivec2 size = possible(place ? place->size : fit_to_screen(output.size));
    window_ = glfwCreateWindow(size.x, size.y, ("Starbow " + name_).c_str(), nullptr, nullptr);
    if (!window_)
        throw InputError("The window '" + name_ + "' can't be opened: " + glfw_says());
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE); // keeps taps that are shorter than a frame
    if (output.whole_monitor && !output.preview)
        glfwSetInputMode(window_, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    if (place) {
        glfwSetWindowPos(window_, place->corner.x, place->corner.y);
        glfwShowWindow(window_);
        put(*place);
    }
    size_ = size;
    try {
        if (device.reports_presentation && !aside)
            clock_ = std::make_unique<PresentClock>(device);
        make_surface();
    } catch (...) {
        surface_ = nullptr;
        glfwDestroyWindow(window_);
        throw;
    }
}

Window::Window(Window&& other) noexcept
    : device_(other.device_)
    , name_(std::move(other.name_))
    , window_(std::exchange(other.window_, nullptr))
    , surface_(std::move(other.surface_))
    , swapchain_(std::move(other.swapchain_))
    , format_(other.format_)
    , size_(other.size_)
    , windowed_place_(other.windowed_place_)
    , windowed_size_(other.windowed_size_)
    , refused_(other.refused_)
    , bare_(other.bare_)
    , aside_(other.aside_)
    , barrier_(other.barrier_)
    , stale_(other.stale_)
    , lost_(other.lost_)
    , late_(other.late_)
    , made_(other.made_)
    , images_(std::move(other.images_))
    , views_(std::move(other.views_))
    , smaller_(std::move(other.smaller_))
    , acquired_(std::move(other.acquired_))
    , drawn_(std::move(other.drawn_))
    , image_(other.image_)
    , clock_(std::move(other.clock_))
{
}

Window::~Window()
{
    if (!window_)
        return;
    let_go();
    glfwDestroyWindow(window_);
}

void Window::let_go()
{
    if (clock_)
        clock_->wait_idle();
    device_->settle();
    views_.clear();
    swapchain_ = nullptr;
    surface_ = nullptr;
}

void Window::make_surface()
{
    let_go();
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(*device_->instance, window_, nullptr, &surface) != VK_SUCCESS)
        throw InputError("The window '" + name_ + "' has no Vulkan surface: " + glfw_says());
    surface_ = vk::raii::SurfaceKHR(device_->instance, surface);
    if (!device_->physical.getSurfaceSupportKHR(device_->family, *surface_))
        throw InputError("The GPU '" + std::string(device_->name())
            + "' can't show pictures in this desktop's windows: choose another with STARBOW_GPU");
    format_ = vk::Format::eUndefined;
    for (vk::SurfaceFormatKHR offered : device_->physical.getSurfaceFormatsKHR(*surface_))
        if (format_ == vk::Format::eUndefined && offered.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear
            && (offered.format == vk::Format::eB8G8R8A8Srgb || offered.format == vk::Format::eR8G8B8A8Srgb))
            format_ = offered.format;
    if (format_ == vk::Format::eUndefined)
        throw InputError("The window '" + name_ + "' offers no 8-bit sRGB pictures: use another GPU driver");
    stale_ = true;
    lost_ = false;
}

bool Window::closed() const { return glfwWindowShouldClose(window_); }

void Window::switch_full_screen()
{
    if (bare_)
        return;
    if (glfwGetWindowMonitor(window_)) {
        glfwSetWindowMonitor(
            window_, nullptr, windowed_place_.x, windowed_place_.y, windowed_size_.x, windowed_size_.y, GLFW_DONT_CARE);
    } else if (GLFWmonitor* monitor = monitor_of(window_)) {
        glfwGetWindowPos(window_, &windowed_place_.x, &windowed_place_.y);
        glfwGetWindowSize(window_, &windowed_size_.x, &windowed_size_.y);
        if (const GLFWvidmode* mode = glfwGetVideoMode(monitor)) // null where it is just being unplugged
            glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
    stale_ = true;
}

void Window::put(const WindowPlace& place)
{
    WindowPlace now;
    glfwGetWindowPos(window_, &now.corner.x, &now.corner.y);
    glfwGetWindowSize(window_, &now.size.x, &now.size.y);
    if (const glm::ivec2 size = possible(place.size); now.size != size)
        glfwSetWindowSize(window_, size.x, size.y);
    if (now.corner != place.corner)
        glfwSetWindowPos(window_, place.corner.x, place.corner.y);
}

static bool takes_part_in_barriers(const Device& device, vk::SurfaceKHR surface)
{
    return device.physical
        .getSurfaceCapabilities2KHR<vk::SurfaceCapabilities2KHR, vk::SurfaceCapabilitiesPresentBarrierNV>(
            vk::PhysicalDeviceSurfaceInfo2KHR(surface))
        .get<vk::SurfaceCapabilitiesPresentBarrierNV>()
        .presentBarrierSupported;
}

bool Window::make_swapchain()
{
    if (clock_)
        clock_->wait_idle();
    device_->settle();
    auto limits = device_->physical.getSurfaceCapabilitiesKHR(*surface_);
    glm::ivec2 wanted;
    glfwGetFramebufferSize(window_, &wanted.x, &wanted.y);
    vk::Extent2D extent = limits.currentExtent;
    if (extent.width == UINT32_MAX)
        extent = vk::Extent2D(std::clamp(std::uint32_t(wanted.x), limits.minImageExtent.width, limits.maxImageExtent.width),
            std::clamp(std::uint32_t(wanted.y), limits.minImageExtent.height, limits.maxImageExtent.height));
    if (extent.width == 0 || extent.height == 0)
        return false;
    const glm::ivec2 size(extent.width, extent.height);
    if (size != refused_ && possible(size) != size)
        glfwSetWindowSize(window_, possible(size).x, possible(size).y);
    if (size == refused_)
        return false; // the window manager may insist on it
    std::uint32_t count = limits.minImageCount + 1;
    if (limits.maxImageCount > 0)
        count = std::min(count, limits.maxImageCount);
    views_.clear();
    drawn_.clear();
    auto alpha = limits.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque
        ? vk::CompositeAlphaFlagBitsKHR::eOpaque
        : vk::CompositeAlphaFlagBitsKHR::eInherit;
    vk::ImageUsageFlags usage = vk::ImageUsageFlagBits::eColorAttachment;
    readable_ = bool(limits.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferSrc) && is_live_format(format_);
    if (readable_)
        usage |= vk::ImageUsageFlagBits::eTransferSrc;
    vk::PresentModeKHR mode = vk::PresentModeKHR::eFifo;
    if (aside_) {
        if (!(limits.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst))
            throw InputError("The window '" + name_ + "' takes no copied pictures: use another GPU driver");
        usage |= vk::ImageUsageFlagBits::eTransferDst;
        const std::vector<vk::PresentModeKHR> offered = device_->physical.getSurfacePresentModesKHR(*surface_);
        for (const vk::PresentModeKHR better :
            {vk::PresentModeKHR::eImmediate, vk::PresentModeKHR::eMailbox}) // the last one is the best
            if (std::ranges::find(offered, better) != offered.end())
                mode = better;
    }
    const LimitedWait making("the swapchain of output '" + name_ + "' (vkCreateSwapchainKHR)");
    const vk::raii::SwapchainKHR old = std::exchange(swapchain_, nullptr); // it lasts until the new one is there
    vk::SwapchainCreateInfoKHR info({}, *surface_, count, format_, vk::ColorSpaceKHR::eSrgbNonlinear, extent, 1, usage,
        vk::SharingMode::eExclusive, {}, limits.currentTransform, alpha, mode, true, *old);
    const vk::SwapchainPresentBarrierCreateInfoNV in_barrier(true);
    barrier_ = device_->present_barrier && !aside_ && takes_part_in_barriers(*device_, *surface_);
    if (barrier_)
        info.pNext = &in_barrier;
    swapchain_ = device_->device.createSwapchainKHR(info);
    name_object(*device_, swapchain_, "outputs: swapchain");
    for (VkImage image : swapchain_.getImages()) {
        images_.resize(views_.size());
        images_.push_back(image);
        views_.push_back(device_->device.createImageView(
            {{}, image, vk::ImageViewType::e2D, format_, {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}}));
        name_object(*device_, drawn_.emplace_back(device_->device.createSemaphore({})), "outputs: drawn");
        name_object(*device_, views_.back(), ("picture of " + name_).c_str());
    }
    acquired_ = device_->device.createSemaphore({});
    name_object(*device_, acquired_, "outputs: acquired");
    made_ = Clock::now();
    if (size_ != size)
        smaller_ = nullptr;
    size_ = size;
    stale_ = false;
    return true;
}

vk::Result Window::try_acquire()
{
    constexpr auto patience = std::chrono::nanoseconds(std::chrono::milliseconds(100));
    if (lost_)
        make_surface();
    if (stale_ && !make_swapchain())
        return vk::Result::eNotReady;
    const LimitedWait acquiring("the answer for the next picture of output '" + name_ + "' (vkAcquireNextImageKHR)");
    auto [result, image] = swapchain_.acquireNextImage(late_ || aside_ ? 0 : std::uint64_t(patience.count()), *acquired_);
    image_ = image;
    return result;
}

bool Window::acquire()
{
    glm::ivec2 now;
    glfwGetFramebufferSize(window_, &now.x, &now.y);
    if (now.x == 0 || now.y == 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) {
        late_ = false; // no image is awaited
        return false;
    }
    stale_ |= now != size_;
    // The second attempt uses the new swapchain. A window that still changes waits for the next frame.
    for (int attempt = 0; attempt < 2; ++attempt) {
        try {
            const vk::Result result = try_acquire();
            const bool none = result == vk::Result::eTimeout || result == vk::Result::eNotReady;
            late_ = none && !stale_; // a window without a swapchain awaits no image
            if (result == vk::Result::eSuboptimalKHR)
                presented(result);
            return !none;
        } catch (const vk::OutOfDateKHRError&) {
            stale_ = true;
        } catch (const vk::SurfaceLostKHRError&) {
            lost_ = true;
        } catch (const vk::NativeWindowInUseKHRError&) {
            lost_ = true; // the window system may still use the old surface
        }
    }
    return false;
}

/// A size within the device's limit: no swapchain has larger images. One that is cut is logged once.
glm::ivec2 Window::possible(glm::ivec2 size)
{
    const auto most = int(device_->properties.limits.maxImageDimension2D);
    const glm::ivec2 cut = within(size, most);
    if (cut != size && std::exchange(refused_, size) != size)
        write_log(LogKind::window_too_large,
            "the window of output '" + name_ + "' is to have " + text_of(size) + " pixels, more than the GPU's "
                + std::to_string(most) + " on a side; it becomes " + text_of(cut));
    return cut;
}

void Window::draw_smaller(Pipelines& pipelines, glm::ivec2 size)
{
    smaller_ = nullptr;
    smaller_ = in_room([&] { return std::make_unique<ScaledPicture>(*device_, pipelines, size, format_); });
}

Target Window::window_target() const
{
    return {images_[image_], *views_[image_], {std::uint32_t(size_.x), std::uint32_t(size_.y)}, format_};
}

Target Window::target() const { return smaller_ ? smaller_->target() : window_target(); }

void Window::begin_picture(vk::CommandBuffer commands) const
{
    discard(commands, target());
    if (smaller_)
        discard(commands, window_target());
}

void Window::end_picture(vk::CommandBuffer commands) const
{
    if (smaller_)
        smaller_->draw(commands, window_target());
    hand_over(commands, window_target());
}

void Window::presented(vk::Result result)
{
    if (result == vk::Result::eErrorSurfaceLostKHR)
        lost_ = true;
    else if (result == vk::Result::eSuboptimalKHR) // some desktops report it for every frame
        stale_ |= Clock::now() - made_ > std::chrono::seconds(1);
    else if (result != vk::Result::eSuccess)
        stale_ = true;
}

} // namespace starbow
