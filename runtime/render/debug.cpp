#include "debug.h"

namespace starbow {

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
