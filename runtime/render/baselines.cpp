#include "baselines.h"
#include "debug.h"
#include "pass_timer.h"

namespace starbow {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

PlainPictureBaseline::PlainPictureBaseline(
    Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, OffscreenRenderer& of)
    : device_(device)
    , of_(of)
    , pass_(device, pipelines, world, quality, false)
{
}

double PlainPictureBaseline::ms(const Shot& shot)
{
    return milliseconds([&] {
        glm::dmat3 straight;
        const PlannedImage image = of_.frame().passes().plain_image(shot, straight);
        pass_.prepare_plain(image, {0, shot.position, shot.time, straight});
        device_.now([&](vk::CommandBuffer commands) {
            make_writable(commands, of_.target(0));
            pass_.record_plain(commands, of_.target(0));
        });
    });
}

BareLookupBaseline::BareLookupBaseline(Device& device, Pipelines& pipelines)
    : device_(device)
    , pipelines_(pipelines)
{
    cube_ = make_image(device,
        {light_format, {512, 512}, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, 1, 6,
            vk::SampleCountFlagBits::e1, true});
    name_object(device, cube_, "yardstick: cube map");
    device.now([&](vk::CommandBuffer commands) {
        transition(commands, cube_, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eTransferDstOptimal,
            Stage::eTransfer, Access::eTransferWrite);
        commands.clearColorImage(*cube_.image, vk::ImageLayout::eTransferDstOptimal,
            vk::ClearColorValue(std::array<float, 4>{0.2f, 0.3f, 0.5f, 1}),
            vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 6));
        transition(commands, cube_, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
            vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eFragmentShader, Access::eShaderSampledRead);
    });
    vk::DescriptorPoolSize size(vk::DescriptorType::eCombinedImageSampler, 2);
    pool_ = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
    set_ = std::move(device.device.allocateDescriptorSets({*pool_, *pipelines.layouts.picture_set}).front());
    sampler_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear});
    const float zeros[4] = {};
    no_map_ = make_texture(device, exact_format, {1, 1}, std::as_bytes(std::span(zeros)), false);
    vk::DescriptorImageInfo map(*sampler_, *no_map_.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    vk::DescriptorImageInfo info(*sampler_, *cube_.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    device.device.updateDescriptorSets(
        {vk::WriteDescriptorSet(*set_, 0, 0, vk::DescriptorType::eCombinedImageSampler, map),
            vk::WriteDescriptorSet(*set_, 1, 0, vk::DescriptorType::eCombinedImageSampler, info)},
        {});
}

double BareLookupBaseline::ms(OffscreenRenderer& of)
{
    const Target target = of.target(0);
    const vk::Pipeline pipeline = pipelines_.lookup(target.format);
    return milliseconds([&] {
        device_.now([&](vk::CommandBuffer commands) {
            make_writable(commands, target);
            of.frame().passes().look_up(commands, target, pipeline, *set_);
        });
    });
}

double draw_plans_ms(Device& device, CubePass& pass, std::span<const CubeMapPlan> plans, const EyeEvent& eye_event)
{
    return milliseconds([&] {
        for (const CubeMapPlan& plan : plans) {
            pass.prepare(plan, {&eye_event, 1}, StoredLight::coefficients, 1);
            device.now([&](vk::CommandBuffer commands) { pass.record(commands); });
        }
    });
}

} // namespace starbow
