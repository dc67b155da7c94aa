#include "outputs.h"
#include "config/error.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>

namespace starbow {
namespace {

std::string glfw_says()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

/// A window greater than its screen would hide a part of its picture, and of a dome the front.
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

} // namespace

WindowSystem::WindowSystem()
{
    if (!glfwInit())
        throw InputError("No window can be opened (" + glfw_says()
            + "): start a desktop session, or set DISPLAY, or use 'starbow render'");
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

bool has_display()
{
    bool is = glfwInit();
    if (is)
        glfwTerminate();
    return is;
}

Window::Window(Device& device, const Output& output)
    : device_(&device)
{
    if (!glfwVulkanSupported())
        throw InputError(
            "The window system shows no Vulkan pictures: install mesa-vulkan-drivers or the GPU maker's Vulkan driver");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_RESIZABLE, output.resizable);
    glm::ivec2 size = fit_to_screen(output.size);
    window_ = glfwCreateWindow(size.x, size.y, ("Starbow " + output.name).c_str(), nullptr, nullptr);
    if (!window_)
        throw InputError("The window '" + output.name + "' can't be opened: " + glfw_says());
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE); // a tap shorter than a frame counts too
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(*device.instance, window_, nullptr, &surface) != VK_SUCCESS)
        throw InputError("The window '" + output.name + "' has no Vulkan surface: " + glfw_says());
    surface_ = vk::raii::SurfaceKHR(device.instance, surface);
    if (!device.physical.getSurfaceSupportKHR(device.family, *surface_))
        throw InputError("The GPU '" + std::string(device.properties.deviceName.data())
            + "' can't show pictures in this desktop's windows: choose another with STARBOW_GPU");
    auto formats = device.physical.getSurfaceFormatsKHR(*surface_);
    for (vk::SurfaceFormatKHR offered : formats)
        if (format_ == vk::Format::eUndefined && offered.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear
            && (offered.format == vk::Format::eB8G8R8A8Srgb || offered.format == vk::Format::eR8G8B8A8Srgb))
            format_ = offered.format;
    if (format_ == vk::Format::eUndefined)
        throw InputError("The window '" + output.name + "' offers no 8-bit sRGB pictures: use another GPU driver");
    acquired_ = device.device.createSemaphore({});
    size_ = size;
}

Window::Window(Window&& other) noexcept
    : device_(other.device_)
    , window_(std::exchange(other.window_, nullptr))
    , surface_(std::move(other.surface_))
    , swapchain_(std::move(other.swapchain_))
    , format_(other.format_)
    , size_(other.size_)
    , stale_(other.stale_)
    , images_(std::move(other.images_))
    , views_(std::move(other.views_))
    , acquired_(std::move(other.acquired_))
    , drawn_(std::move(other.drawn_))
    , image_(other.image_)
{
}

Window::~Window()
{
    if (!window_)
        return;
    device_->device.waitIdle();
    views_.clear();
    swapchain_ = nullptr;
    surface_ = nullptr;
    glfwDestroyWindow(window_);
}

bool Window::closed() const { return glfwWindowShouldClose(window_); }

void Window::switch_full_screen()
{
    if (glfwGetWindowMonitor(window_)) {
        glfwSetWindowMonitor(
            window_, nullptr, windowed_place_.x, windowed_place_.y, windowed_size_.x, windowed_size_.y, GLFW_DONT_CARE);
    } else if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        glfwGetWindowPos(window_, &windowed_place_.x, &windowed_place_.y);
        glfwGetWindowSize(window_, &windowed_size_.x, &windowed_size_.y);
        const GLFWvidmode* mode = glfwGetVideoMode(monitor);
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    }
    stale_ = true;
}

bool Window::make_swapchain()
{
    device_->device.waitIdle();
    auto limits = device_->physical.getSurfaceCapabilitiesKHR(*surface_);
    glm::ivec2 wanted;
    glfwGetFramebufferSize(window_, &wanted.x, &wanted.y);
    vk::Extent2D extent = limits.currentExtent;
    if (extent.width == UINT32_MAX)
        extent = vk::Extent2D(std::clamp(std::uint32_t(wanted.x), limits.minImageExtent.width, limits.maxImageExtent.width),
            std::clamp(std::uint32_t(wanted.y), limits.minImageExtent.height, limits.maxImageExtent.height));
    if (extent.width == 0 || extent.height == 0)
        return false;
    std::uint32_t count = limits.minImageCount + 1;
    if (limits.maxImageCount > 0)
        count = std::min(count, limits.maxImageCount);
    views_.clear();
    drawn_.clear();
    auto alpha = limits.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque
        ? vk::CompositeAlphaFlagBitsKHR::eOpaque
        : vk::CompositeAlphaFlagBitsKHR::eInherit;
    swapchain_ = device_->device.createSwapchainKHR({{}, *surface_, count, format_, vk::ColorSpaceKHR::eSrgbNonlinear,
        extent, 1, vk::ImageUsageFlagBits::eColorAttachment, vk::SharingMode::eExclusive, {}, limits.currentTransform, alpha,
        vk::PresentModeKHR::eFifo, true, *std::exchange(swapchain_, nullptr)});
    for (VkImage image : swapchain_.getImages()) {
        images_.resize(views_.size());
        images_.push_back(image);
        views_.push_back(device_->device.createImageView(
            {{}, image, vk::ImageViewType::e2D, format_, {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}}));
        drawn_.push_back(device_->device.createSemaphore({}));
    }
    acquired_ = device_->device.createSemaphore({});
    size_ = {extent.width, extent.height};
    stale_ = false;
    return true;
}

bool Window::acquire()
{
    glm::ivec2 now;
    glfwGetFramebufferSize(window_, &now.x, &now.y);
    if (now.x == 0 || now.y == 0)
        return false;
    // A second try with a new swapchain; a window that still changes waits for the next frame.
    for (int attempt = 0; attempt < 2; ++attempt) {
        if ((stale_ || now != size_) && !make_swapchain())
            return false;
        try {
            auto [result, image] = swapchain_.acquireNextImage(UINT64_MAX, *acquired_);
            image_ = image;
            return true; // suboptimal: its size has changed since, and the next acquire sees it
        } catch (const vk::OutOfDateKHRError&) {
            stale_ = true;
        }
    }
    return false;
}

Target Window::target() const
{
    return {images_[image_], *views_[image_], {std::uint32_t(size_.x), std::uint32_t(size_.y)}, format_};
}

void Window::presented(vk::Result result)
{
    if (result != vk::Result::eSuccess)
        stale_ = true;
}

} // namespace starbow
