#pragma once
#include "frame_timer.h"
#include "resources.h"

namespace starbow {

/// Gives a Vulkan object the name by which validation messages and captures call it (VK_EXT_debug_utils). Does nothing
/// where the instance lacks the extension. object: a vk::raii handle. Allocates no heap memory, because frames make
/// buffers when they grow.
template <class Object> void name_object(const Device& device, const Object& object, const char* name)
{
    if (!device.debug_utils || !*object)
        return;
    using Handle = std::remove_cvref_t<decltype(*object)>;
    device.device.setDebugUtilsObjectNameEXT(
        {Handle::objectType, reinterpret_cast<std::uint64_t>(static_cast<typename Handle::NativeType>(*object)), name});
}

/// Names an image with its view and memory, or a buffer with its memory.
void name_object(const Device& device, const Image& image, const char* name);
void name_object(const Device& device, const Buffer& buffer, const char* name);

/// Marks the commands that are recorded during its lifetime as one pass: a label in captures, and a span of the device's
/// time where Device::timer is set.
class Label {
public:
    Label(const Device& device, vk::CommandBuffer commands, const char* name);
    ~Label();
    Label(const Label&) = delete;
    Label& operator=(const Label&) = delete;

private:
    const Device& device_;
    vk::CommandBuffer commands_;
};

} // namespace starbow
