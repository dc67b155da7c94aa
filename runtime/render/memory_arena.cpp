#include "memory_arena.h"
#include "debug.h"
#include <algorithm>

namespace starbow {

MemoryArena::Place MemoryArena::place(const Device& device, const vk::MemoryRequirements& needs, std::uint32_t type)
{
    const auto start_in
        = [&](const Block& block) { return (block.used + needs.alignment - 1) / needs.alignment * needs.alignment; };
    auto block = std::find_if(blocks_.begin(), blocks_.end(),
        [&](const Block& b) { return b.type == type && start_in(b) + needs.size <= b.size; });
    if (block == blocks_.end()) {
        // Each block is as large as all before it: a small world takes little, a large one few blocks.
        constexpr vk::DeviceSize smallest = 1 << 20, largest = 256 << 20;
        vk::DeviceSize size = smallest;
        for (const Block& b : blocks_)
            size = std::min(size + b.size, largest);
        size = std::max(size, needs.size);
        blocks_.push_back({device.device.allocateMemory({size, type}), type, size, 0});
        name_object(device, blocks_.back().memory, "world: memory of textures");
        block = std::prev(blocks_.end());
    }
    const vk::DeviceSize offset = start_in(*block);
    block->used = offset + needs.size;
    return {*block->memory, offset};
}

} // namespace starbow
