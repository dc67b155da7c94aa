#include "device.h"
#include "config/error.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <cstdlib>

namespace starbow {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL complain(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
    const VkDebugUtilsMessengerCallbackDataEXT* data, void* complaints)
{
    static_cast<std::vector<std::string>*>(complaints)->push_back(data->pMessage);
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
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
    vk::DebugUtilsMessengerCreateInfoEXT messenger({},
        vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning | vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
        vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation | vk::DebugUtilsMessageTypeFlagBitsEXT::ePerformance, complain,
        &device.complaints);
    vk::ValidationFeatureEnableEXT synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    vk::ValidationFeaturesEXT features(1, &synchronization, 0, nullptr, &messenger);
    if (options.validation) {
        layers.push_back("VK_LAYER_KHRONOS_validation");
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    vk::ApplicationInfo application("Starbow", 1, nullptr, 0, VK_API_VERSION_1_3);
    vk::InstanceCreateInfo info({}, &application, layers, extensions);
    if (options.validation)
        info.pNext = &features;
    try {
        vk::raii::Instance instance(device.context, info);
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

/// What the device lacks, in words; empty if it will do.
std::string lacks(const vk::raii::PhysicalDevice& physical, bool windows)
{
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_3)
        return "Vulkan 1.3";
    auto features = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>()
                        .get<vk::PhysicalDeviceVulkan13Features>();
    if (!features.dynamicRendering)
        return "the feature dynamicRendering";
    if (!features.synchronization2)
        return "the feature synchronization2";
    auto extensions = physical.enumerateDeviceExtensionProperties();
    if (windows && std::none_of(extensions.begin(), extensions.end(), [](const vk::ExtensionProperties& extension) {
            return std::string_view(extension.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
        }))
        return "windows (VK_KHR_swapchain)";
    auto families = physical.getQueueFamilyProperties();
    if (std::none_of(
            families.begin(), families.end(), [](auto& f) { return bool(f.queueFlags & vk::QueueFlagBits::eGraphics); }))
        return "graphics";
    return {};
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

vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance, const Device::Options& options)
{
    std::vector<vk::raii::PhysicalDevice> all;
    try {
        for (auto& physical : vk::raii::PhysicalDevices(instance))
            all.push_back(std::move(physical));
    } catch (const vk::SystemError&) { // no driver at all is an error to some loaders
    }
    std::string refused;
    int best = -1, best_rank = -1;
    for (std::size_t i = 0; i < all.size(); ++i) {
        vk::PhysicalDeviceProperties properties = all[i].getProperties();
        std::string name(properties.deviceName.data());
        if (name.find(options.name) == std::string::npos) {
            refused += "; " + name + " is not called '" + options.name + "'";
            continue;
        }
        if (std::string missing = lacks(all[i], options.windows); !missing.empty()) {
            refused += "; " + name + " lacks " + missing;
            continue;
        }
        if (rank(properties.deviceType) > best_rank)
            best = int(i), best_rank = rank(properties.deviceType);
    }
    if (best < 0)
        throw InputError("No usable Vulkan device" + refused
            + ": install mesa-vulkan-drivers (software) or the GPU maker's Vulkan 1.3 driver");
    return std::move(all[best]);
}

} // namespace

Device::Device(const Options& options)
{
    instance = make_instance(*this, options);
    physical = choose(instance, options);
    properties = physical.getProperties();
    memory = physical.getMemoryProperties();
    auto families = physical.getQueueFamilyProperties();
    for (family = 0; !(families[family].queueFlags & vk::QueueFlagBits::eGraphics);)
        ++family;

    vk::PhysicalDeviceVulkan13Features features13;
    features13.dynamicRendering = features13.synchronization2 = true;
    vk::PhysicalDeviceFeatures features;
    features.samplerAnisotropy = physical.getFeatures().samplerAnisotropy;
    float priority = 1;
    vk::DeviceQueueCreateInfo queue_info({}, family, 1, &priority);
    std::vector<const char*> extensions;
    if (options.windows)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    device = physical.createDevice({{}, queue_info, {}, extensions, &features, &features13});
    queue = device.getQueue(family, 0);
    pool = device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family});
    cache = device.createPipelineCache({});
}

vk::raii::CommandBuffer Device::begin()
{
    vk::raii::CommandBuffer commands
        = std::move(device.allocateCommandBuffers({*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return commands;
}

void Device::finish(vk::raii::CommandBuffer& commands)
{
    commands.end();
    vk::raii::Fence fence = device.createFence({});
    vk::CommandBufferSubmitInfo buffer(*commands);
    queue.submit2(vk::SubmitInfo2({}, {}, buffer, {}), *fence);
    (void)device.waitForFences(*fence, true, UINT64_MAX);
}

} // namespace starbow
