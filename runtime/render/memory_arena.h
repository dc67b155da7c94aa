#pragma once
#include "device.h"

namespace starbow {

/// Device memory for many images that live equally long. A device guarantees 4,096 allocations at one time, and a world may
/// have more textures than that: they share blocks here. A block's memory is freed with the arena, which must outlive the
/// images in it.
class MemoryArena {
public:
    /// Memory for one optimally tiled image. Throws vk::SystemError where the device has none left.
    struct Place {
        vk::DeviceMemory memory;
        vk::DeviceSize offset = 0;
    };
    Place place(const Device& device, const vk::MemoryRequirements& needs, std::uint32_t type);

    std::size_t blocks() const { return blocks_.size(); }

private:
    struct Block {
        vk::raii::DeviceMemory memory = nullptr;
        std::uint32_t type = 0;
        vk::DeviceSize size = 0, used = 0;
    };
    std::vector<Block> blocks_;
};

} // namespace starbow
