#include "debug.h"

namespace starbow {

void name_object(const Device& device, const Image& image, const std::string& name)
{
    name_object(device, image.image, name);
    name_object(device, image.view, name + " view");
    name_object(device, image.memory, name + " memory");
}

void name_object(const Device& device, const Buffer& buffer, const std::string& name)
{
    name_object(device, buffer.buffer, name);
    name_object(device, buffer.memory, name + " memory");
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
