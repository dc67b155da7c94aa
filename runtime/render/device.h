#pragma once
#include "lavapipe_fence_guard.h"
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace starbow {

class FrameTimer;
class Trace;

/// The memory of a device's own heaps that this process uses, and the most that it can use now without slow pictures,
/// because other programs use the device, too.
struct MemoryBudget {
    std::uint64_t used_bytes = 0, most_bytes = 0;
    bool exceeded = false; ///< in one of the heaps at least
};

/// The Vulkan instance, one device and its one queue. All other Vulkan objects are made from it.
class Device {
public:
    struct Options {
        bool windows = false; ///< for windows: enables swapchains and the instance extensions that GLFW names
        bool validation = false; ///< the validation layers, synchronization included; see complaints()
        bool barrier = false; ///< VK_NV_present_barrier, where the GPU has it: screens of several machines change together
        bool statistics = false; ///< VK_KHR_pipeline_executable_properties: a pipeline says what its shaders cost
        bool invocations = false; ///< InvocationCounter counts how often shaders run
        bool counted = false; ///< driver_memory() counts the host memory of all objects
        bool as_gpu = false; ///< draws_as_gpu even where the processor draws
        std::string name; ///< part of a GPU's name; empty: the GPU of the fastest kind
    };

    /// Throws InputError where Vulkan, a device or a needed feature is missing; the message names the package to install.
    explicit Device(const Options& options);

    vk::raii::Context context;
    std::vector<std::string> complaints; ///< messages of the validation layers so far
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
    bool reports_presentation = false; ///< VK_KHR_present_wait
    bool present_barrier = false; ///< VK_NV_present_barrier; a surface may lack it nevertheless
    float widest_line = 1; ///< pixels
    bool compresses = false; ///< large textures are compressed; false where the processor would decode them at each look-up
    bool draws_as_gpu = false; ///< by the forms of shaders that are faster on a GPU, and slower where the processor draws
    bool statistics = false; ///< pipelines are made with the figures of their shaders
    bool reports_budget = false; ///< VK_EXT_memory_budget; see memory_budget()
    bool debug_utils = false; ///< VK_EXT_debug_utils: objects have names, passes have labels
    Trace* trace = nullptr; ///< receives the processor's spans of each frame during a trace
    std::unique_ptr<LavapipeFenceGuard> keeper; ///< null but on lavapipe
    FrameTimer* timer = nullptr; ///< measures each pass on the device during a trace

    /// Writes the compiled pipelines into the cache folder for the next start. Failures are ignored, with a lost device
    /// or a read-only folder: the next start then only takes longer.
    void save_pipelines() const;

    const char* name() const { return properties.deviceName.data(); }
    bool on_processor() const { return properties.deviceType == vk::PhysicalDeviceType::eCpu; }

    /// These two enclose the draws of each rendering. scenes: as LavapipeFenceGuard's, where the keeper holds more than the
    /// two of its begin and end.
    void begin_rendering(vk::CommandBuffer commands, const vk::RenderingInfo& info, std::uint32_t scenes = 2) const;
    void end_rendering(vk::CommandBuffer commands) const;
    /// Waits for a fence. what: names the wait. Where the fence does not come within LimitedWait's limit, the process ends.
    void await(vk::Fence fence, const char* what) const;
    /// Nothing where the device does not report it.
    std::optional<MemoryBudget> memory_budget() const;
    /// Waits until the device does nothing. Before that, or its loss, no object in use may be destroyed.
    void settle() const noexcept;

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

/// The compiled pipelines that save_pipelines of an earlier start has kept for this device, to the byte; empty where the
/// file is missing or damaged, because a driver may check no more than the header.
std::vector<std::uint8_t> kept_pipelines(const vk::PhysicalDeviceProperties& properties);

/// One GPU's line in a listing.
struct GpuListing {
    std::string name, driver, kind;
    std::string refusal; ///< the reason why it can't be used, or empty
    bool chosen = false;
    bool software = false; ///< runs on the processor
    std::string driver_name, driver_version, api_version; ///< as the driver reports them; "1.3.230"
    std::uint32_t largest_image_px = 0; ///< side of a 2D image
    std::uint32_t most_samplers = 0, most_allocations = 0; ///< limits of objects at one time
    double timestamp_ns = 0; ///< one tick of the queue's clock; 0: the queue has no clock
    std::uint64_t memory_bytes = 0; ///< size of the device's own heaps
    std::optional<MemoryBudget> budget;
};
/// Every GPU that Vulkan reports; empty where Vulkan is missing.
std::vector<GpuListing> list_gpus(const Device::Options& options);

} // namespace starbow
