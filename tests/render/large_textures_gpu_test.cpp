// Textures of worlds that have too many pixels: compressed ones beside the pictures that they are made of, as the device
// itself decodes them, and halved ones.
#include "runtime/images/picture_errors.h"
#include "runtime/render/compressed_texture.h"
#include "runtime/render/mip_chain.h"
#include "tests/support/small_world.h"
#include <cstring>
#include <random>

namespace starbow::gpu_test::large_textures_gpu_test {
namespace {

using Texels = std::vector<std::uint8_t>;

/// A level of an image as the device's sampler reads it, in stored values.
Texels texels_of(const Image& image, std::uint32_t level = 0)
{
    const bool colours = image.format == vk::Format::eR8G8B8A8Srgb || image.format == compressed_colours;
    const vk::Extent2D extent(std::max(image.extent.width >> level, 1u), std::max(image.extent.height >> level, 1u));
    const Image target = make_image(device(),
        {.format = colours ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
            .extent = extent,
            .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc});
    const vk::raii::Sampler nearest = device().device.createSampler({});
    const vk::raii::ImageView view = device().device.createImageView(
        {{}, *image.image, vk::ImageViewType::e2D, image.format, {}, {vk::ImageAspectFlagBits::eColor, level, 1, 0, 1}});
    const vk::DescriptorPoolSize sizes(vk::DescriptorType::eCombinedImageSampler, 2);
    const vk::raii::DescriptorPool pool
        = device().device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    const vk::raii::DescriptorSet set
        = std::move(device().device.allocateDescriptorSets({*pool, *pipelines().layouts.picture_set}).front());
    const vk::DescriptorImageInfo read(*nearest, *view, vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::DescriptorImageInfo images[] = {read, read};
    device().device.updateDescriptorSets(
        vk::WriteDescriptorSet(*set, 0, 0, vk::DescriptorType::eCombinedImageSampler, images), {});
    device().now([&](vk::CommandBuffer commands) {
        using Stage = vk::PipelineStageFlagBits2;
        using Access = vk::AccessFlagBits2;
        transition(commands, target, vk::ImageLayout::eUndefined, Stage::eNone, {}, vk::ImageLayout::eColorAttachmentOptimal,
            Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite);
        const vk::RenderingAttachmentInfo colour(*target.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
        device().begin_rendering(commands, {{}, {{0, 0}, extent}, 1, 0, colour});
        set_area(commands, {0, 0}, {int(extent.width), int(extent.height)});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines().scaled(target.format));
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines().layouts.picture_layout, 0, *set, {});
        shared::ViewPush push{};
        push.zenith = glm::vec4(0, 0, extent.width, extent.height);
        commands.pushConstants<shared::ViewPush>(
            *pipelines().layouts.picture_layout, vk::ShaderStageFlagBits::eFragment, 0, push);
        commands.draw(3, 1, 0, 0);
        device().end_rendering(commands);
        transition(commands, target, vk::ImageLayout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentWrite, vk::ImageLayout::eTransferSrcOptimal, Stage::eTransfer, Access::eTransferRead);
    });
    const std::vector<std::byte> bytes = read_back(device(), target, 4);
    Texels texels(bytes.size());
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
}

/// A picture on the device with its levels, exact.
Image exact(ivec2 size, const Texels& rgba, bool numbers)
{
    Image image = make_texture(device(), numbers ? vk::Format::eR8G8B8A8Unorm : vk::Format::eR8G8B8A8Srgb, size,
        std::as_bytes(std::span(rgba)), true);
    const MipChain chain(device(), pipelines(), image);
    device().now([&](vk::CommandBuffer commands) { chain.draw_all(commands); });
    return image;
}

struct Difference {
    double dB = 0; ///< of 255
    double mean = 0; ///< of 255, signed
    int greatest = 0, greatest_alpha = 0;
};

Difference difference(const Texels& a, const Texels& b)
{
    EXPECT_EQ(a.size(), b.size());
    Difference out;
    double sum = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const int signed_off = int(a[i]) - int(b[i]), off = std::abs(signed_off);
        sum += off * off, out.mean += signed_off / double(a.size());
        int& greatest = i % 4 == 3 ? out.greatest_alpha : out.greatest;
        greatest = std::max(greatest, off);
    }
    out.dB = 10 * std::log10(255.0 * 255.0 * double(a.size()) / std::max(sum, 1e-9));
    return out;
}

template <typename Value> Texels painted(ivec2 size, const Value& value)
{
    Texels out;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec4 at = value(x, y);
            for (int c = 0; c < 4; ++c)
                out.push_back(std::uint8_t(std::lround(std::clamp(at[c], 0.0, 1.0) * 255)));
        }
    return out;
}

/// Weathered bricks: two colours that a line joins, with grain in brightness and a little in hue.
Texels bricks(ivec2 size)
{
    std::mt19937 random(7);
    std::normal_distribution<double> grain(0, 0.03);
    return painted(size, [&](int x, int y) {
        const bool mortar = y % 24 < 3 || (x + y / 24 * 20) % 40 < 3;
        const dvec3 colour = mortar ? dvec3(0.6, 0.58, 0.52) : dvec3(0.5 + 0.1 * std::sin(x / 40), 0.22, 0.15);
        const double light = grain(random);
        return glm::dvec4(colour + light + 0.2 * dvec3(grain(random), grain(random), grain(random)), 1);
    });
}

/// The normals of waves.
Texels waves(ivec2 size)
{
    return painted(size, [](int x, int y) {
        const dvec3 normal = glm::normalize(
            dvec3(0.3 * std::sin(x * 0.2 + 0.1 * y), 0.2 * std::cos(y * 0.3) + 0.1 * std::sin(x * 0.05), 1));
        return glm::dvec4(0.5 + 0.5 * normal, 1);
    });
}

/// Leaves with gaps.
Texels leaves(ivec2 size)
{
    return painted(size, [](int x, int y) {
        const double cover = std::clamp(1.5 + 3 * std::sin(x * 0.11) * std::cos(y * 0.13), 0.0, 1.0);
        return glm::dvec4(0.1 + 0.1 * std::sin(x * 0.5), 0.4 + 0.1 * std::cos(y * 0.4), 0.08, cover);
    });
}

} // namespace

TEST(LargeTextures, CompressedOnesAreNearlyTheirPictures)
{
    struct Case {
        const char* name;
        ivec2 size;
        Texels (*paint)(ivec2);
        bool numbers;
        double dB, dB_coarser; ///< a block has one line through its colours: what is bent or noisy lies beside it
    };
    const Case cases[] = {{"bricks", {256, 192}, bricks, false, 42, 37}, {"waves", {256, 192}, waves, true, 41, 30},
        {"leaves", {256, 192}, leaves, false, 35, 27}, {"no whole blocks", {37, 21}, bricks, false, 38, 36},
        {"smaller than a block", {3, 1}, bricks, false, 36, 36}};
    for (const Case& c : cases) {
        MemoryArena arena;
        const Image whole = exact(c.size, c.paint(c.size), c.numbers),
                    small = compressed(device(), pipelines(), whole, arena);
        ASSERT_EQ(small.levels, whole.levels);
        if (c.size.x > 200) {
            EXPECT_LT(double(small.bytes), double(whole.bytes) / 3.8) << c.name;
        }
        for (std::uint32_t level = 0; level < whole.levels; ++level) {
            const Texels wanted = texels_of(whole, level), seen = texels_of(small, level);
            const Difference off = difference(seen, wanted);
            EXPECT_GT(off.dB, level == 0 ? c.dB : c.dB_coarser) << c.name << ", level " << level;
            EXPECT_LT(std::abs(off.mean), 0.6) << c.name << ", level " << level << ": the mean light stays";
            const bool opaque = c.paint != leaves;
            EXPECT_TRUE(!opaque || off.greatest_alpha == 0) << c.name << ", level " << level;
        }
    }
}

TEST(LargeTextures, OneColourIsKept)
{
    // Ends are odd where a block is opaque, so that a colour is off by at most one.
    for (const glm::dvec4& colour :
        {glm::dvec4(0, 0, 0, 1), {1, 1, 1, 1}, {0.5, 0.2, 0.7, 1}, {0.3, 0.9, 0.1, 0}, {0, 0, 0, 0.4}}) {
        const ivec2 size(16, 16);
        MemoryArena arena;
        const Image whole = exact(size, painted(size, [&](int, int) { return colour; }), true);
        const Difference off = difference(texels_of(compressed(device(), pipelines(), whole, arena)), texels_of(whole));
        EXPECT_LE(off.greatest, 1);
        EXPECT_LE(off.greatest_alpha, colour.a == 1 ? 0 : 1);
    }
}

namespace {

/// A wall of bricks with a relief, and leaves before it. Large: with images as if they were too many.
LoadedScene wall(const std::string& name, bool large)
{
    const ivec2 size(256, 192);
    Doc doc;
    const auto texture = [&](const Texels& rgba) {
        const std::string file = "data:image/png;base64," + gltf_test::base64(gltf_test::png(size.x, size.y, rgba));
        const int image = doc.put("images", {{"uri", file}});
        return Json{{"index", doc.put("textures", {{"source", image}})}};
    };
    const int stone = doc.put("materials",
        {{"pbrMetallicRoughness",
             {{"baseColorTexture", texture(bricks(size))}, {"metallicFactor", 0}, {"roughnessFactor", 0.4}}},
            {"normalTexture", texture(waves(size))}});
    quad(doc, {0, 0, -3}, {2, 0, 0}, {0, 1.5, 0}, stone);
    const int plant = doc.put("materials",
        {{"pbrMetallicRoughness", {{"baseColorTexture", texture(leaves(size))}, {"metallicFactor", 0}}},
            {"alphaMode", "MASK"}});
    quad(doc, {0, -0.5, -2.5}, {1, 0, 0}, {0, 0.5, 0}, plant);
    testing::write_text(name + ".gltf", doc.text());
    const Json scene = {{"gltf", name + ".gltf"}, {"unit_m", 1}, {"ambient", {0.4, 0.4, 0.4}},
        {"lights", {{{"type", "directional"}, {"towards", {0.3, 0.5, 1}}, {"radiance", {0.6, 0.6, 0.6}}}}}};
    SceneFile file = load_scene_file(testing::write_text(name + ".json", scene.dump()));
    World world = load_world(file);
    for (std::size_t i = 0; large && i < world.textures.size(); ++i)
        world.textures[i].large = {int(i), size};
    return {std::move(file), std::move(world), {}};
}

/// The device compresses large textures, or not, as long as this object lives.
struct Compressing {
    explicit Compressing(bool on) { device().compresses = on; }
    ~Compressing() { device().compresses = before; }
    bool before = device().compresses;
};

} // namespace

TEST(LargeTextures, WorldsShowThem)
{
    const Layout layout = one_view(Planar{.fov_y_deg = 45}, {320, 240});
    const Shot shots[] = {shot_at({0, 0, 0}, {0, 0, 0}), shot_at({0, 0, -1}, {0, 0, 0}),
        shot_at({0, 0, 0}, {0, 0, -u_of_beta(0.5)}, {0, 0, -1})};
    const auto pictures = [&](const GpuWorld& world) {
        OffscreenRenderer live = renderer(world, layout, false);
        std::vector<std::vector<std::uint8_t>> made;
        for (const Shot& shot : shots)
            made.push_back(live.picture(shot)[0]);
        return made;
    };
    const GpuWorld exact = upload_scene(avenue(), wall("exact", false));
    EXPECT_TRUE(exact.world.notes.empty());
    const auto wanted = pictures(exact);
    for (const bool on : {true, false}) {
        if (on && !device().physical.getFeatures().textureCompressionBC)
            continue;
        const Compressing compressing(on);
        const GpuWorld world = upload_scene(avenue(), wall("large", true));
        EXPECT_EQ(world.world.notes,
            std::vector<std::string>{std::string("3 images of 256 x 192 pixels (image 0 and others) are drawn with ")
                + (on ? "256 x 192, compressed" : "128 x 96")
                + ": all images together have at most 40 Mi pixels of four bytes"});
        for (const Image& image : world.textures)
            EXPECT_EQ(image.extent, (on ? vk::Extent2D(256, 192) : vk::Extent2D(128, 96)));
        const auto seen = pictures(world);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double dB = psnr_dB({layout.outputs[0].size, seen[i]}, {layout.outputs[0].size, wanted[i]});
            EXPECT_GT(dB, on ? 36 : 30) << i;
        }
    }
}

} // namespace starbow::gpu_test::large_textures_gpu_test
