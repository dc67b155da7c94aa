#include "presenter_window.h"
#include "config/json/error.h"
#include "runtime/operation/log.h"
#include "runtime/operation/waits.h"
#include "runtime/render/debug.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <utility>

namespace starbow {
namespace {

static_assert(keys::space == GLFW_KEY_SPACE && keys::escape == GLFW_KEY_ESCAPE && keys::enter == GLFW_KEY_ENTER
    && keys::backspace == GLFW_KEY_BACKSPACE && keys::right == GLFW_KEY_RIGHT && keys::left == GLFW_KEY_LEFT
    && keys::down == GLFW_KEY_DOWN && keys::up == GLFW_KEY_UP && keys::page_up == GLFW_KEY_PAGE_UP
    && keys::page_down == GLFW_KEY_PAGE_DOWN && keys::keypad_enter == GLFW_KEY_KP_ENTER && 'A' == GLFW_KEY_A
    && '0' == GLFW_KEY_0);

/// The key by the letter that is printed on it, which GLFW alone knows by its place.
int printed_key(int key, int scancode)
{
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        return '0' + key - GLFW_KEY_KP_0;
    const char* name = glfwGetKeyName(key, scancode);
    if (!name || name[0] == 0 || name[1] != 0)
        return key;
    const char letter = name[0];
    return letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : key;
}

/// The mouse's place in a window, in pixels of its picture.
glm::ivec2 mouse_in(GLFWwindow* window)
{
    glm::dvec2 at;
    glm::ivec2 size, pixels;
    glfwGetCursorPos(window, &at.x, &at.y);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    return glm::ivec2(at * glm::dvec2(pixels) / glm::max(glm::dvec2(size), 1.0));
}

Output output_of(const std::optional<Presenting>& rules)
{
    Output output{.name = "guide", .size = {1280, 800}, .resizable = true, .preview = true};
    if (rules)
        output.monitor = rules->monitor;
    output.whole_monitor = !output.monitor.empty();
    return output;
}

} // namespace

PresenterWindow::PresenterWindow(Device& device, Presenter& presenter, const std::optional<Presenting>& rules)
    : device_(device)
    , presenter_(presenter)
    , output_(output_of(rules))
    , done_(device.device.createFence({vk::FenceCreateFlagBits::eSignaled}))
    , commands_(device.device, {*device.pool, vk::CommandBufferLevel::ePrimary, 1})
{
    name_object(device, done_, "guide's window done");
    name_object(device, commands_[0], "guide's window");
}

PresenterWindow::~PresenterWindow()
{
    if (window_ && !output_.whole_monitor) {
        WindowPlace& kept = presenter_.kept_place.emplace();
        glfwGetWindowPos(window_->handle(), &kept.corner.x, &kept.corner.y);
        glfwGetWindowSize(window_->handle(), &kept.size.x, &kept.size.y);
    }
    device_.settle();
}

void PresenterWindow::settle_on_monitor(const std::vector<Monitor>& monitors)
{
    const Clock::time_point now = Clock::now();
    if (window_ && !output_.whole_monitor)
        return;
    if (now - looked_ < std::chrono::milliseconds(250))
        return;
    looked_ = now;
    std::optional<WindowPlace> place;
    if (output_.whole_monitor) {
        const MonitorChoice choice = choose_monitor(output_.monitor, monitors);
        if (!choice.monitor)
            return close(choice.problem);
        place = place_on(monitors[*choice.monitor], output_);
    }
    if (window_)
        window_->put(*place);
    else
        open(place);
}

void PresenterWindow::open(const std::optional<WindowPlace>& place)
{
    try {
        window_.emplace(device_, output_, place, true);
        if (!logged_reason_.empty())
            write_log(LogKind::output_shown, "the guide's window is shown again");
        logged_reason_.clear();
    } catch (const InputError& error) {
        return close(error.what());
    }
    if (const std::optional<WindowPlace>& kept = presenter_.kept_place; kept && !place) {
        glfwSetWindowSize(window_->handle(), kept->size.x, kept->size.y);
        glfwSetWindowPos(window_->handle(), kept->corner.x, kept->corner.y);
    }
    listen();
}

/// Keys and clicks in this window are the guide's; the visitors' keyboard reads other windows.
void PresenterWindow::listen()
{
    GLFWwindow* window = window_->handle();
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int scancode, int action, int modifiers) {
        PresenterWindow& self = *static_cast<PresenterWindow*>(glfwGetWindowUserPointer(of));
        const bool repeats
            = action == GLFW_REPEAT && (key == GLFW_KEY_BACKSPACE || key == GLFW_KEY_UP || key == GLFW_KEY_DOWN);
        if ((action != GLFW_PRESS && !repeats) || (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)))
            return; // the desktop's own keys
        const bool typed = self.presenter_.types();
        self.presenter_.press(printed_key(key, scancode));
        self.swallows_ = self.presenter_.types() && !typed;
    });
    glfwSetCharCallback(window, [](GLFWwindow* of, unsigned int code) {
        PresenterWindow& self = *static_cast<PresenterWindow*>(glfwGetWindowUserPointer(of));
        if (!std::exchange(self.swallows_, false))
            self.presenter_.type(code);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* of, int button, int action, int) {
        PresenterWindow& self = *static_cast<PresenterWindow*>(glfwGetWindowUserPointer(of));
        if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS)
            self.presenter_.click(mouse_in(of));
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* of, double, double) {
        PresenterWindow& self = *static_cast<PresenterWindow*>(glfwGetWindowUserPointer(of));
        if (glfwGetMouseButton(of, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
            self.presenter_.point(mouse_in(of));
    });
}

void PresenterWindow::close(const std::string& why)
{
    window_.reset();
    const std::string short_of_it = why.substr(0, why.find(';'));
    if (logged_reason_ != short_of_it)
        write_log(LogKind::output_missing, "the guide's window is not shown: " + why);
    logged_reason_ = short_of_it;
}

void PresenterWindow::show(const Session& session, const std::vector<Monitor>& monitors)
{
    presenter_.seen = false;
    if (!presenter_.wanted())
        return;
    settle_on_monitor(monitors);
    if (!window_)
        return;
    if (window_->closed()) {
        window_.reset();
        presenter_.close();
        return;
    }
    presenter_.seen = !glfwGetWindowAttrib(window_->handle(), GLFW_ICONIFIED);
    if (presenter_.seen && presenter_.due()) {
        glm::ivec2 size;
        glfwGetFramebufferSize(window_->handle(), &size.x, &size.y);
        constexpr int least_px = 64;
        if (glm::all(glm::greaterThanEqual(size, glm::ivec2(least_px))))
            presenter_.paint(session, size, window_->format() == vk::Format::eB8G8R8A8Srgb);
    }
    if (done_.getStatus() != vk::Result::eSuccess)
        return; // the picture before is still being copied
    try {
        if (const PresenterPicture* picture = presenter_.painted())
            copy(*picture);
    } catch (const InputError& error) { // its surface is lost; a new window may help
        close(error.what());
    }
}

void PresenterWindow::copy(const PresenterPicture& picture)
{
    if (!window_->acquire())
        return;
    const vk::CommandBuffer commands = *commands_[0];
    // A window that has just changed its size shows what there is of the old picture.
    const glm::ivec2 shown = glm::min(picture.size, window_->size());
    grow(device_, texels_, picture.texels.size(), vk::BufferUsageFlagBits::eTransferSrc);
    copy_to(texels_, std::as_bytes(std::span(picture.texels)));
    commands_[0].reset();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    const vk::Image image = window_->picture();
    constexpr auto copied = vk::PipelineStageFlagBits2::eTransfer;
    transition(commands, image, vk::ImageLayout::eUndefined, copied, {}, vk::ImageLayout::eTransferDstOptimal, copied,
        vk::AccessFlagBits2::eTransferWrite);
    commands.copyBufferToImage(*texels_.buffer, image, vk::ImageLayout::eTransferDstOptimal,
        vk::BufferImageCopy(0, std::uint32_t(picture.size.x), 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, 0, 0},
            {std::uint32_t(shown.x), std::uint32_t(shown.y), 1}));
    transition(commands, image, vk::ImageLayout::eTransferDstOptimal, copied, vk::AccessFlagBits2::eTransferWrite,
        vk::ImageLayout::ePresentSrcKHR, copied, {});
    commands.end();

    const vk::SemaphoreSubmitInfo acquired(window_->acquired(), 0, vk::PipelineStageFlagBits2::eTransfer),
        drawn(window_->drawn(), 0, vk::PipelineStageFlagBits2::eAllCommands);
    const vk::CommandBufferSubmitInfo part(commands);
    device_.device.resetFences(*done_);
    const LimitedWait showing("the return of the guide's picture (vkQueuePresentKHR)");
    device_.queue.submit2(vk::SubmitInfo2({}, acquired, part, drawn), *done_);
    const vk::Semaphore wait = window_->drawn();
    const vk::SwapchainKHR swapchain = window_->swapchain();
    const std::uint32_t index = window_->image();
    vk::Result result;
    try {
        result = device_.queue.presentKHR({wait, swapchain, index});
    } catch (const vk::OutOfDateKHRError&) {
        result = vk::Result::eErrorOutOfDateKHR;
    } catch (const vk::SurfaceLostKHRError&) {
        result = vk::Result::eErrorSurfaceLostKHR;
    }
    window_->presented(result);
}

} // namespace starbow
