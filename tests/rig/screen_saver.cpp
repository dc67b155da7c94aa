// A desktop's screen saver on the session's bus: prints a line when somebody keeps it away, and when that somebody is gone.
//   screen_saver FILE   appends the lines to FILE; it runs until it is killed
#include <cstdio>
#include <string>
#include <systemd/sd-bus.h>

namespace {

std::string file, keeper;

void say(const std::string& line)
{
    if (std::FILE* out = std::fopen(file.c_str(), "a")) {
        std::fprintf(out, "%s\n", line.c_str());
        std::fclose(out);
    }
}

int inhibit(sd_bus_message* call, void*, sd_bus_error*)
{
    const char *name = "", *reason = "";
    if (const int result = sd_bus_message_read(call, "ss", &name, &reason); result < 0)
        return result;
    keeper = sd_bus_message_get_sender(call);
    say(std::string("kept away by ") + name + ": " + reason);
    return sd_bus_reply_method_return(call, "u", 1u);
}

int owner_changed(sd_bus_message* signal, void*, sd_bus_error*)
{
    const char *name = "", *before = "", *after = "";
    if (sd_bus_message_read(signal, "sss", &name, &before, &after) >= 0 && keeper == name && *after == 0)
        say("free again");
    return 0;
}

const sd_bus_vtable methods[]
    = {SD_BUS_VTABLE_START(0), SD_BUS_METHOD("Inhibit", "ss", "u", inhibit, SD_BUS_VTABLE_UNPRIVILEGED), SD_BUS_VTABLE_END};

} // namespace

int main(int count, char** arguments)
{
    sd_bus* bus = nullptr;
    constexpr const char* saver = "org.freedesktop.ScreenSaver";
    if (count < 2 || sd_bus_open_user(&bus) < 0)
        return 2;
    file = arguments[1];
    if (sd_bus_add_object_vtable(bus, nullptr, "/org/freedesktop/ScreenSaver", saver, methods, nullptr) < 0
        || sd_bus_match_signal(bus, nullptr, "org.freedesktop.DBus", "/org/freedesktop/DBus", "org.freedesktop.DBus",
               "NameOwnerChanged", owner_changed, nullptr)
            < 0
        || sd_bus_request_name(bus, saver, 0) < 0)
        return 2;
    say("ready");
    for (;;) {
        const int done = sd_bus_process(bus, nullptr);
        if (done < 0)
            return 0;
        if (done == 0)
            sd_bus_wait(bus, UINT64_MAX);
    }
}
