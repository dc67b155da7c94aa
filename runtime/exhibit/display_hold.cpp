#include "display_hold.h"
#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <vector>
#include <xcb/screensaver.h>
#include <xcb/xcb.h>

namespace starbow {
namespace {

/// The X server's number of a window. GLFW has the function where it was built for X11; its header would bring Xlib along.
xcb_window_t number_of(GLFWwindow* window)
{
    using Function = unsigned long (*)(GLFWwindow*);
    static const auto function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, "glfwGetX11Window"));
    return function ? xcb_window_t(function(window)) : xcb_window_t(XCB_NONE);
}

} // namespace

struct DisplayHold::Connection {
    xcb_connection_t* link = xcb_connect(nullptr, nullptr);
    std::vector<xcb_window_t> followed; ///< windows whose focus is reported
    bool grabbed = false;

    ~Connection() { xcb_disconnect(link); }
    void take(const xcb_generic_event_t& event)
    {
        const int type = event.response_type & 0x7f;
        if (type != XCB_FOCUS_IN && type != XCB_FOCUS_OUT)
            return;
        const auto& focus = reinterpret_cast<const xcb_focus_in_event_t&>(event);
        if (type == XCB_FOCUS_IN)
            grabbed = false;
        else if (focus.mode == XCB_NOTIFY_MODE_GRAB)
            grabbed = true;
    }
};

DisplayHold::DisplayHold()
    : connection_(std::make_unique<Connection>())
{
    if (xcb_connection_has_error(connection_->link))
        return;
    const xcb_query_extension_reply_t* saver = xcb_get_extension_data(connection_->link, &xcb_screensaver_id);
    if (!saver || !saver->present)
        return;
    // Suspension came with version 1.1. The server must know the client's version first.
    std::free(xcb_screensaver_query_version_reply(
        connection_->link, xcb_screensaver_query_version(connection_->link, 1, 1), nullptr));
    xcb_screensaver_suspend(connection_->link, 1);
    xcb_flush(connection_->link);
}

DisplayHold::~DisplayHold() = default;

bool DisplayHold::keyboard_grabbed(std::span<GLFWwindow* const> windows)
{
    if (xcb_connection_has_error(connection_->link))
        return false;
    std::vector<xcb_window_t> now;
    for (GLFWwindow* window : windows)
        now.push_back(number_of(window));
    for (const xcb_window_t window : now)
        if (window != XCB_NONE
            && std::find(connection_->followed.begin(), connection_->followed.end(), window)
                == connection_->followed.end()) {
            const std::uint32_t events = XCB_EVENT_MASK_FOCUS_CHANGE; // of this connection; GLFW's has its own
            xcb_change_window_attributes(connection_->link, window, XCB_CW_EVENT_MASK, &events);
            xcb_flush(connection_->link);
            connection_->grabbed = false; // else a grab would last for ever whose window is gone
        }
    connection_->followed = std::move(now);
    while (xcb_generic_event_t* event = xcb_poll_for_event(connection_->link)) {
        connection_->take(*event);
        std::free(event);
    }
    return connection_->grabbed;
}

} // namespace starbow
