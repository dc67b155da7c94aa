#include "monitors.h"
#include <algorithm>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

bool fits(const MonitorName& name, const Monitor& monitor)
{
    return (name.connector.empty() || name.connector == monitor.connector)
        && (name.model.empty() || name.model == monitor.model) && (name.serial.empty() || name.serial == monitor.serial)
        && (!name.position || *name.position == monitor.position);
}

std::string pixels(glm::ivec2 at)
{
    std::string text = "[";
    text += std::to_string(at.x) + ", " + std::to_string(at.y);
    return text += "]";
}

std::string describe(const Monitor& monitor)
{
    std::string text = monitor.connector + " at " + pixels(monitor.position);
    if (!monitor.model.empty())
        text += " (" + monitor.model + (monitor.serial.empty() ? "" : " " + monitor.serial) + ")";
    return text;
}

/// The name in the form of its layout's members: connector "DUMMY1", position [0, 0].
std::string describe(const MonitorName& name)
{
    std::string text;
    auto add = [&](const std::string& member, const std::string& value) {
        text += (text.empty() ? "" : ", ") + member + " " + value;
    };
    if (!name.connector.empty())
        add("connector", "\"" + name.connector + "\"");
    if (!name.model.empty())
        add("model", "\"" + name.model + "\"");
    if (!name.serial.empty())
        add("serial", "\"" + name.serial + "\"");
    if (name.position)
        add("position", pixels(*name.position));
    return text.empty() ? "any monitor" : "the monitor with " + text;
}

} // namespace

std::string list_of(const std::vector<Monitor>& monitors)
{
    std::string list;
    for (const Monitor& monitor : monitors)
        list += (list.empty() ? "" : ", ") + describe(monitor);
    return list.empty() ? "none" : list;
}

MonitorChoice choose_monitor(const MonitorName& name, const std::vector<Monitor>& monitors)
{
    std::vector<Monitor> fitting;
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < monitors.size(); ++i)
        if (fits(name, monitors[i])) {
            fitting.push_back(monitors[i]);
            if (!first || (name.empty() && monitors[i].primary))
                first = i;
        }
    if (!first)
        return {{}, describe(name) + " is plugged in nowhere; there are: " + list_of(monitors)};
    const bool all_the_same = std::all_of(fitting.begin(), fitting.end(),
        [&](const Monitor& m) { return m.position == fitting[0].position && m.size == fitting[0].size; });
    if (!name.empty() && !all_the_same)
        return {{},
            describe(name) + " is plugged in more than once: " + list_of(fitting) + "; a connector as well makes it unique"};
    return {first, {}};
}

bool has_place(const Output& output) { return !output.monitor.empty() || output.whole_monitor || output.place; }

WindowPlace place_on(const Monitor& monitor, const Output& output)
{
    if (output.whole_monitor)
        return {monitor.position, monitor.size};
    if (output.place)
        return {monitor.position + *output.place, output.size};
    const glm::dvec2 room = glm::dvec2(monitor.size) / glm::dvec2(output.size);
    const double shrink = std::min({1.0, room.x, room.y});
    return {monitor.position, glm::max(glm::ivec2(glm::dvec2(output.size) * shrink), 1)};
}

std::optional<std::size_t> largest_share(const WindowPlace& window, const std::vector<WindowPlace>& places)
{
    std::optional<std::size_t> found;
    std::int64_t most = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const glm::ivec2 low = glm::max(window.corner, places[i].corner),
                         high = glm::min(window.corner + window.size, places[i].corner + places[i].size);
        const std::int64_t area = low.x < high.x && low.y < high.y ? std::int64_t(high.x - low.x) * (high.y - low.y) : 0;
        if (area > most)
            found = i, most = area;
    }
    return found;
}

std::string layout_line(const Monitor& monitor, bool by_edid)
{
    nlohmann::ordered_json name;
    if (by_edid) {
        name["model"] = monitor.model;
        if (!monitor.serial.empty())
            name["serial"] = monitor.serial;
    } else {
        name["connector"] = monitor.connector;
    }
    std::string members;
    for (const auto& [key, value] : name.items())
        members += (members.empty() ? "" : ", ") + nlohmann::json(key).dump() + ": "
            + value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    return "\"monitor\": { " + members + " }";
}

} // namespace starbow
