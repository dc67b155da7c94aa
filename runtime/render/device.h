#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace starbow {

class FrameTimer;
class Trace;

/// The instance, one device and its one queue. Everything else of Vulkan hangs below it.
class Device {
public:
    struct Options {
        bool windows = false; ///< ask GLFW which instance extensions its windows need, and for swapchains
        bool validation = false; ///< the validation layers, synchronization included; see complaints()
        std::string name; ///< part of a GPU's name, empty: the fastest kind there is
    };

    /// Throws InputError where there is no Vulkan, no device, or none with what is needed: says what to install.
    explicit Device(const Options& options);

    vk::raii::Context context;
    std::vector<std::string> complaints; ///< what the validation layers said so far
    vk::raii::Instance instance = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physical = nullptr;
    vk::raii::Device device = nullptr;
    std::uint32_t family = 0;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool pool = nullptr;
    vk::raii::PipelineCache cache = nullptr;
    vk::PhysicalDeviceProperties properties;
    vk::PhysicalDeviceMemoryProperties memory;
    bool tells_when_shown = false; ///< VK_KHR_present_wait
    bool debug_utils = false; ///< VK_EXT_debug_utils: objects have names, passes have labels
    Trace* trace = nullptr; ///< gets the processor's spans of each frame, while somebody traces
    FrameTimer* timer = nullptr; ///< measures each pass on the device, while somebody traces

    /// Keeps the compiled pipelines for the next start. A lost device, or a folder that can't be written, only costs time
    /// then.
    void save_pipelines() const;

    const char* name() const { return properties.deviceName.data(); }
    bool on_processor() const { return properties.deviceType == vk::PhysicalDeviceType::eCpu; }

    /// Records, submits and waits: for loading, measuring and stills.
    template <class Record> void now(Record&& record)
    {
        vk::raii::CommandBuffer commands = begin();
        record(*commands);
        finish(commands);
    }

private:
    vk::raii::CommandBuffer begin();
    void finish(vk::raii::CommandBuffer& commands);
};

/// A GPU as people are told of it.
struct GpuListing {
    std::string name, driver, kind;
    std::string refusal; ///< why it can't be used, or empty
    bool chosen = false;
    bool software = false; ///< runs on the processor
    std::string driver_name, driver_version, api_version; ///< of the driver's own words; "1.3.230"
    std::uint32_t largest_image_px = 0; ///< side of a 2D image
    std::uint32_t most_samplers = 0, most_allocations = 0; ///< at one time
    double timestamp_ns = 0; ///< one tick of the queue's clock; 0: the queue has no clock
    std::uint64_t memory_bytes = 0; ///< of the device's own heaps
};
/// All that Vulkan knows; none where it knows none.
std::vector<GpuListing> list_gpus(const Device::Options& options);

} // namespace starbow
