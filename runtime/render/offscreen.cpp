#include "offscreen.h"
#include "config/json/error.h"
#include "debug.h"
#include "runtime/operation/progress.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

constexpr vk::Format picture_format = vk::Format::eR8G8B8A8Srgb;

vk::Extent2D extent_of(glm::ivec2 size) { return {std::uint32_t(size.x), std::uint32_t(size.y)}; }

} // namespace

OffscreenRenderer::OffscreenRenderer(
    Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality, bool measured)
    : device_(device)
    , layout_(layout)
    , frame_(device, pipelines, world, layout, quality, measured)
{
    frame_.repeatable(true);
    for (const Output& output : layout.outputs) {
        constexpr double most_measured = 1 << 26; // pixels: 14 channels of them are 3.5 GiB
        if (measured && double(output.size.x) * output.size.y > most_measured)
            throw InputError("The numbers of " + std::to_string(output.size.x) + "x" + std::to_string(output.size.y)
                + " pixels are too many for one EXR file: at most 8192x8192, or as many in another shape");
        images_.push_back(make_image(device,
            {picture_format, extent_of(output.size),
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc}));
    }
}

Target OffscreenRenderer::target(std::size_t output) const
{
    const Image& image = images_[output];
    return {*image.image, *image.view, image.extent, image.format};
}

std::vector<std::vector<std::uint8_t>> OffscreenRenderer::picture(const Shot& shot, const Panel* hud)
{
    std::vector<Target> targets;
    for (std::size_t i = 0; i < images_.size(); ++i)
        targets.push_back(target(i));
    device_.now([&](vk::CommandBuffer commands) {
        for (const Image& image : images_)
            transition(commands, image, vk::ImageLayout::eUndefined, Stage::eNone, {},
                vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        frame_.draw(commands, shot, hud, targets);
        for (const Image& image : images_)
            transition(commands, image, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer,
                Access::eTransferRead);
    });
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const Image& image : images_) {
        std::vector<std::byte> bytes = read_back(device_, image, 4);
        auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
        pictures.emplace_back(first, first + bytes.size());
    }
    return pictures;
}

/// Draws the shot's luminance samples alone, and reads them while they last.
template <class Read> auto OffscreenRenderer::sampled(const Shot& shot, const Read& read)
{
    frame_.meter(true);
    frame_.count_all_light(true);
    frame_.update(shot, nullptr);
    device_.now([&](vk::CommandBuffer commands) {
        frame_.draw_cubes(commands);
        frame_.draw_meter(commands);
    });
    const auto result = read();
    frame_.meter(false);
    frame_.count_all_light(false);
    return result;
}

std::optional<double> OffscreenRenderer::metered(const Shot& shot)
{
    return sampled(shot, [&] { return frame_.metered(); });
}

std::optional<RangeCurve> OffscreenRenderer::ranged(const Shot& shot)
{
    Shot unexposed = shot; // light counts whatever the exposure
    unexposed.exposure_ev = -60;
    return sampled(
        unexposed, [&] { return range_curve(frame_.surface_samples(), frame_.star_samples(), shot.exposure_ev); });
}

std::vector<Probed> OffscreenRenderer::probed(const Shot& shot)
{
    frame_.update(shot, nullptr);
    device_.now([&](vk::CommandBuffer commands) {
        frame_.draw_cubes(commands);
        frame_.draw_probes(commands);
    });
    return frame_.probed();
}

Channels OffscreenRenderer::numbers(const Shot& shot, std::size_t output)
{
    Channels channels;
    const std::size_t count = std::size_t(images_[output].extent.width) * images_[output].extent.height;
    for (const char* name : number_channels)
        channels.emplace_back(name, std::vector<float>(count, std::nanf("")));
    MeasureTarget target;
    for (Image* image : {&target.light_and_depth, &target.camera, &target.world}) {
        *image = make_image(device_,
            {exact_format, images_[output].extent,
                vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
        name_object(device_, *image, "offscreen: image");
    }
    Shot unexposed = shot; // numbers describe light, whatever the exposure
    unexposed.exposure_ev = -60;
    frame_.count_all_light(true);
    frame_.update(unexposed, nullptr);
    frame_.count_all_light(false); // the plan is made
    for (std::size_t layer = 0; layer < frame_.views().outputs[output].layers(); ++layer) {
        device_.now([&](vk::CommandBuffer commands) { frame_.record_measured(commands, output, layer, target); });
        read_numbers(output, layer, target, channels);
    }
    return channels;
}

/// Fills the channels of the pixels of which a measured layer has the largest part.
void OffscreenRenderer::read_numbers(std::size_t output, std::size_t layer, const MeasureTarget& target, Channels& channels)
{
    const std::size_t count = channels.front().second.size();
    auto texels = [&](const Image& image) {
        std::vector<glm::vec4> values(count);
        std::vector<std::byte> bytes = read_back(device_, image, sizeof(glm::vec4));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    };
    const std::vector<glm::vec4> light = texels(target.light_and_depth), camera = texels(target.camera),
                                 world = texels(target.world);
    const OutputState& of = frame_.views().outputs[output];
    for (const ViewPasses::Axes& axes : frame_.passes().measured_axes(output)) {
        if (axes.layer != layer)
            continue;
        for (int y = axes.corner.y; y < axes.corner.y + axes.size.y; ++y)
            for (int x = axes.corner.x; x < axes.corner.x + axes.size.x; ++x) {
                if (!of.shows_foremost(layer, {x, y}))
                    continue;
                const std::size_t i = std::size_t(y * int(images_[output].extent.width) + x);
                const float depth = distance_of(light[i].w);
                const glm::dvec3 towards = axes.world_from_cube * glm::dvec3(world[i]);
                const glm::vec3 c = axes.world_from_motion * glm::dvec3(camera[i]), w = towards,
                                across = towards - axes.ahead * glm::dot(axes.ahead, towards);
                const float values[] = {light[i].r, light[i].g, light[i].b, c.x, c.y, c.z, w.x, w.y, w.z, camera[i].w, depth,
                    across.x, across.y, across.z};
                for (std::size_t k = 0; k < number_channels.size(); ++k)
                    channels[k].second[i] = values[k];
            }
    }
}

Quality measured_quality(Quality quality)
{
    quality.texels_per_pixel = std::max(quality.texels_per_pixel, 8.0);
    quality.max_texels_per_pixel = std::max(quality.max_texels_per_pixel, 256.0);
    return quality;
}

std::vector<std::vector<std::uint8_t>> render_still(
    const std::filesystem::path& directory, OffscreenRenderer& renderer, const Shot& shot, bool exr, const Panel* hud)
{
    const auto& outputs = renderer.layout().outputs;
    Progress progress;
    const std::size_t steps = exr ? 2 + 2 * outputs.size() : 2;
    std::size_t done = 0;
    const auto next = [&](const std::string& step) {
        progress.show(std::to_string(done + 1) + " of " + std::to_string(steps) + ": " + step, double(done) / double(steps));
        ++done;
    };
    next("drawing");
    auto pictures = renderer.picture(shot, hud);
    std::vector<Channels> numbers;
    const Quality quality = renderer.frame().quality();
    if (exr)
        renderer.frame().adopt(measured_quality(quality));
    for (std::size_t i = 0; exr && i < outputs.size(); ++i) {
        next("measuring " + outputs[i].name);
        numbers.push_back(renderer.numbers(shot, i));
    }
    renderer.frame().adopt(quality);
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
        throw InputError(
            directory.string(), "", "can't be made (" + error.message() + "); give a folder that can be written");
    next("writing");
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        write_png(directory / (outputs[i].name + ".png"), outputs[i].size, pictures[i]);
        if (exr)
            next("compressing " + outputs[i].name),
                write_exr(directory / (outputs[i].name + ".exr"), outputs[i].size, numbers[i]);
    }
    return pictures;
}

} // namespace starbow
