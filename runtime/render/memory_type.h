#pragma once
#include <cstdint>
#include <optional>
#include <vulkan/vulkan.hpp>

namespace starbow {

/// The uses of memory that differ in the best kind of it.
enum class MemoryUse {
    device, ///< the device alone reads and writes it
    written, ///< the processor writes it, and the device reads it in every frame
    staged, ///< the processor writes it, and the device copies it once
    read ///< the device writes it, and the processor reads it
};

/// The index of the best type of memory for `size` bytes; nothing where the device has none that would do. allowed: a bit
/// for each type. What is written lies in the device's own memory where the processor reaches that: a shader that reads the
/// processor's memory waits a microsecond or two for the bus. Some cards show the processor a window of 256 MiB alone, which
/// all programs share: at most a sixteenth of it is taken for one buffer. What is read lies in the processor's cache:
/// without, it reads some 100 MB a second.
std::optional<std::uint32_t> memory_type(
    const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t allowed, MemoryUse use, vk::DeviceSize size);

} // namespace starbow
