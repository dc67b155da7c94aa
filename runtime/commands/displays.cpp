#include "commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/exhibit/desktop.h"
#include "runtime/exhibit/outputs.h"
#include "runtime/render/render_context.h"
#include <cstdio>

namespace starbow {
namespace {

void print(const GpuListing& gpu)
{
    std::printf(
        "GPU %s (%s; %s)%s\n", gpu.name.c_str(), gpu.kind.c_str(), gpu.driver.c_str(), gpu.chosen ? ": is used" : "");
    if (!gpu.refusal.empty())
        std::printf("    can't be used: it %s\n", gpu.refusal.c_str());
}

void print(const Monitor& monitor)
{
    std::printf("monitor %s: %d x %d at [%d, %d], %.2f Hz", monitor.connector.c_str(), monitor.size.x, monitor.size.y,
        monitor.position.x, monitor.position.y, monitor.refresh_hz);
    if (monitor.size_mm.x > 0)
        std::printf(", %d x %d mm", monitor.size_mm.x, monitor.size_mm.y);
    if (!monitor.model.empty())
        std::printf(", %s", monitor.model.c_str());
    if (!monitor.serial.empty())
        std::printf(", serial %s", monitor.serial.c_str());
    std::printf("%s\n    %s\n", monitor.primary ? ", primary" : "", layout_line(monitor, false).c_str());
    if (!monitor.model.empty())
        std::printf("    %s\n", layout_line(monitor, true).c_str());
}

int displays()
{
    const bool windows = has_display();
    const std::vector<GpuListing> gpus = list_gpus(device_options(windows));
    for (const GpuListing& gpu : gpus)
        print(gpu);
    if (gpus.empty())
        std::printf("Vulkan finds no GPU: install mesa-vulkan-drivers (software) or the GPU maker's driver.\n");
    if (!windows) {
        std::printf("There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no monitor is known.\n");
        return 0;
    }
    const WindowSystem window_system;
    const Desktop desktop;
    for (const Monitor& monitor : desktop.monitors())
        print(monitor);
    if (desktop.monitors().empty())
        std::printf("The display server shows no monitor: is one plugged in and switched on?\n");
    return 0;
}

} // namespace

static void add_displays(Subcommand& app, std::function<int()>& chosen)
{
    Subcommand* command
        = app.add_subcommand("displays", "List the GPUs, and the monitors with the line that names each in a layout.");
    command->footer("Example:\n  starbow displays");
    command->callback([&chosen] { chosen = displays; });
}

static const Registered displays_command{5, add_displays};

} // namespace starbow
