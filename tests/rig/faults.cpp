// A Vulkan layer for tests: it makes chosen calls fail as drivers do. They go on failing until the program makes the failed
// object anew.
//
// STARBOW_FAULTS=CALL[@WHEN]:NTH:RESULT[,...]
//   CALL    acquire, present (both counted for each picture), swapchain (its creation), submit, fence (a wait for fences
//           after the first presentation), idle (a wait for the device), resize (an allocation of memory after a
//           swapchain has replaced another), or a function of the lists below by its own name: vkCreateBuffer
//   WHEN    calls count only once so many pictures are presented, or, with `lost`, once a device is lost
//   NTH     the call that fails first, counted from 1
//   RESULT  OUT_OF_DATE   the swapchain fails until it is made anew
//           SURFACE_LOST  the surface fails until it is made anew
//           DEVICE_LOST   the device fails until it is made anew
//           SUBOPTIMAL    only this call returns it; it succeeds
//           OUT_OF_MEMORY only this call returns it; submit and resize alone
//           FROZEN        the swapchain's next 100 acquires time out
//           HANG          this and all later calls of its kind time out; fence and acquire alone
//           BLOCK         this call never returns; fence, present and idle alone
//           A function by its own name fails once, with any error of Vulkan called without its VK_ERROR_. DEVICE_LOST
//           lasts there, too.
// When a swapchain is destroyed, the layer prints on stderr how many pictures it has shown.
// STARBOW_LARGEST_KIB=N: a piece of memory of more than N KiB has no room on the device.
// STARBOW_BUDGET_KIB=N: the layer provides VK_EXT_memory_budget. The first heap's budget is N KiB, and all memory is in it.
// STARBOW_COUNT_CALLS=1: at the end the layer prints on stderr how often each function of the lists was called before and
// after the first presentation.
// STARBOW_SHOWN_LATE_MS=MS: the layer provides VK_KHR_present_wait. Each swapchain shows its pictures MS later than the
// swapchain made before it. When the device is destroyed, the layer prints the times between a frame's first and last
// report of a picture, without the least and the greatest three tenths: `fault: reported MS to MS ms apart`.
// STARBOW_BARRIER=SURFACES: the layer provides VK_NV_present_barrier. SURFACES is `all`, or `none` where no surface can take
// part. For each swapchain that takes part it prints `fault: in the barrier` on stderr.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <vector>
#define VK_USE_PLATFORM_XCB_KHR
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace {

std::mutex mutex; // guards everything below
std::map<void*, PFN_vkGetInstanceProcAddr> instances;
std::map<void*, PFN_vkGetDeviceProcAddr> devices;
std::map<void*, VkDevice> handles;
VkInstance last_instance;
// These belong to the last instance. The layer looks them up while the instance is made: later the loader would return this
// layer's own functions.
PFN_vkEnumerateDeviceExtensionProperties next_enumerate;
PFN_vkGetPhysicalDeviceFeatures2 next_features;
PFN_vkGetPhysicalDeviceMemoryProperties2 next_memory;
PFN_vkDestroySurfaceKHR next_destroy_surface;
PFN_vkGetPhysicalDeviceSurfaceCapabilities2KHR next_capabilities;
std::map<VkDeviceMemory, VkDeviceSize> allocated; // bytes
int presented = 0, losses = 0; // pictures; devices
std::map<std::string, std::pair<int, int>> calls; // before and after the first presentation
std::map<VkSwapchainKHR, VkSurfaceKHR> surfaces;
std::map<VkSwapchainKHR, int> order, frozen, shown;
using Clock = std::chrono::steady_clock;
std::map<uint64_t, std::pair<Clock::time_point, Clock::time_point>> reported; // by a frame's number: first and last report
std::set<VkSwapchainKHR> out_of_date;
std::set<VkSurfaceKHR> lost;
std::set<void*> lost_devices;
bool fences_hang = false, replaced = false; // replaced: a swapchain has taken another one's place

/// The loader's table pointer: the same for a device and its queues.
void* key(const void* handle) { return *static_cast<void* const*>(handle); }

template <class Function> Function next(const void* device_or_queue, const char* name)
{
    void* k = key(device_or_queue);
    return reinterpret_cast<Function>(devices[k](handles[k], name));
}
double late_ms()
{
    const char* text = std::getenv("STARBOW_SHOWN_LATE_MS");
    return text ? std::atof(text) : -1;
}

double budget_kib()
{
    const char* text = std::getenv("STARBOW_BUDGET_KIB");
    return text ? std::atof(text) : -1;
}

std::string_view barrier()
{
    const char* text = std::getenv("STARBOW_BARRIER");
    return text ? text : "";
}

/// The extensions that the layer provides, not the driver, with the structures of their features.
std::map<std::string_view, VkStructureType> provided()
{
    std::map<std::string_view, VkStructureType> all;
    if (late_ms() >= 0) {
        all[VK_KHR_PRESENT_ID_EXTENSION_NAME] = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_ID_FEATURES_KHR;
        all[VK_KHR_PRESENT_WAIT_EXTENSION_NAME] = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_WAIT_FEATURES_KHR;
    }
    if (budget_kib() >= 0) // it has no features
        all[VK_EXT_MEMORY_BUDGET_EXTENSION_NAME] = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
    if (!barrier().empty())
        all[VK_NV_PRESENT_BARRIER_EXTENSION_NAME] = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PRESENT_BARRIER_FEATURES_NV;
    return all;
}

/// Takes structures out of a chain that the driver must not see.
template <class Wrong> void leave_out(void* first, const Wrong& wrong)
{
    for (auto* before = static_cast<VkBaseOutStructure*>(first); before->pNext;)
        if (wrong(before->pNext->sType))
            before->pNext = before->pNext->pNext;
        else
            before = before->pNext;
}

struct Fault {
    std::string text, call, when, result;
    int left = 0; ///< calls until it happens
};

std::string cut(std::string& rest, char at)
{
    const std::string part = rest.substr(0, rest.find(at));
    rest.erase(0, part.size() + 1);
    return part;
}

std::vector<Fault> requested()
{
    const char* text = std::getenv("STARBOW_FAULTS");
    std::vector<Fault> all;
    for (std::string rest = text ? text : ""; !rest.empty();) {
        Fault one;
        one.text = cut(rest, ',');
        std::string parts = one.text;
        one.when = cut(parts, ':');
        one.call = cut(one.when, '@');
        one.left = std::stoi(cut(parts, ':'));
        one.result = parts;
        all.push_back(one);
    }
    return all;
}

/// Counts a call. Returns the fault that shall happen to it, or "".
std::string fault(const std::string& call)
{
    static std::vector<Fault>& faults = *new std::vector(requested());
    std::string result;
    for (Fault& one : faults) {
        const bool counts = one.when.empty() ? true : one.when == "lost" ? losses > 0 : presented >= std::stoi(one.when);
        if (one.call == call && counts && --one.left == 0) {
            std::fprintf(stderr, "fault: %s\n", one.text.c_str());
            result = one.result;
        }
    }
    return result;
}

void lose(void* device_key)
{
    ++losses;
    lost_devices.insert(device_key);
}

[[noreturn]] void block()
{
    for (;;)
        pause();
}

/// Applies the new fault `now`, and returns the swapchain's state with all earlier faults.
VkResult state(const void* device_or_queue, VkSwapchainKHR swapchain, const std::string& now)
{
    if (now == "DEVICE_LOST")
        lose(key(device_or_queue));
    if (now == "SURFACE_LOST")
        lost.insert(surfaces[swapchain]);
    if (now == "OUT_OF_DATE")
        out_of_date.insert(swapchain);
    if (now == "FROZEN" || now == "HANG")
        frozen[swapchain] = now == "HANG" ? 1'000'000 : 100;
    if (lost_devices.count(key(device_or_queue)))
        return VK_ERROR_DEVICE_LOST;
    if (lost.count(surfaces[swapchain]))
        return VK_ERROR_SURFACE_LOST_KHR;
    if (out_of_date.count(swapchain))
        return VK_ERROR_OUT_OF_DATE_KHR;
    return now == "SUBOPTIMAL" ? VK_SUBOPTIMAL_KHR : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL acquire(
    VkDevice device, VkSwapchainKHR swapchain, uint64_t timeout, VkSemaphore semaphore, VkFence fence, uint32_t* image)
{
    VkResult injected;
    bool waits = false;
    {
        const std::lock_guard lock(mutex);
        injected = state(device, swapchain, fault("acquire"));
        if (injected < 0)
            return injected;
        if (frozen[swapchain] > 0) {
            --frozen[swapchain];
            waits = true;
        }
    }
    if (waits) { // as long as the caller allows, which may be for ever
        std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(timeout, uint64_t(3600) * 1'000'000'000)));
        return timeout == 0 ? VK_NOT_READY : VK_TIMEOUT;
    }
    const VkResult result = next<PFN_vkAcquireNextImageKHR>(device, "vkAcquireNextImageKHR")(
        device, swapchain, timeout, semaphore, fence, image);
    return result == VK_SUCCESS ? injected : result;
}

VKAPI_ATTR VkResult VKAPI_CALL present(VkQueue queue, const VkPresentInfoKHR* info)
{
    static auto* const pictures = static_cast<std::atomic<int>*>(dlsym(RTLD_DEFAULT, "starbow_pictures")); // no_memory.cpp's
    std::vector<std::string> faults(info->swapchainCount);
    for (uint32_t i = 0; i < info->swapchainCount; ++i) {
        std::unique_lock lock(mutex);
        faults[i] = fault("present");
        if (++presented == 10)
            std::fprintf(stderr, "fault: 10 pictures\n");
        if (pictures)
            *pictures = presented;
        lock.unlock();
        if (faults[i] == "BLOCK")
            block();
    }
    VkPresentInfoKHR copy = *info;
    std::vector<VkResult> results(info->swapchainCount);
    copy.pResults = results.data();
    copy.pNext = nullptr;
    VkResult worst = next<PFN_vkQueuePresentKHR>(queue, "vkQueuePresentKHR")(queue, &copy);
    const std::lock_guard lock(mutex);
    for (uint32_t i = 0; i < info->swapchainCount; ++i) {
        const VkResult injected = state(queue, info->pSwapchains[i], faults[i]);
        if (results[i] == VK_SUCCESS)
            results[i] = injected;
        shown[info->pSwapchains[i]] += results[i] >= 0;
        if (results[i] < 0 || worst == VK_SUCCESS)
            worst = results[i];
        if (info->pResults)
            info->pResults[i] = results[i];
    }
    return worst;
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, uint32_t count, const VkSubmitInfo2* infos, VkFence fence)
{
    {
        const std::lock_guard lock(mutex);
        const std::string now = fault("submit");
        if (now == "OUT_OF_MEMORY")
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        if (now == "DEVICE_LOST")
            lose(key(queue));
        if (lost_devices.count(key(queue)))
            return VK_ERROR_DEVICE_LOST;
    }
    return next<PFN_vkQueueSubmit2>(queue, "vkQueueSubmit2")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_for_fences(
    VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all, uint64_t timeout)
{
    {
        std::unique_lock lock(mutex);
        const std::string now = presented > 0 ? fault("fence") : "";
        fences_hang |= now == "HANG";
        if (lost_devices.count(key(device)))
            return VK_ERROR_DEVICE_LOST;
        lock.unlock();
        if (now == "BLOCK")
            block();
    }
    if (fences_hang) {
        std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(timeout, uint64_t(3600) * 1'000'000'000)));
        return VK_TIMEOUT;
    }
    return next<PFN_vkWaitForFences>(device, "vkWaitForFences")(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_idle(VkDevice device)
{
    std::unique_lock lock(mutex);
    const std::string now = fault("idle");
    lock.unlock();
    if (now == "BLOCK")
        block();
    const VkResult result = next<PFN_vkDeviceWaitIdle>(device, "vkDeviceWaitIdle")(device);
    lock.lock();
    return lost_devices.count(key(device)) ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_swapchain(
    VkDevice device, const VkSwapchainCreateInfoKHR* info, const VkAllocationCallbacks* allocator, VkSwapchainKHR* made)
{
    {
        const std::lock_guard lock(mutex);
        if (fault("swapchain") == "SURFACE_LOST")
            lost.insert(info->surface);
        if (lost.count(info->surface))
            return VK_ERROR_SURFACE_LOST_KHR;
    }
    VkSwapchainCreateInfoKHR copy = *info;
    for (auto* s = static_cast<const VkBaseInStructure*>(info->pNext); s; s = s->pNext)
        if (s->sType == VK_STRUCTURE_TYPE_SWAPCHAIN_PRESENT_BARRIER_CREATE_INFO_NV)
            std::fprintf(stderr, "fault: in the barrier\n");
    leave_out(
        &copy, [](VkStructureType type) { return type == VK_STRUCTURE_TYPE_SWAPCHAIN_PRESENT_BARRIER_CREATE_INFO_NV; });
    const VkResult result = next<PFN_vkCreateSwapchainKHR>(device, "vkCreateSwapchainKHR")(device, &copy, allocator, made);
    const std::lock_guard lock(mutex);
    if (result == VK_SUCCESS) {
        replaced |= info->oldSwapchain != VK_NULL_HANDLE;
        surfaces[*made] = info->surface;
        order[*made] = int(order.size());
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(
    VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* allocator, VkDeviceMemory* made)
{
    {
        const std::lock_guard lock(mutex);
        if (replaced && fault("resize") == "OUT_OF_MEMORY")
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    const char* largest = std::getenv("STARBOW_LARGEST_KIB");
    if (largest && info->allocationSize > 1024 * VkDeviceSize(std::atoll(largest))) {
        std::fprintf(stderr, "fault: no room for %llu KiB\n", (unsigned long long)(info->allocationSize >> 10));
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    PFN_vkAllocateMemory below;
    {
        const std::lock_guard lock(mutex);
        below = next<PFN_vkAllocateMemory>(device, "vkAllocateMemory");
    }
    const VkResult result = below(device, info, allocator, made);
    const std::lock_guard lock(mutex);
    if (result == VK_SUCCESS)
        allocated[*made] = info->allocationSize;
    return result;
}

VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* allocator)
{
    PFN_vkFreeMemory below;
    {
        const std::lock_guard lock(mutex);
        below = next<PFN_vkFreeMemory>(device, "vkFreeMemory");
        allocated.erase(memory);
    }
    below(device, memory, allocator);
}

VKAPI_ATTR void VKAPI_CALL get_memory(VkPhysicalDevice physical, VkPhysicalDeviceMemoryProperties2* properties)
{
    next_memory(physical, properties);
    for (auto* s = static_cast<VkBaseOutStructure*>(properties->pNext); s && budget_kib() >= 0; s = s->pNext)
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) {
            auto* budget = reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(s);
            const std::lock_guard lock(mutex);
            budget->heapBudget[0] = VkDeviceSize(1024 * budget_kib()), budget->heapUsage[0] = 0;
            for (const auto& [memory, bytes] : allocated)
                budget->heapUsage[0] += bytes;
        }
}

VKAPI_ATTR void VKAPI_CALL destroy_swapchain(
    VkDevice device, VkSwapchainKHR swapchain, const VkAllocationCallbacks* allocator)
{
    next<PFN_vkDestroySwapchainKHR>(device, "vkDestroySwapchainKHR")(device, swapchain, allocator);
    const std::lock_guard lock(mutex);
    std::fprintf(stderr, "fault: shown %d\n", shown[swapchain]);
    shown.erase(swapchain);
    surfaces.erase(swapchain);
    out_of_date.erase(swapchain);
    frozen.erase(swapchain);
    order.erase(swapchain);
}

VKAPI_ATTR void VKAPI_CALL destroy_surface(VkInstance instance, VkSurfaceKHR surface, const VkAllocationCallbacks* allocator)
{
    next_destroy_surface(instance, surface, allocator);
    const std::lock_guard lock(mutex);
    lost.erase(surface);
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator)
{
    void* k = key(device);
    next<PFN_vkDestroyDevice>(device, "vkDestroyDevice")(device, allocator);
    const std::lock_guard lock(mutex);
    std::vector<double> apart_ms;
    for (const auto& [frame, times] : reported)
        if (times.second > times.first)
            apart_ms.push_back(std::chrono::duration<double, std::milli>(times.second - times.first).count());
    if (!apart_ms.empty()) {
        std::sort(apart_ms.begin(), apart_ms.end());
        std::fprintf(stderr, "fault: reported %.2f to %.2f ms apart\n", apart_ms[apart_ms.size() * 3 / 10],
            apart_ms[apart_ms.size() * 7 / 10]);
    }
    reported.clear();
    lost_devices.erase(k);
    devices.erase(k);
    handles.erase(k);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_for_present(VkDevice, VkSwapchainKHR swapchain, uint64_t frame, uint64_t)
{
    int place;
    {
        const std::lock_guard lock(mutex);
        place = order[swapchain];
    }
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(late_ms() * place));
    const std::lock_guard lock(mutex);
    const Clock::time_point now = Clock::now();
    reported.try_emplace(frame, now, now).first->second.second = now;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate_extensions(
    VkPhysicalDevice physical, const char* layer, uint32_t* count, VkExtensionProperties* properties)
{
    const auto below = next_enumerate;
    if (layer || provided().empty())
        return below(physical, layer, count, properties);
    uint32_t theirs = 0;
    below(physical, nullptr, &theirs, nullptr);
    std::vector<VkExtensionProperties> all(theirs);
    below(physical, nullptr, &theirs, all.data());
    for (const auto& [name, features] : provided()) {
        VkExtensionProperties extension{};
        std::strncpy(extension.extensionName, name.data(), sizeof extension.extensionName - 1);
        extension.specVersion = 1;
        all.push_back(extension);
    }
    if (!properties) {
        *count = uint32_t(all.size());
        return VK_SUCCESS;
    }
    const bool fits = *count >= all.size();
    *count = std::min(*count, uint32_t(all.size()));
    std::copy_n(all.begin(), *count, properties);
    return fits ? VK_SUCCESS : VK_INCOMPLETE;
}

VKAPI_ATTR void VKAPI_CALL get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features)
{
    next_features(physical, features);
    // Each of these structures has one feature.
    for (auto* s = static_cast<VkBaseOutStructure*>(features->pNext); s; s = s->pNext)
        for (const auto& [name, type] : provided())
            if (s->sType == type)
                *reinterpret_cast<VkBool32*>(s + 1) = VK_TRUE;
}

VKAPI_ATTR VkResult VKAPI_CALL surface_capabilities(
    VkPhysicalDevice physical, const VkPhysicalDeviceSurfaceInfo2KHR* info, VkSurfaceCapabilities2KHR* capabilities)
{
    const VkResult result = next_capabilities(physical, info, capabilities);
    for (auto* s = static_cast<VkBaseOutStructure*>(capabilities->pNext); s; s = s->pNext)
        if (s->sType == VK_STRUCTURE_TYPE_SURFACE_CAPABILITIES_PRESENT_BARRIER_NV)
            reinterpret_cast<VkSurfaceCapabilitiesPresentBarrierNV*>(s)->presentBarrierSupported = barrier() == "all";
    return result;
}

const std::map<std::string_view, VkResult> errors = {
#define ERROR(name)                                                                                                         \
    {                                                                                                                       \
#name, VK_ERROR_##name                                                                                              \
    }
    ERROR(OUT_OF_HOST_MEMORY),
    ERROR(OUT_OF_DEVICE_MEMORY),
    ERROR(INITIALIZATION_FAILED),
    ERROR(DEVICE_LOST),
    ERROR(MEMORY_MAP_FAILED),
    ERROR(LAYER_NOT_PRESENT),
    ERROR(EXTENSION_NOT_PRESENT),
    ERROR(FEATURE_NOT_PRESENT),
    ERROR(INCOMPATIBLE_DRIVER),
    ERROR(TOO_MANY_OBJECTS),
    ERROR(FRAGMENTED_POOL),
    ERROR(OUT_OF_POOL_MEMORY),
    ERROR(SURFACE_LOST_KHR),
    ERROR(OUT_OF_DATE_KHR),
    ERROR(NATIVE_WINDOW_IN_USE_KHR),
#undef ERROR
};

/// Counts a call by its own name. Returns the error that it shall return, or VK_SUCCESS. handle: any of the device's.
VkResult failure(const char* name, const void* handle)
{
    const std::lock_guard lock(mutex);
    auto& [before, after] = calls[name];
    ++(presented > 0 ? after : before);
    const std::string now = fault(name);
    if (now.empty())
        return VK_SUCCESS;
    if (!errors.count(now)) {
        std::fprintf(stderr, "fault: %s is not an error of Vulkan here\n", now.c_str());
        std::abort();
    }
    if (now == "DEVICE_LOST" && handle)
        lose(key(handle));
    return errors.at(now);
}

struct Listed {
    ~Listed()
    {
        if (!std::getenv("STARBOW_COUNT_CALLS"))
            return;
        for (const auto& [name, times] : calls)
            std::fprintf(stderr, "call: %s %d %d\n", name.c_str(), times.first, times.second);
    }
} listed;

/// A function's name as a template's argument.
template <std::size_t size> struct Name {
    char text[size];
    constexpr Name(const char (&name)[size]) { std::copy_n(name, size, text); }
};

/// Any function of a device, one of its queues or command buffers.
template <Name name, class Function> struct OfDevice;
template <Name name, class Handle, class... Rest> struct OfDevice<name, VkResult (*)(Handle, Rest...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Handle handle, Rest... rest)
    {
        if (const VkResult error = failure(name.text, handle); error != VK_SUCCESS)
            return error;
        VkResult (*below)(Handle, Rest...);
        {
            const std::lock_guard lock(mutex);
            below = next<VkResult (*)(Handle, Rest...)>(handle, name.text);
        }
        return below(handle, rest...);
    }
};

std::map<std::string_view, PFN_vkVoidFunction> next_of_instance; // of the last one, as next_enumerate

/// Any function of the instance, or of a device before it is opened.
template <Name name, class Function> struct OfInstance;
template <Name name, class Handle, class... Rest> struct OfInstance<name, VkResult (*)(Handle, Rest...)> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Handle handle, Rest... rest)
    {
        if (const VkResult error = failure(name.text, nullptr); error != VK_SUCCESS)
            return error;
        return reinterpret_cast<VkResult (*)(Handle, Rest...)>(next_of_instance[name.text])(handle, rest...);
    }
};

/// A function that this layer has of its own.
template <Name name, auto function> struct Own;
template <Name name, class... Arguments, VkResult (*function)(Arguments...)> struct Own<name, function> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments)
    {
        const VkResult error = failure(name.text, std::get<0>(std::tie(arguments...)));
        return error == VK_SUCCESS ? function(arguments...) : error;
    }
};

#define OF_DEVICE(name)                                                                                                     \
    {                                                                                                                       \
#name, reinterpret_cast < PFN_vkVoidFunction>(OfDevice <#name, PFN_##name>::call)                                   \
    }
#define OF_INSTANCE(name)                                                                                                   \
    {                                                                                                                       \
#name, reinterpret_cast < PFN_vkVoidFunction>(OfInstance <#name, PFN_##name>::call)                                 \
    }
const std::map<std::string_view, PFN_vkVoidFunction> of_device = {
    OF_DEVICE(vkAllocateCommandBuffers),
    OF_DEVICE(vkAllocateDescriptorSets),
    OF_DEVICE(vkBeginCommandBuffer),
    OF_DEVICE(vkBindBufferMemory),
    OF_DEVICE(vkBindImageMemory),
    OF_DEVICE(vkCreateBuffer),
    OF_DEVICE(vkCreateBufferView),
    OF_DEVICE(vkCreateCommandPool),
    OF_DEVICE(vkCreateDescriptorPool),
    OF_DEVICE(vkCreateDescriptorSetLayout),
    OF_DEVICE(vkCreateFence),
    OF_DEVICE(vkCreateGraphicsPipelines),
    OF_DEVICE(vkCreateImage),
    OF_DEVICE(vkCreateImageView),
    OF_DEVICE(vkCreatePipelineCache),
    OF_DEVICE(vkCreatePipelineLayout),
    OF_DEVICE(vkCreateQueryPool),
    OF_DEVICE(vkCreateSampler),
    OF_DEVICE(vkCreateSemaphore),
    OF_DEVICE(vkCreateShaderModule),
    OF_DEVICE(vkEndCommandBuffer),
    OF_DEVICE(vkGetPipelineCacheData),
    OF_DEVICE(vkGetQueryPoolResults),
    OF_DEVICE(vkGetSwapchainImagesKHR),
    OF_DEVICE(vkMapMemory),
    OF_DEVICE(vkResetCommandBuffer),
    OF_DEVICE(vkResetFences),
};
const std::map<std::string_view, PFN_vkVoidFunction> of_instance = {
    OF_INSTANCE(vkCreateXcbSurfaceKHR),
    OF_INSTANCE(vkEnumeratePhysicalDevices),
    OF_INSTANCE(vkGetPhysicalDeviceSurfaceCapabilitiesKHR),
    OF_INSTANCE(vkGetPhysicalDeviceSurfaceFormatsKHR),
    OF_INSTANCE(vkGetPhysicalDeviceSurfaceSupportKHR),
};

/// The link to the next layer. Each layer moves it on for the next one.
template <class Link> Link* link_of(const void* chain, VkStructureType type)
{
    auto* link = static_cast<Link*>(const_cast<void*>(chain));
    while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(
    const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator, VkInstance* made)
{
    auto* link = link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    const auto calls = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result
        = reinterpret_cast<PFN_vkCreateInstance>(calls(nullptr, "vkCreateInstance"))(info, allocator, made);
    if (result == VK_SUCCESS) {
        const std::lock_guard lock(mutex);
        last_instance = *made;
        instances[key(*made)] = calls;
        next_enumerate = reinterpret_cast<PFN_vkEnumerateDeviceExtensionProperties>(
            calls(*made, "vkEnumerateDeviceExtensionProperties"));
        next_features = reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(calls(*made, "vkGetPhysicalDeviceFeatures2"));
        next_memory = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(
            calls(*made, "vkGetPhysicalDeviceMemoryProperties2"));
        next_capabilities = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceCapabilities2KHR>(
            calls(*made, "vkGetPhysicalDeviceSurfaceCapabilities2KHR"));
        next_destroy_surface = reinterpret_cast<PFN_vkDestroySurfaceKHR>(calls(*made, "vkDestroySurfaceKHR"));
        for (const auto& [name, own] : of_instance)
            next_of_instance[name] = calls(*made, name.data());
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(
    VkPhysicalDevice physical, const VkDeviceCreateInfo* info, const VkAllocationCallbacks* allocator, VkDevice* made)
{
    auto* link = link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const auto instance_calls = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const auto device_calls = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;

    // The driver must not see the extensions that only the layer provides.
    VkDeviceCreateInfo copy = *info;
    std::vector<const char*> names;
    for (uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
        if (!provided().contains(info->ppEnabledExtensionNames[i]))
            names.push_back(info->ppEnabledExtensionNames[i]);
    }
    copy.enabledExtensionCount = uint32_t(names.size());
    copy.ppEnabledExtensionNames = names.data();
    leave_out(&copy, [](VkStructureType type) {
        return std::ranges::any_of(provided(), [&](const auto& one) { return one.second == type; });
    });
    const VkResult result = reinterpret_cast<PFN_vkCreateDevice>(instance_calls(last_instance, "vkCreateDevice"))(
        physical, &copy, allocator, made);
    if (result == VK_SUCCESS) {
        const std::lock_guard lock(mutex);
        devices[key(*made)] = device_calls;
        handles[key(*made)] = *made;
        lost_devices.erase(key(*made));
    }
    return result;
}

PFN_vkVoidFunction layer_function(std::string_view name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc(VkDevice device, const char* name)
{
    const auto function = layer_function(name);
    return function ? function : devices[key(device)](device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc(VkInstance instance, const char* name)
{
    const auto function = layer_function(name);
    return function ? function : instance ? instances[key(instance)](instance, name) : nullptr;
}

PFN_vkVoidFunction layer_function(std::string_view name)
{
    const std::map<std::string_view, PFN_vkVoidFunction> functions = {
#define FUNCTION(name, function) {name, reinterpret_cast<PFN_vkVoidFunction>(function)}
        FUNCTION("vkGetInstanceProcAddr", get_instance_proc),
        FUNCTION("vkGetDeviceProcAddr", get_device_proc),
        FUNCTION("vkDestroyDevice", destroy_device),
        FUNCTION("vkDestroySurfaceKHR", destroy_surface),
        FUNCTION("vkGetPhysicalDeviceFeatures2", get_features),
        FUNCTION("vkGetPhysicalDeviceMemoryProperties2", get_memory),
        FUNCTION("vkFreeMemory", free_memory),
        FUNCTION("vkDestroySwapchainKHR", destroy_swapchain),
        FUNCTION("vkGetPhysicalDeviceSurfaceCapabilities2KHR", surface_capabilities),
#undef FUNCTION
#define OWN(name, function) {#name, reinterpret_cast<PFN_vkVoidFunction>(Own<#name, function>::call)}
        OWN(vkCreateInstance, create_instance),
        OWN(vkCreateDevice, create_device),
        OWN(vkEnumerateDeviceExtensionProperties, enumerate_extensions),
        OWN(vkAllocateMemory, allocate_memory),
        OWN(vkCreateSwapchainKHR, create_swapchain),
        OWN(vkAcquireNextImageKHR, acquire),
        OWN(vkQueuePresentKHR, present),
        OWN(vkQueueSubmit2, submit),
        OWN(vkWaitForFences, wait_for_fences),
        OWN(vkDeviceWaitIdle, wait_idle),
#undef OWN
    };
    if (name == "vkWaitForPresentKHR" && late_ms() >= 0)
        return reinterpret_cast<PFN_vkVoidFunction>(wait_for_present);
    for (const auto* list : {&functions, &of_device, &of_instance})
        if (const auto found = list->find(name); found != list->end())
            return found->second;
    return nullptr;
}

} // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* interface)
{
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = get_instance_proc;
    interface->pfnGetDeviceProcAddr = get_device_proc;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
