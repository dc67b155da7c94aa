#pragma once
#include "config/model/layout.h"
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// A screen that is plugged in and shows a part of the desktop.
struct Monitor {
    std::string connector; ///< as the system names it
    std::string model, serial; ///< from its EDID; empty where it has none
    glm::ivec2 position{0}, size{0}; ///< on the desktop, pixels
    glm::ivec2 size_mm{0}; ///< 0: unknown
    double refresh_hz = 60;
    bool primary = false;
    bool operator==(const Monitor&) const = default;
};

/// One of the monitors, or the reason why none of them is meant.
struct MonitorChoice {
    std::optional<std::size_t> monitor;
    std::string problem; ///< "... is plugged in nowhere; there are: ..."
};

/// The monitor that a layout's name means. Where it fits several that show different parts of the desktop, none is meant: a
/// picture on the wrong screen is worse than none. An empty name means the primary monitor, or else the first.
MonitorChoice choose_monitor(const MonitorName& name, const std::vector<Monitor>& monitors);

/// Whether an output says where its window goes; the others open where the desktop likes.
bool has_place(const Output& output);

/// A window on the desktop, pixels.
struct WindowPlace {
    glm::ivec2 corner, size;
    bool operator==(const WindowPlace&) const = default;
};
/// Where an output's window goes on its monitor. A window that is not placed by the layout is shrunk to fit its monitor,
/// lest it reach into the next; one that is placed may reach across several.
WindowPlace place_on(const Monitor& monitor, const Output& output);

/// What a layout writes to mean this monitor: "monitor": { ... }. by_edid: by model and serial instead of the connector.
std::string layout_line(const Monitor& monitor, bool by_edid);

/// For messages: DUMMY1 (DELL U2415 7MT01), or "none".
std::string list_of(const std::vector<Monitor>& monitors);

} // namespace starbow
