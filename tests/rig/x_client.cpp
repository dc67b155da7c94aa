// Another program on the X server:
//   x_client grab SECONDS   grabs the keyboard, prints "grabbed", and lets it go after that time
//   x_client focus          gives the focus to no window
//   x_client close WINDOW   asks for the window's end, as its frame's button does
//   x_client saver          prints the state of the screen saver: off, on, or disabled
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <xcb/screensaver.h>
#include <xcb/xcb.h>

int main(int count, char** arguments)
{
    xcb_connection_t* link = xcb_connect(nullptr, nullptr);
    if (xcb_connection_has_error(link) || count < 2)
        return 2;
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(link)).data->root;
    if (std::strcmp(arguments[1], "saver") == 0) {
        const auto* state = xcb_screensaver_query_info_reply(link, xcb_screensaver_query_info(link, root), nullptr);
        std::puts(!state ? "none" : state->state == 0 ? "off" : state->state == 1 ? "on" : "disabled");
        return 0;
    }
    if (std::strcmp(arguments[1], "focus") == 0) {
        xcb_set_input_focus(link, XCB_INPUT_FOCUS_NONE, XCB_NONE, XCB_CURRENT_TIME);
        std::free(xcb_get_input_focus_reply(link, xcb_get_input_focus(link), nullptr)); // after the focus has changed
        return 0;
    }
    if (std::strcmp(arguments[1], "close") == 0 && count > 2) {
        const auto atom = [&](const char* name) {
            return xcb_intern_atom_reply(link, xcb_intern_atom(link, false, std::uint16_t(std::strlen(name)), name), nullptr)
                ->atom;
        };
        xcb_client_message_event_t ask{};
        ask.response_type = XCB_CLIENT_MESSAGE, ask.format = 32;
        ask.window = xcb_window_t(std::strtoul(arguments[2], nullptr, 0));
        ask.type = atom("WM_PROTOCOLS"), ask.data.data32[0] = atom("WM_DELETE_WINDOW");
        xcb_send_event(link, false, ask.window, XCB_EVENT_MASK_NO_EVENT, reinterpret_cast<const char*>(&ask));
        xcb_flush(link);
        std::free(xcb_get_input_focus_reply(link, xcb_get_input_focus(link), nullptr)); // it has been sent
        return 0;
    }
    const auto* grab = xcb_grab_keyboard_reply(
        link, xcb_grab_keyboard(link, false, root, XCB_CURRENT_TIME, XCB_GRAB_MODE_ASYNC, XCB_GRAB_MODE_ASYNC), nullptr);
    if (!grab || grab->status != XCB_GRAB_STATUS_SUCCESS || count < 3)
        return 1;
    std::puts("grabbed");
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(arguments[2])));
    xcb_disconnect(link); // which ends the grab
}
