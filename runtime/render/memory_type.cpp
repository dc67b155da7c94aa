#include "memory_type.h"
#include <array>

namespace starbow {

std::optional<std::uint32_t> memory_type(
    const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed, MemoryUse use, vk::DeviceSize size)
{
    using Flag = vk::MemoryPropertyFlagBits;
    constexpr vk::MemoryPropertyFlags mapped = Flag::eHostVisible | Flag::eHostCoherent;
    const auto first_with = [&](vk::MemoryPropertyFlags wanted, vk::DeviceSize heap) -> std::optional<std::uint32_t> {
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            const vk::MemoryType& type = memory.memoryTypes[i];
            if ((allowed >> i & 1) && (type.propertyFlags & wanted) == wanted
                && memory.memoryHeaps[type.heapIndex].size >= heap)
                return i;
        }
        return {};
    };
    switch (use) {
    case MemoryUse::device:
        return first_with(Flag::eDeviceLocal, 0);
    case MemoryUse::written:
        if (const auto own = first_with(mapped | Flag::eDeviceLocal, 16 * size))
            return own;
        break;
    case MemoryUse::read:
        if (const auto cached = first_with(mapped | Flag::eHostCached, 0))
            return cached;
        break;
    case MemoryUse::staged:
        break;
    }
    return first_with(mapped, 0);
}

} // namespace starbow
