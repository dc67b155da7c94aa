// A debugger's capture can be read: every Vulkan object of a frame has a name, and every pass has a label. The test replaces
// device functions by ones that take notes and pass the call on.
#include "config/model/one_view.h"
#include "runtime/render/offscreen.h"
#include "runtime/render/render_context.h"
#include "runtime/world/stars.h"
#include "tests/support/files.h"
#include "tests/support/gpu_environment.h"
#include <map>
#include <set>

namespace debug_gpu_test {

using namespace starbow;
using starbow::gpu_test::GpuEnvironment;

namespace {

struct Notes {
    std::map<std::uint64_t, std::string> made; ///< the kind of object, by handle
    std::map<std::uint64_t, std::string> names;
    std::vector<std::string> labels;
    int open = 0; ///< labels that have begun and not ended
};
Notes notes;
using Functions = std::remove_cvref_t<decltype(*std::declval<const vk::raii::Device&>().getDispatcher())>;
std::optional<Functions> next; ///< the device's own functions

template <class Handle> std::uint64_t number(Handle handle) { return reinterpret_cast<std::uint64_t>(handle); }

VKAPI_ATTR VkResult VKAPI_CALL set_name(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info)
{
    notes.names[info->objectHandle] = info->pObjectName;
    return next->vkSetDebugUtilsObjectNameEXT(device, info);
}
VKAPI_ATTR void VKAPI_CALL begin_label(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label)
{
    notes.labels.push_back(std::string(std::size_t(notes.open++), ' ') + label->pLabelName);
    next->vkCmdBeginDebugUtilsLabelEXT(commands, label);
}
VKAPI_ATTR void VKAPI_CALL end_label(VkCommandBuffer commands)
{
    --notes.open;
    next->vkCmdEndDebugUtilsLabelEXT(commands);
}

#define NOTE_CREATION(kind)                                                                                                 \
    VKAPI_ATTR VkResult VKAPI_CALL create_##kind(                                                                           \
        VkDevice device, const Vk##kind##CreateInfo* info, const VkAllocationCallbacks* allocator, Vk##kind* made)          \
    {                                                                                                                       \
        const VkResult result = next->vkCreate##kind(device, info, allocator, made);                                        \
        notes.made[number(*made)] = #kind;                                                                                  \
        return result;                                                                                                      \
    }
NOTE_CREATION(Image)
NOTE_CREATION(ImageView)
NOTE_CREATION(Buffer)
NOTE_CREATION(BufferView)
NOTE_CREATION(Sampler)
NOTE_CREATION(DescriptorPool)
NOTE_CREATION(DescriptorSetLayout)
NOTE_CREATION(PipelineLayout)
NOTE_CREATION(ShaderModule)
NOTE_CREATION(Fence)

VKAPI_ATTR VkResult VKAPI_CALL create_pipelines(VkDevice device, VkPipelineCache cache, std::uint32_t count,
    const VkGraphicsPipelineCreateInfo* infos, const VkAllocationCallbacks* allocator, VkPipeline* made)
{
    const VkResult result = next->vkCreateGraphicsPipelines(device, cache, count, infos, allocator, made);
    for (std::uint32_t i = 0; i < count; ++i)
        notes.made[number(made[i])] = "Pipeline";
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL allocate_sets(VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* made)
{
    const VkResult result = next->vkAllocateDescriptorSets(device, info, made);
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i)
        notes.made[number(made[i])] = "DescriptorSet";
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(
    VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* allocator, VkDeviceMemory* made)
{
    const VkResult result = next->vkAllocateMemory(device, info, allocator, made);
    notes.made[number(*made)] = "DeviceMemory";
    return result;
}

void take_note(Device& device)
{
    auto& calls = const_cast<Functions&>(*device.device.getDispatcher());
    next.emplace(calls);
    calls.vkSetDebugUtilsObjectNameEXT = set_name;
    calls.vkCmdBeginDebugUtilsLabelEXT = begin_label;
    calls.vkCmdEndDebugUtilsLabelEXT = end_label;
    calls.vkCreateImage = create_Image;
    calls.vkCreateImageView = create_ImageView;
    calls.vkCreateBuffer = create_Buffer;
    calls.vkCreateBufferView = create_BufferView;
    calls.vkCreateSampler = create_Sampler;
    calls.vkCreateDescriptorPool = create_DescriptorPool;
    calls.vkCreateDescriptorSetLayout = create_DescriptorSetLayout;
    calls.vkCreatePipelineLayout = create_PipelineLayout;
    calls.vkCreateShaderModule = create_ShaderModule;
    calls.vkCreateFence = create_Fence;
    calls.vkCreateGraphicsPipelines = create_pipelines;
    calls.vkAllocateDescriptorSets = allocate_sets;
    calls.vkAllocateMemory = allocate_memory;
}

} // namespace

TEST(Debug, EveryObjectHasANameAndEveryPassALabel)
{
    Device device({.validation = true, .name = device_options(false).name});
    ASSERT_TRUE(device.debug_utils);
    take_note(device);
    {
        Pipelines pipelines(device);
        const SceneFile scene = load_scene_file(starbow::testing::source_dir() / "config/scenes/avenue.json");
        const GpuWorld world = upload(device, pipelines, load_world(scene), scene, stars_in_depth(*scene.stars));
        Layout layout = load_layout(starbow::testing::source_dir() / "config/layouts/anaglyph.json");
        layout.outputs[0].size = {320, 240};
        OffscreenRenderer renderer(
            device, pipelines, world, layout, within(device, {.texels_per_pixel = 0.6, .cube_samples = 4}), false);
        Shot shot;
        shot.u = {0, 0, -1};
        const Panel hud = Typesetter().draw({}, starbow::testing::words(), 320);
        renderer.frame().meter(true);
        renderer.frame().bloom(0.1);
        renderer.frame().measure(Measuring{.probes = {{glm::dvec3(0, 0, -1)}}, .over = {.overlay = Overlay::grid}});
        notes.labels.clear();
        (void)renderer.picture(shot, &hud);
    }
    std::map<std::string, int> counts;
    for (const auto& [handle, kind] : notes.made) {
        ++counts[kind];
        EXPECT_TRUE(notes.names.contains(handle)) << "a " << kind << " without a name";
        EXPECT_FALSE(notes.names.contains(handle) && notes.names.at(handle).empty())
            << "a " << kind << " with an empty name";
    }
    for (const char* kind : {"Image", "ImageView", "Buffer", "Sampler", "DescriptorSet", "Pipeline", "DeviceMemory"})
        EXPECT_GT(counts[kind], 3) << kind;
    EXPECT_EQ(notes.open, 0);
    // The passes are in the frame's order. Two eyes share the output's pixels, so stars and bloom come twice.
    EXPECT_EQ(notes.labels,
        (std::vector<std::string>{
            "cube pass", "meter", "probes", "warp", " stars", " bloom", " stars", " bloom", "overlay", "HUD", "finish"}));
    GpuEnvironment::expect_no_complaints(device);
}

} // namespace debug_gpu_test
