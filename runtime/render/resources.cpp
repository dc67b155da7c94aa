#include "resources.h"
#include "command_counts.h"
#include "config/json/error.h"
#include "debug.h"
#include "memory_type.h"
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdio>
#include <cstring>

namespace starbow {
namespace {

std::uint64_t next_serial()
{
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

/// Gives a buffer or an image its memory, in an arena or by itself. Software devices report a lack of memory only at the
/// binding.
template <class Resource>
vk::raii::DeviceMemory bind(const Device& device, const Resource& resource, MemoryUse use, MemoryArena* arena = nullptr)
{
    const vk::MemoryRequirements needs = resource.getMemoryRequirements();
    const auto type = memory_type(device.memory, needs.memoryTypeBits, use, needs.size);
    if (!type)
        throw InputError("The GPU offers no memory that the program needs: use another GPU or a newer driver");
    try {
        if (arena) {
            const MemoryArena::Place place = arena->place(device, needs, *type);
            resource.bindMemory(place.memory, place.offset);
            return nullptr;
        }
        vk::raii::DeviceMemory memory = device.device.allocateMemory({needs.size, *type});
        resource.bindMemory(*memory, 0);
        return memory;
    } catch (const vk::SystemError& error) {
        if (!lacks_memory(error))
            throw;
        if (use == MemoryUse::written) // the device's own memory that the processor reaches may be small
            return bind(device, resource, MemoryUse::staged, arena);
        throw NoRoom("The GPU has no " + std::to_string(needs.size >> 20)
            + " MiB in one piece: use smaller outputs, a smaller world, or a GPU with more memory");
    }
}

Buffer make_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage, MemoryUse use)
{
    Buffer buffer;
    buffer.serial = next_serial();
    buffer.size = std::max<vk::DeviceSize>(size, 16);
    buffer.buffer = device.device.createBuffer({{}, buffer.size, usage});
    buffer.memory = bind(device, buffer.buffer, use);
    if (use != MemoryUse::device)
        buffer.mapped = buffer.memory.mapMemory(0, buffer.size);
    std::array<char, 64> name;
    std::snprintf(name.data(), name.size(), "buffer of %llu bytes", static_cast<unsigned long long>(buffer.size));
    name_object(device, buffer, name.data());
    return buffer;
}

} // namespace

bool lacks_memory(const vk::SystemError& error)
{
    switch (vk::Result(error.code().value())) {
    case vk::Result::eErrorOutOfHostMemory:
    case vk::Result::eErrorOutOfDeviceMemory:
    case vk::Result::eErrorOutOfPoolMemory:
    case vk::Result::eErrorFragmentedPool:
    case vk::Result::eErrorMemoryMapFailed:
    case vk::Result::eErrorTooManyObjects:
        return true;
    default:
        return false;
    }
}

Buffer make_mapped_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage)
{
    const bool staged = usage == vk::BufferUsageFlags(vk::BufferUsageFlagBits::eTransferSrc);
    return make_buffer(device, size, usage, staged ? MemoryUse::staged : MemoryUse::written);
}

Buffer make_read_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage)
{
    return make_buffer(device, size, usage, MemoryUse::read);
}

Buffer make_static_buffer(Device& device, std::span<const std::byte> data, vk::BufferUsageFlags usage)
{
    Buffer staging = make_mapped_buffer(device, data.size(), vk::BufferUsageFlagBits::eTransferSrc);
    copy_to(staging, data);
    Buffer buffer = make_buffer(device, data.size(), usage | vk::BufferUsageFlagBits::eTransferDst, MemoryUse::device);
    device.now([&](vk::CommandBuffer commands) {
        commands.copyBuffer(*staging.buffer, *buffer.buffer, vk::BufferCopy(0, 0, buffer.size));
    });
    return buffer;
}

void copy_to(const Buffer& buffer, std::span<const std::byte> data, vk::DeviceSize at)
{
    if (!data.empty())
        std::memcpy(static_cast<std::byte*>(buffer.mapped) + at, data.data(), data.size());
    count_upload(data.size());
}

void grow(const Device& device, Buffer& buffer, vk::DeviceSize size, vk::BufferUsageFlags usage)
{
    if (buffer.size < size || !*buffer.buffer)
        buffer = make_mapped_buffer(device, size + size / 2, usage);
}

vk::ImageAspectFlags aspect_of(vk::Format format)
{
    return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

Image make_image(const Device& device, const ImageSpec& spec)
{
    std::uint32_t limit
        = spec.cube ? device.properties.limits.maxImageDimensionCube : device.properties.limits.maxImageDimension2D;
    if (std::max(spec.extent.width, spec.extent.height) > limit)
        throw InputError("A picture of " + std::to_string(spec.extent.width) + "x" + std::to_string(spec.extent.height)
            + " is more than this GPU can hold: at most " + std::to_string(limit) + " on a side");
    Image image;
    image.serial = next_serial();
    image.format = spec.format, image.extent = spec.extent, image.levels = spec.levels, image.layers = spec.layers;
    vk::ImageCreateInfo info(spec.cube ? vk::ImageCreateFlagBits::eCubeCompatible : vk::ImageCreateFlags(),
        vk::ImageType::e2D, spec.format, {spec.extent.width, spec.extent.height, 1}, spec.levels, spec.layers, spec.samples,
        vk::ImageTiling::eOptimal, spec.usage);
    image.image = device.device.createImage(info);
    image.bytes = image.image.getMemoryRequirements().size;
    image.memory = bind(device, image.image, MemoryUse::device, spec.arena);
    image.view = device.device.createImageView({{}, *image.image,
        spec.cube        ? vk::ImageViewType::eCube
            : spec.array ? vk::ImageViewType::e2DArray
                         : vk::ImageViewType::e2D,
        spec.format, {}, {aspect_of(spec.format), 0, spec.levels, 0, spec.layers}});
    std::array<char, 64> name;
    std::snprintf(
        name.data(), name.size(), "image %ux%u of format %d", spec.extent.width, spec.extent.height, int(spec.format));
    name_object(device, image, name.data());
    return image;
}

void transition(vk::CommandBuffer commands, const Image& image, vk::ImageLayout from, vk::PipelineStageFlags2 from_stage,
    vk::AccessFlags2 from_access, vk::ImageLayout to, vk::PipelineStageFlags2 to_stage, vk::AccessFlags2 to_access)
{
    vk::ImageMemoryBarrier2 barrier(from_stage, from_access, to_stage, to_access, from, to, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, *image.image, {aspect_of(image.format), 0, image.levels, 0, image.layers});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

void transition(vk::CommandBuffer commands, vk::Image image, vk::ImageLayout from, vk::PipelineStageFlags2 from_stage,
    vk::AccessFlags2 from_access, vk::ImageLayout to, vk::PipelineStageFlags2 to_stage, vk::AccessFlags2 to_access)
{
    vk::ImageMemoryBarrier2 barrier(from_stage, from_access, to_stage, to_access, from, to, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

namespace {

/// The bytes of a staging buffer, and so many rows of a texture at a time.
constexpr std::size_t strip_bytes = 8 << 20;

int strip_rows(std::size_t row_bytes, glm::ivec2 size)
{
    return int(std::clamp<std::size_t>(strip_bytes / row_bytes, 1, std::size_t(size.y)));
}

} // namespace

Image make_texture(
    Device& device, vk::Format format, glm::ivec2 size, std::span<const std::byte> pixels, bool mips, MemoryArena* arena)
{
    const std::size_t row_bytes = pixels.size() / std::size_t(size.y);
    return make_texture(
        device, format, size, row_bytes / std::size_t(size.x),
        [&](std::uint32_t, int first, int, std::span<std::byte> to) {
            std::memcpy(to.data(), pixels.data() + row_bytes * std::size_t(first), to.size());
        },
        mips, arena);
}

Image make_texture(Device& device, vk::Format format, glm::ivec2 size, std::size_t texel_bytes, const FillRows& fill,
    bool mips, MemoryArena* arena)
{
    const std::uint32_t levels = mips ? std::bit_width(std::uint32_t(std::max(size.x, size.y))) : 1;
    Image image = make_image(device,
        {.format = format,
            .extent = {std::uint32_t(size.x), std::uint32_t(size.y)},
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst
                | (levels > 1 ? vk::ImageUsageFlagBits::eColorAttachment : vk::ImageUsageFlags()),
            .levels = levels,
            .arena = arena});
    const std::size_t row_bytes = texel_bytes * std::size_t(size.x);
    const int strip = strip_rows(row_bytes, size);
    Buffer staging = make_mapped_buffer(device, row_bytes * std::size_t(strip), vk::BufferUsageFlagBits::eTransferSrc);

    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    using Layout = vk::ImageLayout;
    const auto put_strip = [&](vk::CommandBuffer commands, int first, int rows) {
        const auto barrier
            = [&](Layout from, Access from_access, Layout to, Access to_access, vk::PipelineStageFlags2 to_stage) {
                  const vk::ImageMemoryBarrier2 level(Stage::eTransfer, from_access, to_stage, to_access, from, to,
                      VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image.image,
                      {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
                  commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, level));
              };
        if (first == 0)
            barrier(Layout::eUndefined, {}, Layout::eTransferDstOptimal, Access::eTransferWrite, Stage::eTransfer);
        commands.copyBufferToImage(*staging.buffer, *image.image, Layout::eTransferDstOptimal,
            vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {0, first, 0},
                {image.extent.width, std::uint32_t(rows), 1}));
        if (first + rows == size.y)
            barrier(Layout::eTransferDstOptimal, Access::eTransferWrite, Layout::eShaderReadOnlyOptimal,
                Access::eShaderSampledRead, Stage::eFragmentShader);
    };
    for (int first = 0; first < size.y; first += strip) {
        const int rows = std::min(strip, size.y - first);
        fill(0, first, rows, {static_cast<std::byte*>(staging.mapped), row_bytes * std::size_t(rows)});
        device.now([&](vk::CommandBuffer commands) { put_strip(commands, first, rows); });
    }
    return image;
}

Image make_texture_array(
    Device& device, vk::Format format, glm::ivec2 size, std::uint32_t layers, std::size_t texel_bytes, const FillRows& fill)
{
    Image image = make_image(device,
        {.format = format,
            .extent = {std::uint32_t(size.x), std::uint32_t(size.y)},
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
            .layers = layers,
            .array = true});
    const std::size_t row_bytes = texel_bytes * std::size_t(size.x);
    const int strip = strip_rows(row_bytes, size);
    Buffer staging = make_mapped_buffer(device, row_bytes * std::size_t(strip), vk::BufferUsageFlagBits::eTransferSrc);
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    for (std::uint32_t layer = 0; layer < layers; ++layer)
        for (int first = 0; first < size.y; first += strip) {
            const int rows = std::min(strip, size.y - first);
            fill(layer, first, rows, {static_cast<std::byte*>(staging.mapped), row_bytes * std::size_t(rows)});
            const bool begins = layer == 0 && first == 0, ends = layer + 1 == layers && first + rows == size.y;
            device.now([&](vk::CommandBuffer commands) {
                if (begins)
                    transition(commands, image, vk::ImageLayout::eUndefined, Stage::eNone, {},
                        vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite);
                commands.copyBufferToImage(*staging.buffer, *image.image, vk::ImageLayout::eTransferDstOptimal,
                    vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, layer, 1}, {0, first, 0},
                        {image.extent.width, std::uint32_t(rows), 1}));
                if (ends)
                    transition(commands, image, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer,
                        Access::eTransferWrite, vk::ImageLayout::eShaderReadOnlyOptimal,
                        Stage::eVertexShader | Stage::eFragmentShader, Access::eShaderSampledRead);
            });
        }
    return image;
}

Image make_texture_array(
    Device& device, vk::Format format, glm::ivec2 size, std::uint32_t layers, std::span<const std::byte> pixels)
{
    const std::size_t texel_bytes = pixels.size() / (std::size_t(size.x) * size.y * layers);
    return make_texture_array(
        device, format, size, layers, texel_bytes, [&](std::uint32_t layer, int first, int, std::span<std::byte> to) {
            const std::size_t row = std::size_t(layer) * size.y + first;
            std::memcpy(to.data(), pixels.data() + row * size.x * texel_bytes, to.size());
        });
}

vk::Rect2D rect_of(glm::ivec2 corner, glm::ivec2 size)
{
    return {{corner.x, corner.y}, {std::uint32_t(size.x), std::uint32_t(size.y)}};
}

void set_area(vk::CommandBuffer commands, glm::ivec2 corner, glm::ivec2 size)
{
    commands.setViewport(0, vk::Viewport(corner.x, corner.y, size.x, size.y, 0, 1));
    commands.setScissor(0, rect_of(corner, size));
}

std::vector<std::byte> read_back(Device& device, const Image& image, std::uint32_t bytes_per_texel)
{
    std::size_t size = std::size_t(image.extent.width) * image.extent.height * bytes_per_texel;
    const Buffer staging = make_read_buffer(device, size, vk::BufferUsageFlagBits::eTransferDst);
    device.now([&](vk::CommandBuffer commands) {
        commands.copyImageToBuffer(*image.image, vk::ImageLayout::eTransferSrcOptimal, *staging.buffer,
            vk::BufferImageCopy(
                0, 0, 0, {aspect_of(image.format), 0, 0, 1}, {}, {image.extent.width, image.extent.height, 1}));
        vk::MemoryBarrier2 to_host(vk::PipelineStageFlagBits2::eTransfer, vk::AccessFlagBits2::eTransferWrite,
            vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
        commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    });
    std::vector<std::byte> data(size);
    std::memcpy(data.data(), staging.mapped, size);
    return data;
}

} // namespace starbow
