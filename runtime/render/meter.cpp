#include "meter.h"
#include "debug.h"
#include "pipelines.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// Number of samples of all views together, and the least number of each view. Some samples then meet a lamp of a
/// thousandth of the view.
constexpr double samples = 6000, least_samples = 48;
/// Number of star samples of all views together: a view of a twentieth of the sky then has about a hundred.
constexpr int star_samples = 3000, star_row = 64;

static_assert(sizeof(LuminanceSample) == 8);

} // namespace

Meter::Meter(const Device& device, std::span<const glm::ivec2> views, std::uint32_t stars)
{
    glm::ivec2 size(1);
    int below = 0;
    const auto counting = std::count_if(views.begin(), views.end(), [](const glm::ivec2& view) { return view.x > 0; });
    for (const glm::ivec2& view : views) {
        if (view.x == 0) {
            cells_.push_back({});
            continue;
        }
        const double wanted = std::max(samples / double(counting), least_samples);
        const double across = std::sqrt(wanted * view.x / view.y);
        Cell cell{
            {0, below}, glm::clamp(glm::ivec2(glm::dvec2(across, wanted / across)), glm::ivec2(1), glm::min(view, 1024))};
        below += cell.size.y;
        size = glm::max(size, cell.corner + cell.size);
        cells_.push_back(cell);
    }
    view_rows_ = below;
    every_ = std::max(1, int((std::uint64_t(stars) * std::uint64_t(counting) + star_samples - 1) / star_samples));
    const int rows = (int(stars) + every_ * star_row - 1) / (every_ * star_row);
    for (const glm::ivec2& view : views) {
        const Cell cell{{0, below}, view.x > 0 ? glm::ivec2(star_row, rows) : glm::ivec2(0)};
        below += cell.size.y;
        size = glm::max(size, cell.corner + cell.size);
        star_cells_.push_back(cell);
    }
    picture_ = make_image(device,
        {meter_format, {std::uint32_t(size.x), std::uint32_t(size.y)},
            vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
    name_object(device, picture_, "meter: picture");
    back_ = make_read_buffer(
        device, std::size_t(size.x) * size.y * sizeof(LuminanceSample), vk::BufferUsageFlagBits::eTransferDst);
    name_object(device, back_, "meter: back");
}

vk::RenderingAttachmentInfo Meter::begin(vk::CommandBuffer commands) const
{
    transition(commands, picture_, vk::ImageLayout::eUndefined, Stage::eTransfer, {},
        vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
    return {*picture_.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {}, vk::AttachmentLoadOp::eClear,
        vk::AttachmentStoreOp::eStore};
}

void Meter::end(vk::CommandBuffer commands)
{
    transition(commands, picture_, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
        Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    commands.copyImageToBuffer(*picture_.image, vk::ImageLayout::eTransferSrcOptimal, *back_.buffer,
        vk::BufferImageCopy(
            0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {picture_.extent.width, picture_.extent.height, 1}));
    vk::MemoryBarrier2 to_host(Stage::eTransfer, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, to_host));
    drawn_ = true;
}

std::span<const LuminanceSample> Meter::view() const
{
    if (!drawn_)
        return {};
    return {static_cast<const LuminanceSample*>(back_.mapped), std::size_t(picture_.extent.width) * view_rows_};
}

std::span<const LuminanceSample> Meter::stars() const
{
    if (!drawn_)
        return {};
    const std::size_t view = std::size_t(picture_.extent.width) * view_rows_;
    return {static_cast<const LuminanceSample*>(back_.mapped) + view,
        std::size_t(picture_.extent.width) * picture_.extent.height - view};
}

std::span<LuminanceSample> Meter::rows(const Cell& cell)
{
    if (!drawn_)
        return {};
    const std::size_t width = picture_.extent.width;
    return {
        static_cast<LuminanceSample*>(back_.mapped) + width * std::size_t(cell.corner.y), width * std::size_t(cell.size.y)};
}

std::span<LuminanceSample> Meter::view(std::size_t view) { return rows(cells_[view]); }
std::span<LuminanceSample> Meter::stars(std::size_t view) { return rows(star_cells_[view]); }

} // namespace starbow
