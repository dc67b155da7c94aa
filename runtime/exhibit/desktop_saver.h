#pragma once

struct sd_bus;

namespace starbow {

/// Keeps a desktop's own screen saver and its saving of power away while it lives: desktops do not ask the X server, but
/// whoever has called org.freedesktop.ScreenSaver on the session's bus. The desktop forgets the request with the connection,
/// also after a crash. Without a session's bus, as in a service, it does nothing.
class DesktopSaver {
public:
    DesktopSaver();
    ~DesktopSaver();
    DesktopSaver(const DesktopSaver&) = delete;

    /// Goes on with the request without waiting. Call it once a frame.
    void keep_away();

private:
    sd_bus* bus_ = nullptr;
};

} // namespace starbow
