#pragma once
#include "config/json/error.h"
#include "memory_arena.h"
#include <functional>
#include <glm/glm.hpp>
#include <new>
#include <span>

namespace starbow {

/// The device has no memory left for what is to be drawn.
struct NoRoom : InputError {
    using InputError::InputError;
};
/// True if the driver has failed for want of memory or of room in its tables.
bool lacks_memory(const vk::SystemError& error);

/// Calls `make`, which makes objects on the device. A lack of memory, the device's or the processor's, is thrown as NoRoom.
template <class Make> auto in_room(Make&& make)
{
    try {
        return make();
    } catch (const vk::SystemError& error) {
        if (!lacks_memory(error))
            throw;
        throw NoRoom(std::string("The GPU's memory is used up (") + error.what() + ")");
    } catch (const std::bad_alloc&) {
        throw NoRoom("The memory is used up");
    }
}

struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer buffer = nullptr;
    vk::DeviceSize size = 0;
    void* mapped = nullptr; ///< null where the device alone has it; of a mapped buffer written alone, as reads may be slow
    std::uint64_t serial = 0; ///< unique for each buffer and image: Vulkan may reuse a handle
};

struct Image {
    vk::raii::DeviceMemory memory = nullptr; ///< null where an arena holds it
    vk::raii::Image image = nullptr;
    vk::raii::ImageView view = nullptr; ///< all levels and layers
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    std::uint32_t levels = 1, layers = 1;
    vk::DeviceSize bytes = 0; ///< bytes of device memory
    std::uint64_t serial = 0; ///< unique, as Buffer's
};

/// A mapped buffer that the processor writes and never reads, in each frame, or, as a source of transfers alone, once.
Buffer make_mapped_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage);
/// A mapped buffer that the processor reads.
Buffer make_read_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage);
/// A device-local buffer, filled once.
Buffer make_static_buffer(Device& device, std::span<const std::byte> data, vk::BufferUsageFlags usage);

/// Copies data into a mapped buffer, from the byte `at` on.
void copy_to(const Buffer& buffer, std::span<const std::byte> data, vk::DeviceSize at = 0);

/// Replaces a mapped buffer that is too small by one of 1.5 times the size.
void grow(const Device& device, Buffer& buffer, vk::DeviceSize size, vk::BufferUsageFlags usage);

/// A picture that a pass draws into, a swapchain's image or one of our own. It is in eColorAttachmentOptimal meanwhile.
struct Target {
    vk::Image image;
    vk::ImageView view;
    vk::Extent2D extent;
    vk::Format format;
};

struct ImageSpec {
    vk::Format format;
    vk::Extent2D extent;
    vk::ImageUsageFlags usage;
    std::uint32_t levels = 1;
    std::uint32_t layers = 1;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    bool cube = false;
    bool array = false; ///< its view is an array, even with one layer
    MemoryArena* arena = nullptr; ///< where its memory comes from; null: an allocation of its own
};
/// Throws InputError if the device can't hold so large a one, NoRoom if it has no memory for it.
Image make_image(const Device& device, const ImageSpec& spec);

vk::ImageAspectFlags aspect_of(vk::Format format);

/// A texture. mips: it has room for all coarser levels, which MipChain draws. arena: as ImageSpec's.
Image make_texture(Device& device, vk::Format format, glm::ivec2 size, std::span<const std::byte> pixels, bool mips,
    MemoryArena* arena = nullptr);
/// Writes rows of one layer, from first_row on.
using FillRows = std::function<void(std::uint32_t layer, int first_row, int rows, std::span<std::byte> to)>;
/// The same, filled a few MiB at a time, so that a large one needs no second copy of its own size on the way.
Image make_texture(Device& device, vk::Format format, glm::ivec2 size, std::size_t texel_bytes, const FillRows& fill,
    bool mips, MemoryArena* arena = nullptr);
/// An array of pictures for sampling, without mips, filled in the same way.
Image make_texture_array(
    Device& device, vk::Format format, glm::ivec2 size, std::uint32_t layers, std::size_t texel_bytes, const FillRows& fill);
/// The same from pixels in memory, one picture after the other.
Image make_texture_array(
    Device& device, vk::Format format, glm::ivec2 size, std::uint32_t layers, std::span<const std::byte> pixels);

/// One image barrier, whole image. The second form: of an image of a window, in colours and without mips.
void transition(vk::CommandBuffer commands, const Image& image, vk::ImageLayout from, vk::PipelineStageFlags2 from_stage,
    vk::AccessFlags2 from_access, vk::ImageLayout to, vk::PipelineStageFlags2 to_stage, vk::AccessFlags2 to_access);
void transition(vk::CommandBuffer commands, vk::Image image, vk::ImageLayout from, vk::PipelineStageFlags2 from_stage,
    vk::AccessFlags2 from_access, vk::ImageLayout to, vk::PipelineStageFlags2 to_stage, vk::AccessFlags2 to_access);

vk::Rect2D rect_of(glm::ivec2 corner, glm::ivec2 size);
/// Sets viewport and scissor.
void set_area(vk::CommandBuffer commands, glm::ivec2 corner, glm::ivec2 size);

/// Returns rows from the top, tightly packed; the image must be in eTransferSrcOptimal.
std::vector<std::byte> read_back(Device& device, const Image& image, std::uint32_t bytes_per_texel);

} // namespace starbow
