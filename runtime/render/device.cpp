#include "device.h"
#include "config/json/error.h"
#include "config/json/hash.h"
#include "config/json/kept_file.h"
#include "debug.h"
#include "displays/compile/compiled_view.h"
#include "driver_memory.h"
#include "runtime/operation/log.h"
#include "runtime/operation/messages.h"
#include "runtime/operation/waits.h"
#include "shaders/shared_structs.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>

VULKAN_HPP_DEFAULT_DISPATCH_LOADER_DYNAMIC_STORAGE

namespace starbow {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
    const VkDebugUtilsMessengerCallbackDataEXT* data, void* complaints)
{
    // The shader of surfaces writes all coefficients that a scene may have. Vulkan discards those without an attachment, of
    // which newer layers warn.
    const std::string message = data->pMessage;
    if (message.find("this write is unused") != message.npos)
        return VK_FALSE;
    static_cast<std::vector<std::string>*>(complaints)->push_back(message);
    send_message(STDERR_FILENO, "validation: " + message + "\n");
    return VK_FALSE;
}

vk::Optional<const vk::AllocationCallbacks> allocator_of(const Device::Options& options)
{
    if (options.counted)
        return counting_callbacks();
    return nullptr;
}

vk::raii::Instance make_instance(Device& device, const Device::Options& options)
{
    if (device.context.enumerateInstanceVersion() < VK_API_VERSION_1_3)
        throw InputError("The Vulkan loader is older than 1.3: install Debian 12's libvulkan1");
    std::vector<const char*> extensions, layers;
    if (options.windows) {
        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        if (!names)
            throw InputError(
                "No Vulkan window can be opened here: install mesa-vulkan-drivers or the GPU maker's Vulkan driver");
        extensions.assign(names, names + count);
    }
    // The C structure, because newer headers give the function's pointer another type.
    vk::DebugUtilsMessengerCreateInfoEXT messenger(VkDebugUtilsMessengerCreateInfoEXT{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = on_validation_message,
        .pUserData = &device.complaints,
    });
    vk::ValidationFeatureEnableEXT synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    vk::ValidationFeaturesEXT features(1, &synchronization, 0, nullptr, &messenger);
    for (const vk::ExtensionProperties& offered : device.context.enumerateInstanceExtensionProperties()) {
        const std::string_view name(offered.extensionName);
        device.debug_utils |= name == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
        // By it a surface says whether it can take part in a barrier.
        if (options.windows && options.barrier && name == VK_KHR_GET_SURFACE_CAPABILITIES_2_EXTENSION_NAME) {
            device.present_barrier = true;
            extensions.push_back(VK_KHR_GET_SURFACE_CAPABILITIES_2_EXTENSION_NAME);
        }
    }
    device.debug_utils |= options.validation; // the layer brings it
    if (device.debug_utils)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (options.validation) {
        layers.push_back("VK_LAYER_KHRONOS_validation");
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    vk::ApplicationInfo application("Starbow", 1, nullptr, 0, VK_API_VERSION_1_3);
    vk::InstanceCreateInfo info({}, &application, layers, extensions);
    if (options.validation)
        info.pNext = &features;
    try {
        vk::raii::Instance instance(device.context, info, allocator_of(options));
        if (options.validation)
            device.messenger = instance.createDebugUtilsMessengerEXT(messenger);
        return instance;
    } catch (const vk::LayerNotPresentError&) {
        throw InputError("The Vulkan validation layers are not installed: install vulkan-validationlayers");
    } catch (const vk::SystemError& error) {
        throw InputError(std::string("Vulkan does not start (") + error.what()
            + "): install mesa-vulkan-drivers or the GPU maker's Vulkan driver");
    }
}

bool offers(const vk::raii::PhysicalDevice& physical, std::string_view extension)
{
    return std::ranges::any_of(physical.enumerateDeviceExtensionProperties(),
        [&](const vk::ExtensionProperties& offered) { return std::string_view(offered.extensionName) == extension; });
}

/// The first missing feature of a device, for a message; empty if the device will do.
std::string lacks(const vk::raii::PhysicalDevice& physical, bool windows)
{
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_3)
        return "Vulkan 1.3";
    if (!physical.getFeatures().largePoints || physical.getProperties().limits.pointSizeRange[1] < 2 * STAR_REACH)
        return "the feature largePoints, with points of 192 pixels";
    if (!physical.getFeatures().multiDrawIndirect || !physical.getFeatures().drawIndirectFirstInstance)
        return "the features multiDrawIndirect and drawIndirectFirstInstance";
    if (physical.getProperties().limits.maxUniformBufferRange < 65536)
        return "64 KiB of constants at once (maxUniformBufferRange)";
    if (physical.getProperties().limits.maxTexelBufferElements < sizeof(shared::TileTable) / sizeof(glm::vec4))
        return "texel buffers of 7 MiB (maxTexelBufferElements)";
    const auto all = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
        vk::PhysicalDeviceVulkan13Features>();
    if (!all.get<vk::PhysicalDeviceVulkan11Features>().shaderDrawParameters)
        return "the feature shaderDrawParameters";
    if (!all.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering)
        return "the feature dynamicRendering";
    if (!all.get<vk::PhysicalDeviceVulkan13Features>().synchronization2)
        return "the feature synchronization2";
    if (windows && !offers(physical, VK_KHR_SWAPCHAIN_EXTENSION_NAME))
        return "windows (VK_KHR_swapchain)";
    auto families = physical.getQueueFamilyProperties();
    if (std::none_of(
            families.begin(), families.end(), [](auto& f) { return bool(f.queueFlags & vk::QueueFlagBits::eGraphics); }))
        return "graphics";
    return {};
}

const char* kind_of(vk::PhysicalDeviceType type)
{
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return "a card of its own";
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return "part of the processor";
    case vk::PhysicalDeviceType::eVirtualGpu:
        return "virtual";
    case vk::PhysicalDeviceType::eCpu:
        return "software";
    default:
        return "of no known kind";
    }
}

/// True if the device can let screens of several machines change together (VK_NV_present_barrier).
bool has_present_barrier(const vk::raii::PhysicalDevice& physical)
{
    return offers(physical, VK_NV_PRESENT_BARRIER_EXTENSION_NAME)
        && physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDevicePresentBarrierFeaturesNV>()
               .get<vk::PhysicalDevicePresentBarrierFeaturesNV>()
               .presentBarrier;
}

/// True if the device reports when a picture is on its screen (VK_KHR_present_wait).
bool has_present_wait(const vk::raii::PhysicalDevice& physical)
{
    if (!offers(physical, VK_KHR_PRESENT_ID_EXTENSION_NAME) || !offers(physical, VK_KHR_PRESENT_WAIT_EXTENSION_NAME))
        return false;
    const auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDevicePresentIdFeaturesKHR,
        vk::PhysicalDevicePresentWaitFeaturesKHR>();
    return features.get<vk::PhysicalDevicePresentIdFeaturesKHR>().presentId
        && features.get<vk::PhysicalDevicePresentWaitFeaturesKHR>().presentWait;
}

int rank(vk::PhysicalDeviceType type)
{
    switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
        return 4;
    case vk::PhysicalDeviceType::eIntegratedGpu:
        return 3;
    case vk::PhysicalDeviceType::eVirtualGpu:
        return 2;
    case vk::PhysicalDeviceType::eCpu:
        return 1;
    default:
        return 0;
    }
}

std::vector<vk::raii::PhysicalDevice> all_of(const vk::raii::Instance& instance)
{
    std::vector<vk::raii::PhysicalDevice> all;
    try {
        for (auto& physical : vk::raii::PhysicalDevices(instance))
            all.push_back(std::move(physical));
    } catch (const vk::SystemError&) { // no driver at all is an error to some loaders
    }
    return all;
}

/// The reason for not taking a device; empty if it may be taken.
std::string refusal(const vk::raii::PhysicalDevice& physical, const Device::Options& options)
{
    const std::string name(physical.getProperties().deviceName.data());
    if (name.find(options.name) == std::string::npos)
        return "is not called '" + options.name + "'";
    const std::string missing = lacks(physical, options.windows);
    return missing.empty() ? "" : "lacks " + missing;
}

/// The fastest kind of those that are not refused, or nothing.
std::optional<std::size_t> best_of(const std::vector<vk::raii::PhysicalDevice>& all, const Device::Options& options)
{
    std::optional<std::size_t> best;
    int best_rank = -1;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const int its_rank = rank(all[i].getProperties().deviceType);
        if (its_rank > best_rank && refusal(all[i], options).empty())
            best = i, best_rank = its_rank;
    }
    return best;
}

/// For a device with VK_EXT_memory_budget.
MemoryBudget budget_of(const vk::raii::PhysicalDevice& physical)
{
    const auto all
        = physical.getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2, vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    const vk::PhysicalDeviceMemoryProperties& memory = all.get<vk::PhysicalDeviceMemoryProperties2>().memoryProperties;
    const auto& reported = all.get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    MemoryBudget budget;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
            budget.used_bytes += reported.heapUsage[i], budget.most_bytes += reported.heapBudget[i];
            budget.exceeded |= reported.heapUsage[i] > reported.heapBudget[i];
        }
    return budget;
}

GpuListing describe(const vk::raii::PhysicalDevice& physical)
{
    const vk::PhysicalDeviceProperties properties = physical.getProperties();
    const std::uint32_t api = properties.apiVersion;
    GpuListing gpu;
    gpu.name = properties.deviceName.data();
    gpu.kind = kind_of(properties.deviceType);
    gpu.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
    const std::string major_minor
        = std::to_string(VK_API_VERSION_MAJOR(api)) + "." + std::to_string(VK_API_VERSION_MINOR(api));
    gpu.api_version = major_minor + "." + std::to_string(VK_API_VERSION_PATCH(api));
    gpu.driver = "Vulkan " + major_minor;
    if (api >= VK_API_VERSION_1_2) {
        const auto own = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                             .get<vk::PhysicalDeviceDriverProperties>();
        gpu.driver_name = own.driverName.data();
        gpu.driver_version = own.driverInfo.data();
        gpu.driver = gpu.driver_name + " " + gpu.driver_version + ", " + gpu.driver;
    }
    gpu.largest_image_px = properties.limits.maxImageDimension2D;
    gpu.most_samplers = properties.limits.maxSamplerAllocationCount;
    gpu.most_allocations = properties.limits.maxMemoryAllocationCount;
    for (const vk::QueueFamilyProperties& family : physical.getQueueFamilyProperties())
        if (family.queueFlags & vk::QueueFlagBits::eGraphics) { // Device takes the first one too
            gpu.timestamp_ns = family.timestampValidBits > 0 ? properties.limits.timestampPeriod : 0;
            break;
        }
    const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            gpu.memory_bytes += memory.memoryHeaps[i].size;
    if (offers(physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME))
        gpu.budget = budget_of(physical);
    return gpu;
}

vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance, const Device::Options& options)
{
    std::vector<vk::raii::PhysicalDevice> all = all_of(instance);
    if (const auto best = best_of(all, options))
        return std::move(all[*best]);
    std::string refused;
    for (const auto& physical : all)
        refused += "; " + std::string(physical.getProperties().deviceName.data()) + " " + refusal(physical, options);
    throw InputError("No usable Vulkan device" + refused
        + ": install mesa-vulkan-drivers (software) or the GPU maker's Vulkan 1.3 driver");
}

constexpr const char* pipelines_kind = "pipes2";

std::uint64_t pipelines_key(const vk::PhysicalDeviceProperties& properties)
{
    ContentHash hash;
    hash.add(properties.pipelineCacheUUID.data(), properties.pipelineCacheUUID.size());
    return hash.value();
}

/// The file of a device's compiled pipelines, named by the driver's pipeline cache UUID; empty without a cache folder.
std::filesystem::path pipeline_file(const vk::PhysicalDeviceProperties& properties)
{
    const std::filesystem::path folder = map_cache_folder();
    std::string mark;
    for (std::uint8_t byte : properties.pipelineCacheUUID) {
        std::array<char, 3> hex;
        std::snprintf(hex.data(), hex.size(), "%02x", byte);
        mark += hex.data();
    }
    return folder.empty() ? folder : folder / ("pipelines-" + mark + ".bin");
}

} // namespace

std::vector<std::uint8_t> kept_pipelines(const vk::PhysicalDeviceProperties& properties)
{
    KeptFile file(pipeline_file(properties), pipelines_kind, pipelines_key(properties));
    std::vector<std::uint8_t> kept(file.size(0));
    if (!file.read({bytes_of(kept)}))
        kept.clear();
    return kept;
}

Device::Device(const Options& options)
{
    instance = make_instance(*this, options);
    physical = choose(instance, options);
    properties = physical.getProperties();
    memory = physical.getMemoryProperties();
    reports_budget = offers(physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    auto families = physical.getQueueFamilyProperties();
    for (family = 0; !(families[family].queueFlags & vk::QueueFlagBits::eGraphics);)
        ++family;

    vk::PhysicalDeviceVulkan13Features features13;
    features13.dynamicRendering = features13.synchronization2 = true;
    vk::PhysicalDeviceFeatures features;
    features.largePoints = true; // a star's spot
    features.multiDrawIndirect = features.drawIndirectFirstInstance = true;
    features.pipelineStatisticsQuery = options.invocations;
    if (options.invocations && !physical.getFeatures().pipelineStatisticsQuery)
        throw InputError(
            std::string(name()) + " does not count how often shaders run; a device with pipelineStatisticsQuery is right");
    vk::PhysicalDeviceVulkan11Features features11;
    features11.shaderDrawParameters = true, features11.pNext = &features13; // the draw's number in an indirect one
    features.wideLines = physical.getFeatures().wideLines;
    widest_line = features.wideLines ? properties.limits.lineWidthRange[1] : 1;
    features.samplerAnisotropy = physical.getFeatures().samplerAnisotropy;
    features.textureCompressionBC = physical.getFeatures().textureCompressionBC;
    draws_as_gpu = !on_processor() || options.as_gpu;
    compresses = features.textureCompressionBC && !on_processor();
    float priority = 1;
    vk::DeviceQueueCreateInfo queue_info({}, family, 1, &priority);
    std::vector<const char*> extensions;
    if (options.windows)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    vk::PhysicalDevicePresentIdFeaturesKHR present_id(true);
    vk::PhysicalDevicePresentWaitFeaturesKHR present_wait(true, &present_id);
    if (options.windows && has_present_wait(physical)) {
        reports_presentation = true;
        extensions.push_back(VK_KHR_PRESENT_ID_EXTENSION_NAME);
        extensions.push_back(VK_KHR_PRESENT_WAIT_EXTENSION_NAME);
        features13.pNext = &present_wait;
    }
    vk::PhysicalDevicePresentBarrierFeaturesNV barrier(true, features13.pNext);
    present_barrier = present_barrier && has_present_barrier(physical);
    if (present_barrier) {
        extensions.push_back(VK_NV_PRESENT_BARRIER_EXTENSION_NAME);
        features13.pNext = &barrier;
    }
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables(true, features13.pNext);
    statistics = options.statistics;
    if (statistics) {
        if (!offers(physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME))
            throw InputError(std::string(name()) + " does not say what shaders cost; a driver with "
                + VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME + " is right");
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        features13.pNext = &executables;
    }
    device = physical.createDevice({{}, queue_info, {}, extensions, &features, &features11}, allocator_of(options));
    // The loader's functions, which serve every device.
    VULKAN_HPP_DEFAULT_DISPATCHER.init(*instance, context.getDispatcher()->vkGetInstanceProcAddr);
    queue = device.getQueue(family, 0);
    pool = device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family});
    const std::vector<std::uint8_t> kept = kept_pipelines(properties);
    cache = device.createPipelineCache({{}, kept.size(), kept.data()});
    if (on_processor())
        keeper = std::make_unique<LavapipeFenceGuard>(device);
    name_object(*this, queue, "queue");
    name_object(*this, pool, "command pool");
    name_object(*this, cache, "pipeline cache");
}

std::optional<MemoryBudget> Device::memory_budget() const
{
    return reports_budget ? std::optional(budget_of(physical)) : std::nullopt;
}

void Device::begin_rendering(vk::CommandBuffer commands, const vk::RenderingInfo& info, std::uint32_t scenes) const
{
    if (keeper)
        keeper->begin(commands, scenes);
    commands.beginRendering(info);
    if (keeper)
        keeper->hold(commands);
}

void Device::end_rendering(vk::CommandBuffer commands) const
{
    if (keeper)
        keeper->hold(commands);
    commands.endRendering();
}

void Device::save_pipelines() const
{
    try {
        const std::filesystem::path file = pipeline_file(properties);
        if (file.empty())
            return;
        const std::vector<std::uint8_t> data = cache.getData(); // a lost device may refuse
        write_kept(file, pipelines_kind, pipelines_key(properties), {bytes_of(data)});
    } catch (const std::bad_alloc&) { // no message either
    } catch (const std::exception& failed) {
        write_log(LogKind::pipelines_unsaved, failed.what());
    }
}

std::vector<GpuListing> list_gpus(const Device::Options& options)
{
    const vk::raii::Context context;
    const vk::ApplicationInfo application("Starbow", 1, nullptr, 0, VK_API_VERSION_1_3);
    std::vector<GpuListing> list;
    try {
        const vk::raii::Instance instance(context, vk::InstanceCreateInfo({}, &application));
        const auto all = all_of(instance);
        const auto best = best_of(all, options);
        for (std::size_t i = 0; i < all.size(); ++i) {
            list.push_back(describe(all[i]));
            list.back().refusal = refusal(all[i], options);
            list.back().chosen = best == i;
        }
    } catch (const vk::SystemError&) { // no driver at all
    }
    return list;
}

vk::raii::CommandBuffer Device::begin()
{
    vk::raii::CommandBuffer commands
        = std::move(device.allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    name_object(*this, commands, "a moment's commands");
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return commands;
}

void Device::finish(vk::raii::CommandBuffer& commands)
{
    commands.end();
    vk::raii::Fence fence = device.createFence({});
    name_object(*this, fence, "fence of a moment's commands");
    vk::CommandBufferSubmitInfo buffer(*commands);
    queue.submit2(vk::SubmitInfo2({}, {}, buffer, {}), *fence);
    await(*fence, "the end of a moment's commands (fence)");
}

void Device::settle() const noexcept
{
    const LimitedWait idling("the device's rest (vkDeviceWaitIdle)");
    try {
        device.waitIdle();
    } catch (const vk::SystemError&) { // a lost device is idle
    }
}

void Device::await(vk::Fence fence, const char* what) const
{
    // Short waits in turn: time in which a stopped program did not run is not counted.
    constexpr double turn_s = 0.1;
    const LimitedWait wait(what);
    try {
        for (double waited_s = 0; device.waitForFences(fence, true, std::uint64_t(1e9 * turn_s)) == vk::Result::eTimeout;)
            if ((waited_s += turn_s) > wait.limit_s())
                give_up(what, waited_s);
    } catch (const vk::SystemError&) { // the driver may still work with what the caller destroys now
        settle();
        throw;
    }
}

} // namespace starbow
