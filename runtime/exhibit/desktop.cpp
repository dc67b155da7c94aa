#include "desktop.h"
#include "runtime/operation/edid.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <xcb/randr.h>
#include <xcb/xcb.h>

namespace starbow {
namespace {

/// A reply of the X server. It is null where the server refused, as for a monitor that is just being unplugged.
template <class Answer> using Reply = std::unique_ptr<Answer, decltype(&std::free)>;
template <class Answer> Reply<Answer> reply(Answer* answer) { return {answer, &std::free}; }

} // namespace

/// A connection to the X server of DISPLAY.
struct XServer {
    xcb_connection_t* link;
    xcb_window_t root = 0;

    XServer()
    {
        int number = 0;
        link = xcb_connect(nullptr, &number);
        if (xcb_connection_has_error(link))
            return;
        xcb_screen_iterator_t screen = xcb_setup_roots_iterator(xcb_get_setup(link));
        for (; number > 0 && screen.rem > 1; --number)
            xcb_screen_next(&screen);
        root = screen.data->root;
    }
    ~XServer() { xcb_disconnect(link); }
    XServer(const XServer&) = delete;
    bool answers() const { return !xcb_connection_has_error(link); }

    xcb_atom_t atom(const char* name) const
    {
        auto known = reply(
            xcb_intern_atom_reply(link, xcb_intern_atom(link, true, std::uint16_t(std::strlen(name)), name), nullptr));
        return known ? known->atom : xcb_atom_t(XCB_ATOM_NONE);
    }
};

namespace {

double refresh_hz(const xcb_randr_mode_info_t& mode)
{
    double lines = mode.vtotal;
    if (mode.mode_flags & XCB_RANDR_MODE_FLAG_DOUBLE_SCAN)
        lines *= 2;
    if (mode.mode_flags & XCB_RANDR_MODE_FLAG_INTERLACE)
        lines /= 2;
    return mode.htotal > 0 && lines > 0 ? mode.dot_clock / (mode.htotal * lines) : 60;
}

std::optional<Edid> read_edid(const XServer& x, xcb_randr_output_t output)
{
    const xcb_atom_t name = x.atom("EDID");
    if (name == XCB_ATOM_NONE)
        return {};
    auto found = reply(xcb_randr_get_output_property_reply(x.link,
        xcb_randr_get_output_property(x.link, output, name, XCB_GET_PROPERTY_TYPE_ANY, 0, 32, false, false), nullptr));
    if (!found || found->format != 8)
        return {};
    const std::uint8_t* bytes = xcb_randr_get_output_property_data(found.get());
    return parse_edid({bytes, std::size_t(xcb_randr_get_output_property_data_length(found.get()))});
}

std::optional<Monitor> read_monitor(
    const XServer& x, xcb_randr_output_t output, const xcb_randr_get_screen_resources_current_reply_t* resources)
{
    auto info = reply(xcb_randr_get_output_info_reply(
        x.link, xcb_randr_get_output_info(x.link, output, resources->config_timestamp), nullptr));
    if (!info || info->connection == XCB_RANDR_CONNECTION_DISCONNECTED || info->crtc == XCB_NONE)
        return {};
    auto shown = reply(xcb_randr_get_crtc_info_reply(
        x.link, xcb_randr_get_crtc_info(x.link, info->crtc, resources->config_timestamp), nullptr));
    if (!shown || shown->mode == XCB_NONE)
        return {};
    Monitor monitor;
    const char* name = reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info.get()));
    monitor.connector.assign(name, std::size_t(xcb_randr_get_output_info_name_length(info.get())));
    monitor.position = {shown->x, shown->y};
    monitor.size = {shown->width, shown->height};
    monitor.size_mm = {info->mm_width, info->mm_height};
    if (shown->rotation & (XCB_RANDR_ROTATION_ROTATE_90 | XCB_RANDR_ROTATION_ROTATE_270))
        std::swap(monitor.size_mm.x, monitor.size_mm.y);
    const xcb_randr_mode_info_t* modes = xcb_randr_get_screen_resources_current_modes(resources);
    for (int i = 0; i < xcb_randr_get_screen_resources_current_modes_length(resources); ++i)
        if (modes[i].id == shown->mode)
            monitor.refresh_hz = refresh_hz(modes[i]);
    if (const auto edid = read_edid(x, output)) {
        monitor.model = edid->model;
        monitor.serial = edid->serial;
    }
    return monitor;
}

/// Sorts monitors from left to right, then from top to bottom, whatever the order of their plugs.
void sort(std::vector<Monitor>& monitors)
{
    std::sort(monitors.begin(), monitors.end(), [](const Monitor& a, const Monitor& b) {
        return std::tuple(a.position.x, a.position.y, a.connector) < std::tuple(b.position.x, b.position.y, b.connector);
    });
}

std::vector<Monitor> read_monitors(const XServer& x)
{
    std::vector<Monitor> monitors;
    auto resources = reply(xcb_randr_get_screen_resources_current_reply(
        x.link, xcb_randr_get_screen_resources_current(x.link, x.root), nullptr));
    auto primary = reply(xcb_randr_get_output_primary_reply(x.link, xcb_randr_get_output_primary(x.link, x.root), nullptr));
    if (!resources)
        return monitors;
    const xcb_randr_output_t* outputs = xcb_randr_get_screen_resources_current_outputs(resources.get());
    for (int i = 0; i < xcb_randr_get_screen_resources_current_outputs_length(resources.get()); ++i)
        if (auto monitor = read_monitor(x, outputs[i], resources.get())) {
            monitor->primary = primary && primary->output == outputs[i];
            monitors.push_back(*monitor);
        }
    sort(monitors);
    return monitors;
}

/// The monitors as GLFW reports them, without identities.
std::vector<Monitor> glfw_monitors()
{
    std::vector<Monitor> monitors;
    int count = 0;
    GLFWmonitor** all = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        const GLFWvidmode* mode = glfwGetVideoMode(all[i]);
        if (!mode)
            continue;
        Monitor monitor;
        monitor.connector = glfwGetMonitorName(all[i]);
        glfwGetMonitorPos(all[i], &monitor.position.x, &monitor.position.y);
        glfwGetMonitorPhysicalSize(all[i], &monitor.size_mm.x, &monitor.size_mm.y);
        monitor.size = {mode->width, mode->height};
        monitor.refresh_hz = mode->refreshRate > 0 ? mode->refreshRate : 60;
        monitor.primary = i == 0;
        monitors.push_back(monitor);
    }
    sort(monitors);
    return monitors;
}

} // namespace

struct Desktop::Connection {
    XServer x;
    bool randr = false;

    Connection()
    {
        const bool x11 = std::strstr(glfwGetVersionString(), "X11") != nullptr;
        const xcb_query_extension_reply_t* extension
            = x11 && x.answers() ? xcb_get_extension_data(x.link, &xcb_randr_id) : nullptr;
        if (!extension || !extension->present)
            return;
        auto version = reply(xcb_randr_query_version_reply(x.link, xcb_randr_query_version(x.link, 1, 3), nullptr));
        randr = version && std::pair(version->major_version, version->minor_version) >= std::pair(1u, 3u);
        if (randr)
            xcb_randr_select_input(x.link, x.root,
                XCB_RANDR_NOTIFY_MASK_SCREEN_CHANGE | XCB_RANDR_NOTIFY_MASK_CRTC_CHANGE | XCB_RANDR_NOTIFY_MASK_OUTPUT_CHANGE
                    | XCB_RANDR_NOTIFY_MASK_OUTPUT_PROPERTY);
    }
    bool has_changes()
    {
        bool any = false;
        while (auto event = reply(xcb_poll_for_event(x.link)))
            any = true;
        return any;
    }
    std::vector<Monitor> read() const { return randr ? read_monitors(x) : glfw_monitors(); }
};

Desktop::Desktop()
    : connection_(std::make_unique<Connection>())
    , monitors_(connection_->read())
    , looked_(std::chrono::steady_clock::now())
{
}

Desktop::~Desktop() = default;

bool Desktop::look()
{
    const auto now = std::chrono::steady_clock::now();
    if (!connection_->has_changes() && now - looked_ < std::chrono::seconds(1))
        return false;
    looked_ = now;
    std::vector<Monitor> seen = connection_->read();
    if (connection_->randr && !connection_->x.answers())
        return false; // the server has gone, not its monitors
    const bool changed = seen != monitors_;
    monitors_ = std::move(seen);
    return changed;
}

std::shared_ptr<void> forget_dead_window_manager()
{
    const auto x = std::make_shared<XServer>();
    if (!x->answers())
        return x;
    const xcb_atom_t check = x->atom("_NET_SUPPORTING_WM_CHECK");
    if (check == XCB_ATOM_NONE)
        return x;
    auto named = reply(
        xcb_get_property_reply(x->link, xcb_get_property(x->link, false, x->root, check, XCB_ATOM_WINDOW, 0, 1), nullptr));
    if (!named || xcb_get_property_value_length(named.get()) != int(sizeof(xcb_window_t)))
        return x;
    xcb_window_t manager;
    std::memcpy(&manager, xcb_get_property_value(named.get()), sizeof manager);
    auto existence_intervals = reply(xcb_get_geometry_reply(x->link, xcb_get_geometry(x->link, manager), nullptr));
    if (!existence_intervals) {
        xcb_delete_property(x->link, x->root, check);
        // The server replies only after the deletion.
        reply(xcb_get_input_focus_reply(x->link, xcb_get_input_focus(x->link), nullptr));
    }
    return x;
}

} // namespace starbow
