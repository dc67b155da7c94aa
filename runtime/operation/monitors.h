#pragma once
#include "config/model/layout.h"
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// A screen that is plugged in and shows a part of the desktop.
struct Monitor {
    std::string connector; ///< the system's name of it
    std::string model, serial; ///< from its EDID; empty where it has none
    glm::ivec2 position{0}, size{0}; ///< on the desktop, pixels
    glm::ivec2 size_mm{0}; ///< 0: unknown
    double refresh_hz = 60;
    bool primary = false;
    bool operator==(const Monitor&) const = default;
};

/// The chosen monitor, or the reason why there is none.
struct MonitorChoice {
    std::optional<std::size_t> monitor;
    std::string problem; ///< "... is plugged in nowhere; there are: ..."
};

/// The monitor that a layout names. If the name fits several that show different parts of the desktop, none is chosen: a
/// picture on the wrong screen is worse than none. An empty name means the primary monitor, or else the first.
MonitorChoice choose_monitor(const MonitorName& name, const std::vector<Monitor>& monitors);

/// True if an output names its window's place; the desktop places the other windows.
bool has_place(const Output& output);

/// A window's place on the desktop, pixels.
struct WindowPlace {
    glm::ivec2 corner, size;
    bool operator==(const WindowPlace&) const = default;
};
/// The place of an output's window on its monitor. A window without a place in the layout is shrunk to fit its monitor, lest
/// it reach into the next. A window with a place may reach across several.
WindowPlace place_on(const Monitor& monitor, const Output& output);

/// The index of the place that shares the largest area with the window; nothing if none shares any.
std::optional<std::size_t> largest_share(const WindowPlace& window, const std::vector<WindowPlace>& places);

/// The layout's line that names this monitor: "monitor": { ... }. by_edid: by model and serial instead of the connector.
std::string layout_line(const Monitor& monitor, bool by_edid);

/// For messages: DUMMY1 (DELL U2415 7MT01), or "none".
std::string list_of(const std::vector<Monitor>& monitors);

} // namespace starbow
