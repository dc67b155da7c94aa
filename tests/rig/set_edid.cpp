// Gives a monitor of the X server an EDID, as its driver does: set_edid CONNECTOR MODEL SERIAL.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <xcb/randr.h>

namespace {

void text(std::uint8_t* descriptor, std::uint8_t tag, std::string text)
{
    descriptor[3] = tag;
    text += '\n';
    text.resize(13, ' ');
    std::memcpy(descriptor + 5, text.data(), 13);
}

} // namespace

int main(int count, char** arguments)
{
    if (count != 4)
        return 2;
    std::uint8_t edid[128] = {0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0};
    text(edid + 72, 0xfc, arguments[2]);
    text(edid + 90, 0xff, arguments[3]);
    for (int i = 0; i < 127; ++i)
        edid[127] = std::uint8_t(edid[127] - edid[i]);

    xcb_connection_t* x = xcb_connect(nullptr, nullptr);
    if (xcb_connection_has_error(x))
        return 1;
    const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(x)).data->root;
    const xcb_atom_t name = xcb_intern_atom_reply(x, xcb_intern_atom(x, false, 4, "EDID"), nullptr)->atom;
    auto* resources
        = xcb_randr_get_screen_resources_current_reply(x, xcb_randr_get_screen_resources_current(x, root), nullptr);
    const xcb_randr_output_t* outputs = xcb_randr_get_screen_resources_current_outputs(resources);
    for (int i = 0; i < xcb_randr_get_screen_resources_current_outputs_length(resources); ++i) {
        auto* info = xcb_randr_get_output_info_reply(
            x, xcb_randr_get_output_info(x, outputs[i], resources->config_timestamp), nullptr);
        const std::string connector(reinterpret_cast<const char*>(xcb_randr_get_output_info_name(info)),
            std::size_t(xcb_randr_get_output_info_name_length(info)));
        if (connector == arguments[1]) {
            xcb_randr_change_output_property(
                x, outputs[i], name, XCB_ATOM_INTEGER, 8, XCB_PROP_MODE_REPLACE, sizeof edid, edid);
            xcb_get_input_focus_reply(x, xcb_get_input_focus(x),
                nullptr); // waits for the server, so that the change is made before the program ends
            return 0;
        }
    }
    return 1;
}
