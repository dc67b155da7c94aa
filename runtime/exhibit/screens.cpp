#include "screens.h"
#include "config/json/error.h"
#include "runtime/operation/log.h"
#include "runtime/operation/waits.h"
#include "runtime/render/frame_timer.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;

bool same_window(const Output& a, const Output& b)
{
    auto identity = [](const Output& o) {
        return std::tuple(o.name, o.node, o.size, o.resizable, o.preview, o.monitor.connector, o.monitor.model,
            o.monitor.serial, o.monitor.position, o.whole_monitor, o.place);
    };
    return identity(a) == identity(b);
}

} // namespace

Screens::Screens(Device& device, const Layout& layout, std::string node)
    : device_(device)
    , node_(std::move(node))
{
    for (const Output& output : layout.outputs)
        screens_.push_back({output});
    settle_on_monitors(true);
}

void Screens::adopt(const Layout& layout)
{
    clocks_.clear();
    std::vector<Screen> screens;
    for (const Output& output : layout.outputs) {
        auto same = std::find_if(
            screens_.begin(), screens_.end(), [&](const Screen& screen) { return same_window(screen.output, output); });
        if (same != screens_.end())
            screens.push_back(std::move(*same));
        else
            screens.push_back({output});
        screens.back().output = output;
    }
    screens_ = std::move(screens);
    settle_on_monitors(false);
}

void Screens::follow()
{
    // A window manager may move a window away for a quarter of a second at most.
    const Clock::time_point now = Clock::now();
    if (desktop_.look() || now - looked_ > std::chrono::milliseconds(250)) {
        settle_on_monitors(false);
        looked_ = now;
    }
}

void Screens::settle_on_monitors(bool starting)
{
    const std::vector<Monitor>& monitors = desktop_.monitors();
    // Windows on wrong screens close first.
    std::vector<MonitorChoice> choices;
    for (Screen& screen : screens_) {
        choices.push_back(choose_monitor(screen.output.monitor, monitors));
        if (is_here(screen) && has_place(screen.output) && !choices.back().monitor)
            close(screen, choices.back().problem);
    }
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        Screen& screen = screens_[i];
        if (!is_here(screen))
            continue;
        std::optional<WindowPlace> place;
        if (has_place(screen.output)) {
            if (!choices[i].monitor)
                continue;
            place = place_on(monitors[*choices[i].monitor], screen.output);
        }
        if (!screen.window)
            open(screen, place, starting);
        else if (place)
            screen.window->put(*place);
    }
    list_handles();
}

void Screens::open(Screen& screen, const std::optional<WindowPlace>& place, bool starting)
{
    try {
        screen.window.emplace(device_, screen.output, place);
        if (!screen.logged_reason.empty())
            write_log(LogKind::output_shown, "output '" + screen.output.name + "' is shown again");
        screen.logged_reason.clear();
    } catch (const InputError& error) {
        if (starting)
            throw;
        close(screen, error.what());
    }
}

void Screens::close(Screen& screen, const std::string& why)
{
    clocks_.clear();
    screen.window.reset();
    const std::string short_of_it = why.substr(0, why.find(';')); // the list after the semicolon may change often
    if (screen.logged_reason != short_of_it)
        write_log(LogKind::output_missing, "output '" + screen.output.name + "' is not shown: " + why);
    screen.logged_reason = short_of_it;
}

void Screens::list_handles()
{
    handles_.clear();
    for (const Screen& screen : screens_)
        if (screen.window)
            handles_.push_back(screen.window->handle());
}

std::optional<std::size_t> Screens::readable() const
{
    for (std::size_t i = 0; i < screens_.size(); ++i)
        if (targets_[i].view && screens_[i].window && screens_[i].window->readable())
            return i;
    return {};
}

bool Screens::acquire()
{
    targets_.assign(screens_.size(), {});
    acquired_.clear();
    for (std::size_t i = 0; i < screens_.size(); ++i) {
        Screen& screen = screens_[i];
        try {
            if (screen.window && screen.window->acquire()) {
                targets_[i] = screen.window->target();
                acquired_.push_back(&*screen.window);
            }
        } catch (const InputError& error) { // its surface is lost; a new window may help
            close(screen, error.what());
            list_handles();
        }
    }
    return !acquired_.empty();
}

std::vector<glm::ivec2> Screens::sizes() const
{
    std::vector<glm::ivec2> sizes;
    for (const Target& target : targets_)
        sizes.push_back(target.view ? glm::ivec2(target.extent.width, target.extent.height) : glm::ivec2(0));
    return sizes;
}

void Screens::draw_smaller(Pipelines& pipelines, std::size_t output, glm::ivec2 size)
{
    Window& window = *screens_[output].window;
    window.draw_smaller(pipelines, size);
    targets_[output] = window.target();
}

void Screens::begin_pictures(vk::CommandBuffer commands) const
{
    for (const Window* window : acquired_)
        window->begin_picture(commands);
}

void Screens::end_pictures(vk::CommandBuffer commands) const
{
    for (const Window* window : acquired_)
        window->end_picture(commands);
}

std::size_t Screens::held() const
{
    return std::size_t(std::count_if(
        screens_.begin(), screens_.end(), [](const Screen& screen) { return screen.window && screen.window->held(); }));
}

vk::Format Screens::format() const
{
    for (const Screen& screen : screens_)
        if (screen.window && screen.window->format() != vk::Format::eUndefined)
            return screen.window->format();
    return vk::Format::eUndefined;
}

void Screens::submit(vk::CommandBuffer world, vk::CommandBuffer outputs, vk::Fence done)
{
    std::vector<vk::SemaphoreSubmitInfo> wait, signal;
    for (const Window* window : acquired_) {
        wait.push_back({window->acquired(), 0, Stage::eAllCommands});
        signal.push_back({window->drawn(), 0, Stage::eAllCommands});
    }
    const LimitedWait submitting("the queue's taking of a frame (vkQueueSubmit2)");
    submit_frame(device_, world, outputs, wait, signal, done);
    done_ = done;
}

void Screens::present(Skew& skew)
{
    std::vector<vk::Semaphore> drawn;
    std::vector<vk::SwapchainKHR> swapchains;
    std::vector<std::uint32_t> images;
    for (const Window* window : acquired_) {
        drawn.push_back(window->drawn());
        swapchains.push_back(window->swapchain());
        images.push_back(window->image());
    }
    std::vector<vk::Result> results(swapchains.size(), vk::Result::eSuccess);
    vk::PresentInfoKHR present(drawn, swapchains, images, results);
    const std::vector<std::uint64_t> ids(swapchains.size(), ++frame_);
    const vk::PresentIdKHR present_id(ids);
    const bool several = acquired_.size() > 1;
    skew.on_screen = device_.reports_presentation;
    if (skew.on_screen)
        present.pNext = &present_id;
    else if (several) // timed below: the hand-over alone, without the drawing that some drivers wait for in it
        device_.await(done_, "the end of the frame's drawing before it is handed over (fence)");

    const Clock::time_point began = Clock::now();
    vk::Result worst;
    const LimitedWait presenting("the return of the pictures' presentation (vkQueuePresentKHR)");
    try {
        worst = device_.queue.presentKHR(present);
    } catch (const vk::OutOfDateKHRError&) {
        worst = vk::Result::eErrorOutOfDateKHR;
    } catch (const vk::SurfaceLostKHRError&) {
        worst = vk::Result::eErrorSurfaceLostKHR;
    }
    if (several && skew.on_screen)
        time_on_screen(skew);
    else if (several)
        skew.add(std::chrono::duration<double>(Clock::now() - began).count());
    // `results` tells the windows apart; a driver that does not fill it means all windows.
    const bool unspecified
        = std::all_of(results.begin(), results.end(), [](vk::Result result) { return result == vk::Result::eSuccess; });
    for (std::size_t i = 0; i < acquired_.size(); ++i)
        acquired_[i]->presented(unspecified ? worst : results[i]);
}

void Screens::time_on_screen(Skew& skew)
{
    if (std::any_of(clocks_.begin(), clocks_.end(), [](const PresentClock* clock) { return clock->busy(); }))
        return; // the frame before is still awaited
    std::vector<Clock::time_point> shown;
    for (const PresentClock* clock : clocks_)
        if (const auto at = clock->shown())
            shown.push_back(*at);
    if (shown.size() > 1 && shown.size() == clocks_.size()) {
        const auto [first, last] = std::minmax_element(shown.begin(), shown.end());
        skew.add(std::chrono::duration<double>(*last - *first).count());
    }
    clocks_.clear();
    for (Window* window : acquired_) {
        clocks_.push_back(window->clock());
        clocks_.back()->start(window->swapchain(), frame_);
    }
}

bool Screens::closed() const
{
    return std::any_of(
        screens_.begin(), screens_.end(), [](const Screen& screen) { return screen.window && screen.window->closed(); });
}

void Screens::switch_full_screen()
{
    for (Screen& screen : screens_)
        if (screen.window)
            screen.window->switch_full_screen();
}

bool Screens::barrier() const
{
    return !handles_.empty()
        && std::ranges::all_of(screens_, [](const Screen& screen) { return !screen.window || screen.window->barrier(); });
}

double Screens::refresh_hz() const
{
    double fastest = 0;
    for (const Screen& screen : screens_) {
        if (!screen.window)
            continue;
        const MonitorChoice choice = choose_monitor(screen.output.monitor, desktop_.monitors());
        if (choice.monitor)
            fastest = std::max(fastest, desktop_.monitors()[*choice.monitor].refresh_hz);
    }
    return fastest > 0 ? fastest : 60;
}

} // namespace starbow
