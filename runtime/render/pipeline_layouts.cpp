#include "pipeline_layouts.h"
#include "debug.h"
#include "shaders/shared_structs.h"

namespace starbow {
namespace {

vk::raii::DescriptorSetLayout make_set_layout(
    const Device& device, vk::ShaderStageFlags stages, std::initializer_list<vk::DescriptorType> types)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (vk::DescriptorType type : types)
        bindings.push_back({std::uint32_t(bindings.size()), type, 1, stages});
    return device.device.createDescriptorSetLayout({{}, bindings});
}

vk::raii::PipelineLayout make_layout(const Device& device, std::initializer_list<vk::DescriptorSetLayout> sets,
    vk::ShaderStageFlags stages, std::uint32_t push_bytes)
{
    vk::PushConstantRange push(stages, 0, push_bytes);
    return device.device.createPipelineLayout({{}, sets, push});
}

} // namespace

PipelineLayouts::PipelineLayouts(const Device& device)
{
    using Type = vk::DescriptorType;
    constexpr auto fragment = vk::ShaderStageFlagBits::eFragment;
    constexpr auto both = fragment | vk::ShaderStageFlagBits::eVertex;
    constexpr Type picture = Type::eCombinedImageSampler;
    constexpr Type constants = Type::eUniformBuffer;
    eye_set = make_set_layout(device, both,
        {Type::eUniformBufferDynamic, Type::eStorageBuffer, Type::eStorageBuffer, constants, Type::eStorageBuffer});
    material_set = make_set_layout(device, fragment, {picture, picture});
    warp_set = make_set_layout(device, both,
        {picture, picture, Type::eUniformTexelBuffer, Type::eUniformTexelBuffer, picture, picture, picture, picture, picture,
            picture, constants, picture, constants});
    star_set = make_set_layout(
        device, vk::ShaderStageFlagBits::eVertex, {Type::eUniformBufferDynamic, Type::eStorageBuffer, constants});
    picture_set = make_set_layout(device, fragment, {picture, picture});
    overlay_set = make_set_layout(device, fragment, {constants});
    finish_set = make_set_layout(device, fragment, {picture, picture, picture, picture, picture});
    surface_layout = make_layout(device, {*eye_set, *material_set}, both, sizeof(shared::CubePush));
    warp_layout = make_layout(device, {*warp_set}, fragment, sizeof(shared::ViewPush));
    star_layout = make_layout(device, {*warp_set, *star_set}, both, sizeof(shared::ViewPush));
    overlay_layout = make_layout(device, {*warp_set, *overlay_set}, fragment, sizeof(shared::ViewPush));
    picture_layout = make_layout(device, {*picture_set}, fragment, sizeof(shared::ViewPush));
    finish_layout = make_layout(device, {*finish_set}, fragment, sizeof(shared::FinishPush));
    name_object(device, eye_set, "eye descriptor set layout");
    name_object(device, material_set, "material descriptor set layout");
    name_object(device, warp_set, "warp descriptor set layout");
    name_object(device, star_set, "star descriptor set layout");
    name_object(device, picture_set, "picture descriptor set layout");
    name_object(device, overlay_set, "overlay descriptor set layout");
    name_object(device, finish_set, "finish descriptor set layout");
    name_object(device, surface_layout, "surface pipeline layout");
    name_object(device, warp_layout, "warp pipeline layout");
    name_object(device, star_layout, "star pipeline layout");
    name_object(device, overlay_layout, "overlay pipeline layout");
    name_object(device, picture_layout, "picture pipeline layout");
    name_object(device, finish_layout, "finish pipeline layout");
}

} // namespace starbow
