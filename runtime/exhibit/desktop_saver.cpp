#include "desktop_saver.h"
#include <systemd/sd-bus.h>
#include <utility>

namespace starbow {

DesktopSaver::DesktopSaver()
{
    if (sd_bus_open_user(&bus_) < 0)
        return;
    // The answer, a number to end the request with, is not needed: the connection's end does it.
    sd_bus_call_method_async(bus_, nullptr, "org.freedesktop.ScreenSaver", "/org/freedesktop/ScreenSaver",
        "org.freedesktop.ScreenSaver", "Inhibit", nullptr, nullptr, "ss", "Starbow", "an exhibit is shown");
}

DesktopSaver::~DesktopSaver() { sd_bus_unref(bus_); }

void DesktopSaver::keep_away()
{
    int done = bus_ ? 1 : 0;
    while (done > 0)
        done = sd_bus_process(bus_, nullptr);
    if (done < 0)
        sd_bus_unref(std::exchange(bus_, nullptr)); // the session's bus has ended
}

} // namespace starbow
