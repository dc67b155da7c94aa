#include "cube_target.h"
#include "debug.h"
#include <algorithm>
#include <bit>

namespace starbow {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

/// The star pass reads the atlases in its vertex shader: where things move, they may cover a star.
constexpr auto readers = Stage::eVertexShader | Stage::eFragmentShader;
constexpr auto depth_tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;

vk::SampleCountFlagBits sample_bits(int samples)
{
    return samples >= 8 ? vk::SampleCountFlagBits::e8
        : samples >= 4  ? vk::SampleCountFlagBits::e4
        : samples >= 2  ? vk::SampleCountFlagBits::e2
                        : vk::SampleCountFlagBits::e1;
}

constexpr auto depth_access = Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite;

} // namespace

CubeTarget::CubeTarget(Device& device, Pipelines& pipelines, const GpuWorld& world, const Quality& quality, bool keeps_depth)
    : device_(device)
    , pipelines_(pipelines)
    , formats_(world.coefficients(StoredLight::coefficients).formats(quality.half_floats))
    , samples_(quality.cube_samples)
    , in_several_rest_frames_(world.several_rest_frames())
    , keeps_depth_(keeps_depth)
{
    formats_.push_back(vk::Format::eR32G32Sfloat); // the coverage; near / distance is small
    atlases_.resize(kind({in_several_rest_frames_}).colours.size());
}

bool CubeTarget::uses(Use use, std::size_t atlas) const
{
    const bool coverage = atlas + 1 == formats_.size();
    return coverage ? use.several_rest_frames : atlas == 0 || use.light == StoredLight::coefficients;
}

TargetKind CubeTarget::kind(Use use) const
{
    TargetKind kind{{}, sample_bits(samples_)};
    for (std::size_t atlas = 0; atlas < formats_.size(); ++atlas)
        if (uses(use, atlas))
            kind.colours.push_back(formats_[atlas]);
    return kind;
}

void CubeTarget::release()
{
    chains_.clear();
    for (Image& atlas : atlases_)
        atlas = {};
    depth_ = {}, atlas_samples_.clear(), depth_samples_ = {};
}

void CubeTarget::fit(glm::ivec2 size, int levels)
{
    const Image& first = atlases_[0];
    // A plan is empty where no view shows anything; the texture exists all the same. No side is a power of two: llvmpipe
    // compiles each shader that reads a texture once for such sides and once for others, and a growing atlas would meet
    // both.
    const auto grown = [&](int needed, std::uint32_t had) {
        std::uint32_t whole = (std::uint32_t(std::max(needed, 1)) + 255) / 256 * 256;
        if (std::has_single_bit(whole))
            whole += 64;
        return repeatable_ ? whole : std::max(whole, had);
    };
    const vk::Extent2D extent(grown(size.x, first.extent.width), grown(size.y, first.extent.height));
    if (*first.view && first.extent == extent && int(first.levels) >= levels)
        return;
    auto most = std::max(std::uint32_t(levels), first.levels);
    using Usage = vk::ImageUsageFlagBits;
    release();
    Formats formats = kind({in_several_rest_frames_}).colours;
    for (std::size_t i = 0; i < atlases_.size(); ++i) {
        atlases_[i] = make_image(device_, {formats[i], extent, Usage::eColorAttachment | Usage::eSampled, most});
        name_object(device_, atlases_[i], "cube pass: atlas");
    }
    for (std::size_t i = 0; most > 1 && i < atlases_.size(); ++i)
        chains_.push_back(std::make_unique<MipChain>(device_, pipelines_, atlases_[i]));
    depth_ = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment | Usage::eSampled});
    name_object(device_, depth_, "cube pass: depth");
    if (samples_ > 1) {
        vk::SampleCountFlagBits samples = sample_bits(samples_);
        for (vk::Format format : formats)
            name_object(device_,
                atlas_samples_.emplace_back(make_image(device_, {format, extent, Usage::eColorAttachment, 1, 1, samples})),
                "cube pass: atlas samples");
        depth_samples_ = make_image(device_, {depth_format, extent, Usage::eDepthStencilAttachment, 1, 1, samples});
        name_object(device_, depth_samples_, "cube pass: depth samples");
    }
}

void CubeTarget::fit_depth(glm::ivec2 size)
{
    if (int(depth_.extent.width) >= size.x && int(depth_.extent.height) >= size.y)
        return;
    depth_ = make_image(device_,
        {depth_format, {std::uint32_t(size.x), std::uint32_t(size.y)}, vk::ImageUsageFlagBits::eDepthStencilAttachment});
    name_object(device_, depth_, "cube pass: depth");
}

void CubeTarget::begin(
    vk::CommandBuffer commands, Use use, glm::ivec2 area, std::span<const glm::vec4> clear, std::uint32_t scenes)
{
    const bool sampled = samples_ > 1;
    const Image& depth = sampled ? depth_samples_ : depth_;
    transition(commands, depth_, vk::ImageLayout::eUndefined,
        depth_tests | Stage::eVertexShader | Stage::eFragmentShader | Stage::eColorAttachmentOutput, depth_access,
        vk::ImageLayout::eDepthAttachmentOptimal, depth_tests | Stage::eColorAttachmentOutput,
        depth_access | Access::eColorAttachmentWrite);
    if (sampled)
        transition(commands, depth, vk::ImageLayout::eUndefined, depth_tests, depth_access,
            vk::ImageLayout::eDepthAttachmentOptimal, depth_tests, depth_access);
    std::array<vk::RenderingAttachmentInfo, MAX_GROUPS + 1> colours;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < atlases_.size(); ++i) {
        if (!uses(use, i))
            continue;
        transition(commands, atlases_[i], vk::ImageLayout::eUndefined, readers, {}, vk::ImageLayout::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
        if (sampled)
            transition(commands, atlas_samples_[i], vk::ImageLayout::eUndefined, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite | Access::eColorAttachmentRead);
        const glm::vec4& c = clear[count];
        const vk::ClearColorValue clear_value(std::array<float, 4>{c.x, c.y, c.z, c.w});
        vk::RenderingAttachmentInfo& colour = colours[count++];
        colour = {*(sampled ? atlas_samples_ : atlases_)[i].view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eClear, sampled ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore,
            clear_value};
        if (sampled) {
            colour.resolveMode = vk::ResolveModeFlagBits::eAverage;
            colour.resolveImageView = *atlases_[i].view;
            colour.resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal;
        }
    }
    vk::RenderingAttachmentInfo depth_info(*depth.view, vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear,
        keeps_depth_ && !sampled ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
        vk::ClearDepthStencilValue(0, 0));
    if (sampled && keeps_depth_) {
        depth_info.resolveMode = vk::ResolveModeFlagBits::eSampleZero;
        depth_info.resolveImageView = *depth_.view;
        depth_info.resolveImageLayout = vk::ImageLayout::eDepthAttachmentOptimal;
    }
    device_.begin_rendering(commands, {{}, rect_of({0, 0}, area), 1, 0, count, colours.data(), &depth_info}, scenes);
}

void CubeTarget::begin_plain(vk::CommandBuffer commands, const Target& target, const glm::vec4& clear)
{
    transition(commands, depth_, vk::ImageLayout::eUndefined, depth_tests, Access::eDepthStencilAttachmentWrite,
        vk::ImageLayout::eDepthAttachmentOptimal, depth_tests,
        Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    vk::RenderingAttachmentInfo colour(target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
        vk::ClearColorValue(std::array<float, 4>{clear.r, clear.g, clear.b, clear.a}));
    vk::RenderingAttachmentInfo depth(*depth_.view, vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
        vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare, vk::ClearDepthStencilValue(0, 0));
    device_.begin_rendering(commands, {{}, {{0, 0}, target.extent}, 1, 0, colour, &depth});
}

void CubeTarget::end(vk::CommandBuffer commands, Use use, std::span<const PlannedImage> images, int levels)
{
    device_.end_rendering(commands);
    for (std::size_t i = 0; i < atlases_.size(); ++i)
        if (uses(use, i))
            transition(commands, atlases_[i], vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal, readers, Access::eShaderSampledRead);
    // One level more than the plan needs. At its coarsest level an image is sampled together with the next level at
    // weight 0, and 0 times unwritten memory may be NaN.
    const std::uint32_t drawn = std::min(std::uint32_t(levels) + 1, atlases_.front().levels);
    for (std::size_t i = 0; levels > 1 && i < atlases_.size(); ++i)
        if (uses(use, i))
            make_mips(commands, *chains_[i], images, drawn);
    if (keeps_depth_)
        transition(commands, depth_, vk::ImageLayout::eDepthAttachmentOptimal, depth_tests | Stage::eColorAttachmentOutput,
            depth_access | Access::eColorAttachmentWrite, vk::ImageLayout::eShaderReadOnlyOptimal,
            Stage::eVertexShader | Stage::eFragmentShader, Access::eShaderSampledRead);
}

void CubeTarget::make_mips(
    vk::CommandBuffer commands, const MipChain& chain, std::span<const PlannedImage> images, std::uint32_t levels)
{
    for (std::uint32_t level = 1; level < levels; ++level) {
        chain.begin(commands, level);
        for (const PlannedImage& image : images) {
            if (image.needed && image.levels >= int(level)) {
                const glm::ivec2 low = image.atlas >> glm::ivec2(level),
                                 high = (image.atlas + image.size) >> glm::ivec2(level);
                chain.halve(commands, low, high - low);
            }
        }
        chain.end(commands);
    }
}

vk::DeviceSize CubeTarget::memory() const
{
    vk::DeviceSize bytes = depth_.bytes + depth_samples_.bytes;
    for (const auto* images : {&atlases_, &atlas_samples_})
        for (const Image& image : *images)
            bytes += image.bytes;
    return bytes;
}

} // namespace starbow
