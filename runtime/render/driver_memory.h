#pragma once
#include <cstddef>
#include <vulkan/vulkan.hpp>

namespace starbow {

/// The host memory of a driver's objects, counted by the callbacks of Vulkan's allocation interface (chapter "Host Memory"
/// of the specification). Equal counts before and after mean that no Vulkan object is left over.
struct DriverMemory {
    std::size_t pieces = 0, bytes = 0;
};

/// Callbacks for an instance and a device; all that is made from these two is counted, too.
const vk::AllocationCallbacks& counting_callbacks();
/// The memory that is held now, of all instances and devices with those callbacks.
DriverMemory driver_memory();

} // namespace starbow
