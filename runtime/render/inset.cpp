#include "inset.h"
#include "config/model/one_view.h"
#include "debug.h"
#include <limits>

namespace starbow {

Inset::Inset(Device& device, const Pipelines& pipelines, int width, double fov_deg)
    : fov_deg(fov_deg)
    , picture(make_image(device,
          {vk::Format::eR8G8B8A8Srgb, {std::uint32_t(width), std::uint32_t(int(width * aspect))},
              vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled
                  | vk::ImageUsageFlagBits::eTransferSrc}))
{
    name_object(device, picture, "inset");
    MapStore store(std::filesystem::path{}); // a flat view has a matrix
    const Layout layout = one_view(Planar{.fov_y_deg = fov_deg}, {width, int(width * aspect)});
    view.compiled = compile_output(store, layout, 0, layout.outputs[0].size).front();
    view.output = std::numeric_limits<std::size_t>::max();
    const std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBuffer, 4},
        {vk::DescriptorType::eUniformTexelBuffer, 2}, {vk::DescriptorType::eCombinedImageSampler, 17}};
    pool = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    name_object(device, pool, "inset: descriptor pool");
    view.warp_set = std::move(device.device.allocateDescriptorSets({*pool, *pipelines.layouts.warp_set}).front());
    name_object(device, view.warp_set, "inset: descriptor set");
}

} // namespace starbow
