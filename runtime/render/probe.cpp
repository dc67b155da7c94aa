#include "probe.h"
#include "debug.h"
#include "pipelines.h"
#include <cmath>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// The luminance of a colour in Rec. 709's primaries.
double luminance(const glm::dvec3& colour) { return glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// The matrix of one pixel that looks along n.
glm::dmat3 pixel_along(const glm::dvec3& n, double angle)
{
    const glm::dvec3 up = std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(n, up)), down = glm::cross(n, right);
    return {right * angle, down * angle, n - 0.5 * angle * (right + down)};
}

} // namespace

Probe::Probe(const Device& device, const std::vector<ProbeRay>& rays, double pixel_angle)
    : device_(device)
    , pixel_angle_(pixel_angle)
{
    for (const ProbeRay& ray : rays) {
        const glm::dmat3 matrix = pixel_along(ray.direction, pixel_angle);
        pixels_.push_back({ray, matrix, std::make_shared<ConeHierarchy>(matrix, glm::ivec2(1))});
    }
    for (Image& image : images_) {
        image = make_image(device,
            {exact_format, {std::uint32_t(rays.size()), 1},
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
        name_object(device, image, "probe: image");
    }
    back_ = make_read_buffer(
        device, images_.size() * rays.size() * sizeof(glm::vec4), vk::BufferUsageFlagBits::eTransferDst);
    name_object(device, back_, "probe: back");
}

bool Probe::looks(const std::vector<ProbeRay>& rays, double pixel_angle) const
{
    bool same = rays.size() == pixels_.size() && pixel_angle == pixel_angle_;
    for (std::size_t i = 0; same && i < rays.size(); ++i)
        same = rays[i] == pixels_[i].ray;
    return same;
}

void Probe::record(vk::CommandBuffer commands, const std::function<void(std::size_t, const glm::dmat3&)>& draw)
{
    std::vector<vk::RenderingAttachmentInfo> colours;
    for (const Image& image : images_) {
        transition(commands, image, vk::ImageLayout::eUndefined, Stage::eTransfer, {},
            vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        colours.push_back({*image.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore});
    }
    device_.begin_rendering(commands, {{}, {{0, 0}, images_[0].extent}, 1, 0, colours});
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        draw(i, pixels_[i].cockpit_from_pixel);
    device_.end_rendering(commands);
    const vk::DeviceSize bytes = pixels_.size() * sizeof(glm::vec4);
    for (std::size_t k = 0; k < images_.size(); ++k) {
        transition(commands, images_[k], vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
        commands.copyImageToBuffer(*images_[k].image, vk::ImageLayout::eTransferSrcOptimal, *back_.buffer,
            vk::BufferImageCopy(
                k * bytes, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {images_[k].extent.width, 1, 1}));
    }
    vk::MemoryBarrier2 to_host(Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    drawn_ = true;
}

std::vector<Probed> Probe::read() const
{
    std::vector<Probed> all;
    const auto* texels = static_cast<const glm::vec4*>(back_.mapped);
    for (std::size_t i = 0; drawn_ && i < pixels_.size(); ++i) {
        const glm::dvec4 light = texels[i], ship = texels[pixels_.size() + i], world = texels[2 * pixels_.size() + i];
        all.push_back({{glm::dvec3(ship), glm::dvec3(world), ship.w}, distance_of(light.w), int(world.w),
            luminance(glm::dvec3(light))});
    }
    return all;
}

} // namespace starbow
