#include "debug.h"
#include <array>
#include <cstdio>

namespace starbow {
namespace {

/// A name with a suffix, on the stack.
struct Suffixed {
    std::array<char, 96> text;
    Suffixed(const char* name, const char* suffix) { std::snprintf(text.data(), text.size(), "%s%s", name, suffix); }
};

} // namespace

void name_object(const Device& device, const Image& image, const char* name)
{
    name_object(device, image.image, name);
    name_object(device, image.view, Suffixed(name, " view").text.data());
    name_object(device, image.memory, Suffixed(name, " memory").text.data());
}

void name_object(const Device& device, const Buffer& buffer, const char* name)
{
    name_object(device, buffer.buffer, name);
    name_object(device, buffer.memory, Suffixed(name, " memory").text.data());
}

Label::Label(const Device& device, vk::CommandBuffer commands, const char* name)
    : device_(device)
    , commands_(commands)
{
    if (device.debug_utils)
        commands.beginDebugUtilsLabelEXT(vk::DebugUtilsLabelEXT(name), *device.device.getDispatcher());
    if (device.timer)
        device.timer->begin_span(commands, name);
}

Label::~Label()
{
    if (device_.timer)
        device_.timer->end_span(commands_);
    if (device_.debug_utils)
        commands_.endDebugUtilsLabelEXT(*device_.device.getDispatcher());
}

} // namespace starbow
