#include "pipeline_layouts.h"
#include "debug.h"
#include "shaders/shared_structs.h"

namespace starbow {
namespace {

vk::raii::DescriptorSetLayout make_set_layout(
    const Device& device, const char* name, vk::ShaderStageFlags stages, std::initializer_list<vk::DescriptorType> types)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (vk::DescriptorType type : types)
        bindings.push_back({std::uint32_t(bindings.size()), type, 1, stages});
    vk::raii::DescriptorSetLayout layout = device.device.createDescriptorSetLayout({{}, bindings});
    name_object(device, layout, name);
    return layout;
}

vk::raii::PipelineLayout make_layout(const Device& device, const char* name,
    std::initializer_list<vk::DescriptorSetLayout> sets, vk::ShaderStageFlags stages, std::uint32_t push_bytes)
{
    vk::PushConstantRange push(stages, 0, push_bytes);
    vk::raii::PipelineLayout layout = device.device.createPipelineLayout({{}, sets, push});
    name_object(device, layout, name);
    return layout;
}

} // namespace

PipelineLayouts::PipelineLayouts(const Device& device)
{
    using Type = vk::DescriptorType;
    constexpr auto fragment = vk::ShaderStageFlagBits::eFragment;
    constexpr auto both = fragment | vk::ShaderStageFlagBits::eVertex;
    constexpr Type picture = Type::eCombinedImageSampler;
    constexpr Type constants = Type::eUniformBuffer;
    eye_set = make_set_layout(device, "eye descriptor set layout", both,
        {Type::eUniformBufferDynamic, Type::eStorageBuffer, Type::eStorageBuffer, constants, Type::eStorageBuffer, picture,
            picture, Type::eStorageBuffer, Type::eStorageBuffer, Type::eStorageBuffer, Type::eStorageBuffer});
    material_set = make_set_layout(device, "material descriptor set layout", fragment,
        {picture, picture, picture, picture, picture, picture, constants});
    warp_set = make_set_layout(device, "warp descriptor set layout", both,
        {picture, picture, Type::eUniformTexelBuffer, Type::eUniformTexelBuffer, picture, picture, picture, picture, picture,
            picture, constants, picture, constants, picture, picture, constants, picture, picture, picture, picture,
            constants, picture});
    star_set = make_set_layout(device, "star descriptor set layout", vk::ShaderStageFlagBits::eVertex,
        {Type::eUniformBufferDynamic, Type::eStorageBuffer, constants});
    picture_set = make_set_layout(device, "picture descriptor set layout", fragment, {picture, picture});
    overlay_set = make_set_layout(device, "overlay descriptor set layout", fragment, {constants, Type::eUniformTexelBuffer});
    finish_set
        = make_set_layout(device, "finish descriptor set layout", fragment, {picture, picture, picture, picture, picture});
    surface_layout = make_layout(device, "surface pipeline layout", {*eye_set, *material_set},
        vk::ShaderStageFlagBits::eVertex, sizeof(shared::CubePush));
    warp_layout = make_layout(device, "warp pipeline layout", {*warp_set}, fragment, sizeof(shared::ViewPush));
    star_layout = make_layout(device, "star pipeline layout", {*warp_set, *star_set}, both, sizeof(shared::ViewPush));
    overlay_layout
        = make_layout(device, "overlay pipeline layout", {*warp_set, *overlay_set}, fragment, sizeof(shared::ViewPush));
    picture_layout = make_layout(device, "picture pipeline layout", {*picture_set}, fragment, sizeof(shared::ViewPush));
    finish_layout = make_layout(device, "finish pipeline layout", {*finish_set}, fragment, sizeof(shared::FinishPush));
}

} // namespace starbow
