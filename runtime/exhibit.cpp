#include "exhibit.h"
#include "flight.h"
#include "frame.h"
#include "input/keyboard.h"
#include "outputs.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <chrono>
#include <cstdio>
#include <thread>

namespace starbow {
namespace {

using Clock = std::chrono::steady_clock;
using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

void present_barrier(vk::CommandBuffer commands, const Target& target, bool before)
{
    constexpr auto drawn = Stage::eColorAttachmentOutput;
    vk::ImageMemoryBarrier2 barrier = before ? vk::ImageMemoryBarrier2(drawn, {}, drawn, Access::eColorAttachmentWrite,
                                          vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal)
                                             : vk::ImageMemoryBarrier2(drawn, Access::eColorAttachmentWrite, drawn, {},
                                                 vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::ePresentSrcKHR);
    barrier.image = target.image;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

/// Some drivers' FIFO does not wait for the screen: no frame starts before its turn at 60 in a second.
struct Pace {
    Clock::time_point next = Clock::now();
    void wait()
    {
        constexpr auto turn = std::chrono::nanoseconds(16'666'667);
        std::this_thread::sleep_until(next);
        next = std::max(next + turn, Clock::now() - turn);
    }
};

/// Frames per second over the last half second or so, and the head-up display's panel, redrawn ten times a second.
struct Dashboard {
    Typesetter typesetter;
    Panel panel;
    Clock::time_point drawn{}, since = Clock::now();
    int frames = 0;
    double rate = 0;

    const Panel* update(const Flight& flight, const SceneFile& scene, int width, const std::string& notice)
    {
        Clock::time_point now = Clock::now();
        ++frames;
        if (double passed = seconds(now - since); passed > 0.5) {
            rate = frames / passed;
            frames = 0, since = now;
        }
        if (panel.size.x != width || seconds(now - drawn) > 0.1) {
            Readings told = readings(flight.ship, scene, flight.effects);
            told.frames_per_s = rate;
            told.notice = notice;
            panel = typesetter.draw(told, width);
            drawn = now;
        }
        return flight.hud ? &panel : nullptr;
    }
};

} // namespace

int fly_exhibit(Theatre& theatre, const Layout& layout, const Shot& start, const Quality& quality, long frames)
{
    Device& device = theatre.device;
    const SceneFile& scene = theatre.world.scene;
    std::vector<Window> windows;
    std::vector<GLFWwindow*> handles;
    for (const Output& output : layout.outputs) {
        windows.emplace_back(device, output);
        handles.push_back(windows.back().handle());
    }
    Frame frame(device, theatre.pipelines, theatre.world, layout, quality);
    Keyboard keyboard;
    Dashboard dashboard;
    Pace pace;
    Flight flight = flight_at(start);
    vk::raii::Fence done = device.device.createFence({vk::FenceCreateFlagBits::eSignaled});
    vk::raii::CommandBuffer commands
        = std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    Clock::time_point began = Clock::now(), last = began;

    for (long shown = 0; frames == 0 || shown < frames; ++shown) {
        // What the visitor wants, and where that leads.
        pace.wait();
        glfwPollEvents();
        Clock::time_point now = Clock::now();
        Controls controls = keyboard.read(handles, std::chrono::nanoseconds(now - began).count());
        bool closed = std::any_of(windows.begin(), windows.end(), [](const Window& w) { return w.closed(); });
        if (controls.quit || closed)
            break;
        if (controls.full_screen)
            for (Window& window : windows)
                window.switch_full_screen();
        // A stall of the machine must not become a leap of the ship.
        flight = step(flight, controls, std::min(seconds(now - last), 0.1), scene.seconds_per_time_unit(), start);
        last = now;

        // Which pictures to draw into. One frame is in flight: the least delay between a control and its picture.
        (void)device.device.waitForFences(*done, true, UINT64_MAX);
        std::vector<Target> targets(windows.size());
        std::vector<vk::SemaphoreSubmitInfo> wait, signal;
        std::vector<vk::SwapchainKHR> swapchains;
        std::vector<std::uint32_t> images;
        std::vector<vk::Semaphore> drawn;
        std::vector<Window*> presented;
        for (std::size_t i = 0; i < windows.size(); ++i)
            if (windows[i].acquire()) {
                frame.resize(i, windows[i].size());
                targets[i] = windows[i].target();
                wait.push_back({windows[i].acquired(), 0, Stage::eColorAttachmentOutput});
                signal.push_back({windows[i].drawn(), 0, Stage::eAllCommands});
                swapchains.push_back(windows[i].swapchain());
                images.push_back(windows[i].image());
                drawn.push_back(windows[i].drawn());
                presented.push_back(&windows[i]);
            }
        if (presented.empty()) {
            glfwWaitEventsTimeout(0.1); // all minimised
            continue;
        }

        // The frame: planned, culled and uploaded here, drawn there.
        std::string notice
            = seconds(now - began) < 25 ? "W faster   S slower   arrows turn   Space stop   R start again" : "";
        frame.prepare(shot_of(flight, start.scene), dashboard.update(flight, scene, frame.hud_width(), notice));
        device.device.resetFences(*done);
        commands.reset();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        for (const Target& target : targets)
            if (target.view)
                present_barrier(*commands, target, true);
        frame.record(*commands, targets);
        for (const Target& target : targets)
            if (target.view)
                present_barrier(*commands, target, false);
        commands.end();
        vk::CommandBufferSubmitInfo buffer(*commands);
        device.queue.submit2(vk::SubmitInfo2({}, wait, buffer, signal), *done);

        // All windows together.
        std::vector<vk::Result> results(swapchains.size(), vk::Result::eSuccess);
        vk::PresentInfoKHR present(drawn, swapchains, images, results);
        try {
            (void)device.queue.presentKHR(present);
        } catch (const vk::OutOfDateKHRError&) { // told per window below
        }
        for (std::size_t i = 0; i < presented.size(); ++i)
            presented[i]->presented(results[i]);
    }
    device.device.waitIdle();
    Readings told = readings(flight.ship, scene, flight.effects);
    for (const auto& [label, value] : hud_fields(told))
        std::printf("%s %s  ", label.c_str(), value.c_str());
    std::printf("\n");
    return device.complaints.empty() ? 0 : 1;
}

} // namespace starbow
