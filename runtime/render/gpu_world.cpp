#include "gpu_world.h"
#include "compressed_texture.h"
#include "debug.h"
#include "mip_chain.h"
#include "runtime/light/gloss.h"
#include "runtime/light/srgb.h"
#include "runtime/world/blended.h"
#include "runtime/world/fastest_motion.h"
#include "runtime/world/instances.h"
#include "runtime/world/moving.h"
#include "runtime/world/shadows.h"
#include "runtime/world/shrink.h"
#include "runtime/world/worldline.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <map>
#include <set>

namespace starbow {
namespace {

vk::raii::Sampler make_sampler(const Device& device, const Sampler& s)
{
    auto wrap = [](Wrap w) {
        return w == Wrap::repeat ? vk::SamplerAddressMode::eRepeat
            : w == Wrap::mirror  ? vk::SamplerAddressMode::eMirroredRepeat
                                 : vk::SamplerAddressMode::eClampToEdge;
    };
    auto filter = [](bool linear) { return linear ? vk::Filter::eLinear : vk::Filter::eNearest; };
    vk::SamplerCreateInfo info({}, filter(s.magnify_linear), filter(s.minify_linear),
        s.mip_linear ? vk::SamplerMipmapMode::eLinear : vk::SamplerMipmapMode::eNearest, wrap(s.u), wrap(s.v),
        vk::SamplerAddressMode::eRepeat);
    info.maxLod = s.mipmaps ? VK_LOD_CLAMP_NONE : 0;
    // Surfaces stand at every angle to the eye, so anisotropy helps; in software it takes too long.
    if (s.mipmaps && s.mip_linear && !device.on_processor() && device.physical.getFeatures().samplerAnisotropy) {
        info.anisotropyEnable = true;
        info.maxAnisotropy = std::min(8.0f, device.properties.limits.maxSamplerAnisotropy);
    }
    vk::raii::Sampler made = device.device.createSampler(info);
    name_object(device, made, "world: sampler");
    return made;
}

/// Decoding sRGB in software takes more time than linear fp16 takes memory bandwidth. GPUs decode sRGB at no cost.
Image make_level_0(Device& device, const Texture& texture, MemoryArena& arena)
{
    bool mips = texture.sampler.mipmaps;
    if (texture.numbers)
        return make_texture(
            device, vk::Format::eR8G8B8A8Unorm, texture.size, std::as_bytes(std::span(texture.rgba)), mips, &arena);
    if (!device.on_processor() || (texture.large && device.compresses))
        return make_texture(
            device, vk::Format::eR8G8B8A8Srgb, texture.size, std::as_bytes(std::span(texture.rgba)), mips, &arena);
    std::array<std::uint16_t, 256> linear, alpha;
    for (int i = 0; i < 256; ++i) {
        double x = i / 255.0;
        linear[i] = glm::packHalf1x16(float(light_of_srgb(x)));
        alpha[i] = glm::packHalf1x16(float(x));
    }
    const std::size_t row = 4 * std::size_t(texture.size.x);
    return make_texture(
        device, vk::Format::eR16G16B16A16Sfloat, texture.size, 4 * sizeof(std::uint16_t),
        [&](std::uint32_t, int first, int rows, std::span<std::byte> to) {
            auto* texels = reinterpret_cast<std::uint16_t*>(to.data());
            const std::uint8_t* from = texture.rgba.data() + row * std::size_t(first);
            for (std::size_t i = 0; i < row * std::size_t(rows); ++i)
                texels[i] = (i % 4 == 3 ? alpha : linear)[from[i]];
        },
        mips, &arena);
}

Image make_image_with_levels(Device& device, Pipelines& pipelines, const Texture& texture, MemoryArena& arena)
{
    Image image = make_level_0(device, texture, arena);
    const MipChain chain(device, pipelines, image);
    device.now([&](vk::CommandBuffer commands) { chain.draw_all(commands); });
    return image;
}

/// A texture on the device. A large one is compressed, or where the device does not compress, its sides are halved.
Image make_world_texture(Device& device, Pipelines& pipelines, const Texture& texture, MemoryArena& arena)
{
    if (!texture.large)
        return make_image_with_levels(device, pipelines, texture, arena);
    if (!device.compresses)
        return make_image_with_levels(device, pipelines, halved(texture), arena);
    MemoryArena meanwhile;
    return compressed(device, pipelines, make_image_with_levels(device, pipelines, texture, meanwhile), arena);
}

/// A note for each kind of large image: its size in the file, and as it is drawn.
void note_large_images(const GpuWorld& gpu, World& world)
{
    struct Kind {
        int width, height;
        vk::Extent2D drawn;
        bool compressed;
        auto operator<=>(const Kind&) const = default;
    };
    std::map<Kind, std::set<int>> kinds;
    for (std::size_t i = 0; i < world.textures.size(); ++i)
        if (const auto& large = world.textures[i].large) {
            const Image& drawn = gpu.textures[i];
            const bool compressed = drawn.format == compressed_colours || drawn.format == compressed_numbers;
            kinds[{large->size.x, large->size.y, drawn.extent, compressed}].insert(large->image);
        }
    const auto pixels = [](auto x, auto y) { return std::to_string(x) + " x " + std::to_string(y); };
    for (const auto& [kind, images] : kinds) {
        const bool several = images.size() > 1;
        const std::string first = "image " + std::to_string(*images.begin());
        world.notes.push_back((several ? std::to_string(images.size()) + " images" : first) + " of "
            + pixels(kind.width, kind.height) + " pixels" + (several ? " (" + first + " and others) are" : " is")
            + " drawn with " + pixels(kind.drawn.width, kind.drawn.height) + (kind.compressed ? ", compressed" : "")
            + ": all images together have at most " + std::to_string(LargeImage::all_pixels >> 20)
            + " Mi pixels of four bytes");
    }
}

/// The greatest factor by which a highlight, or a surface near a lamp, may outshine a matt surface at the lamp's distance
/// and still be stored whole. The shader scales brighter light down, all channels alike, so that it keeps its colour.
constexpr double most_highlight = 1024;

/// The greatest light that a surface reflects, over that of a white matt surface that faces the lamp. The peak of GGX's
/// distribution is 1 / (pi alpha^2), and a highlight reflects a quarter of it: metal in its own colour, other surfaces in
/// white, and more at flat angles than at right angles.
double reflected(const Material& material)
{
    const glm::dvec3 base(material.base_colour);
    const double matt = std::max({base.x, base.y, base.z});
    if (!material.gloss)
        return matt;
    const Gloss& gloss = *material.gloss;
    const bool maps = gloss.metallic_roughness.texture >= 0;
    const double alpha = maps ? 0 : gloss.roughness * gloss.roughness, white = std::max(gloss.dielectric, 0.25);
    return matt + std::min(most_highlight, (matt * gloss.metallic + white) / std::max(4 * alpha * alpha, 1e-6));
}

/// The greatest radiance that a surface of this world can send.
double brightest(const World& world, const SceneFile& scene)
{
    const bool near_lamps = std::ranges::any_of(
        scene.lights, [](const Light& lamp) { return !std::holds_alternative<DirectionalLight>(lamp); });
    auto peak = [](const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); };
    double light = peak(scene.ambient);
    for (const Light& lamp : scene.lights)
        light += std::visit([&](const auto& l) { return peak(l.radiance); }, lamp);
    const Sky& sky = scene.sky;
    double most = std::max({light, std::max({peak(sky.zenith), peak(sky.horizon), peak(sky.nadir)}) + scene.milky_way()});
    for (const Material& material : world.materials)
        most = std::max(most,
            peak(glm::dvec3(material.emissive))
                + (near_lamps && !material.unlit ? most_highlight : reflected(material)) * std::max(light, 1.0));
    return most;
}

/// The table of reflected surroundings as an image; white without gloss.
Image make_gloss_table(Device& device, const World& world)
{
    const bool glossy = std::ranges::any_of(world.materials, [](const Material& m) { return m.gloss.has_value(); });
    std::vector<glm::u16vec4> texels;
    for (const GlossTexel& texel : glossy ? gloss_table() : std::vector<GlossTexel>(1))
        texels.push_back(glm::packHalf(glm::vec4(texel.metal, texel.white, texel.above, texel.grazing)));
    return make_texture(device, vk::Format::eR16G16B16A16Sfloat, glm::ivec2(glossy ? GLOSS_TABLE : 1),
        std::as_bytes(std::span(texels)), false);
}

shared::MapEntry map_entry(const Map& map)
{
    return {glm::vec4(map.rotate_scale[0].x, map.rotate_scale[1].x, map.second, map.offset.x),
        glm::vec4(map.rotate_scale[0].y, map.rotate_scale[1].y, 0, map.offset.y)};
}

shared::MaterialEntry material_entry(const Material& material)
{
    const Gloss gloss = material.gloss.value_or(Gloss{});
    return {glm::vec4(gloss.metallic, gloss.roughness, gloss.normal_scale, gloss.occlusion_strength),
        glm::vec4(gloss.dielectric, 0, 0, 0), map_entry(material.emissive_map.value_or(Map{})),
        map_entry(gloss.metallic_roughness), map_entry(gloss.normal), map_entry(gloss.occlusion)};
}

/// A MaterialEntry for each material, and one for the sky.
void put_surfaces(Device& device, GpuWorld& gpu, const World& world)
{
    const vk::DeviceSize step = device.properties.limits.minUniformBufferOffsetAlignment;
    gpu.surface_stride = (sizeof(shared::MaterialEntry) + step - 1) / step * step;
    std::vector<std::byte> bytes(std::size_t(gpu.surface_stride) * (world.materials.size() + 1));
    for (std::size_t i = 0; i < world.materials.size(); ++i) {
        const shared::MaterialEntry entry = material_entry(world.materials[i]);
        std::memcpy(bytes.data() + i * std::size_t(gpu.surface_stride), &entry, sizeof entry);
    }
    gpu.surfaces = make_static_buffer(device, bytes, vk::BufferUsageFlagBits::eUniformBuffer);
    name_object(device, gpu.surfaces, "world: surfaces");
}

/// True for a surface that has a corner of another colour than white.
bool has_colours(const World& world, const Primitive& primitive)
{
    constexpr std::uint32_t white = 0xffffffff;
    return std::ranges::any_of(std::span(world.indices).subspan(primitive.first_index, primitive.index_count),
        [&](std::uint32_t corner) { return world.vertices[corner + std::size_t(primitive.vertex_offset)].colour != white; });
}

/// The descriptors of all materials, and of the sky. A set holds pictures, and the material's maps where it has any.
void put_materials(Device& device, Pipelines& pipelines, GpuWorld& gpu, const World& world)
{
    put_surfaces(device, gpu, world);
    gpu.gloss_table = make_gloss_table(device, world);
    name_object(device, gpu.gloss_table, "world: gloss table");
    gpu.gloss_sampler = make_sampler(device, {.u = Wrap::clamp, .v = Wrap::clamp, .mipmaps = false});
    const auto count = std::uint32_t(world.materials.size()) + 1;
    constexpr std::uint32_t pictures = 6;
    const vk::DescriptorPoolSize sizes[]
        = {{vk::DescriptorType::eCombinedImageSampler, pictures * count}, {vk::DescriptorType::eUniformBuffer, count}};
    gpu.pool = device.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes});
    name_object(device, gpu.pool, "world: descriptor pool");
    const auto picture = [&](int texture) {
        const Sampler kind = texture < 0 ? Sampler{} : world.textures[std::size_t(texture)].sampler;
        auto found = gpu.samplers.find(kind);
        if (found == gpu.samplers.end())
            found = gpu.samplers.emplace(kind, make_sampler(device, kind)).first;
        return vk::DescriptorImageInfo(*found->second, *(texture < 0 ? gpu.white : gpu.textures[std::size_t(texture)]).view,
            vk::ImageLayout::eShaderReadOnlyOptimal);
    };
    std::map<std::array<int, 3>, std::size_t> sets; // by two textures, and the material that has maps of its own
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool sky = i + 1 == count;
        const Material material = sky ? Material{.base_texture = world.milky_way} : world.materials[i];
        const Gloss gloss = material.gloss.value_or(Gloss{});
        const vk::DescriptorImageInfo images[pictures] = {picture(material.base_texture), picture(material.emissive_texture),
            picture(gloss.metallic_roughness.texture), picture(gloss.normal.texture), picture(gloss.occlusion.texture),
            {*gpu.gloss_sampler, *gpu.gloss_table.view, vk::ImageLayout::eShaderReadOnlyOptimal}};
        const vk::DescriptorBufferInfo surface(*gpu.surfaces.buffer, i * gpu.surface_stride, sizeof(shared::MaterialEntry));
        const auto [known, fresh] = sets.try_emplace(
            {material.base_texture, material.emissive_texture, material.mapped() ? int(i) : -1}, gpu.material_sets.size());
        gpu.set_of_material.push_back(known->second);
        gpu.needs_of_set.resize(gpu.material_sets.size() + std::size_t(fresh));
        gpu.needs_of_set[known->second].light |= material.emissive != glm::vec3(0);
        if (!fresh)
            continue;
        const vk::raii::DescriptorSet& set = gpu.material_sets.emplace_back(
            std::move(device.device.allocateDescriptorSets({*gpu.pool, *pipelines.layouts.material_set}).front()));
        name_object(device, set, "world: material");
        std::vector<vk::WriteDescriptorSet> writes;
        for (std::uint32_t k = 0; k < pictures; ++k)
            writes.emplace_back(*set, k, 0, vk::DescriptorType::eCombinedImageSampler, images[k]);
        writes.emplace_back(*set, pictures, 0, vk::DescriptorType::eUniformBuffer, nullptr, surface);
        device.device.updateDescriptorSets(writes, {});
    }
    for (const Primitive& primitive : world.primitives) {
        bool& colours = gpu.needs_of_set[gpu.set_of_material[std::size_t(primitive.material)]].colours;
        colours = colours || has_colours(world, primitive);
    }
}

/// Sixteen bits where the device reads them, else floats.
Image make_shadow_maps(Device& device, int size, std::uint32_t layers, const std::vector<std::uint16_t>& texels)
{
    const auto sampled = device.physical.getFormatProperties(vk::Format::eR16Unorm).optimalTilingFeatures;
    if (sampled & vk::FormatFeatureFlagBits::eSampledImage)
        return make_texture_array(device, vk::Format::eR16Unorm, glm::ivec2(size), layers, std::as_bytes(std::span(texels)));
    std::vector<float> floats;
    for (const std::uint16_t texel : texels)
        floats.push_back(float(texel) / 65535);
    return make_texture_array(device, vk::Format::eR32Sfloat, glm::ivec2(size), layers, std::as_bytes(std::span(floats)));
}

/// The images of a world's shadows; of one texel without.
void put_shadow_images(Device& device, GpuWorld& gpu, const Shadows* from)
{
    const std::vector<std::uint16_t> far_away(1, 0);
    const std::vector<std::uint8_t> open(4, 255);
    const auto layers = std::uint32_t(from ? from->texels.size() / (std::size_t(from->size) * std::size_t(from->size)) : 0);
    gpu.shadow_maps
        = make_shadow_maps(device, layers > 0 ? from->size : 1, std::max(layers, 1u), layers > 0 ? from->texels : far_away);
    name_object(device, gpu.shadow_maps, "world: shadow maps");
    gpu.sky_cells = make_texture_array(device, vk::Format::eR8G8B8A8Unorm, from ? glm::ivec2(from->cells) : glm::ivec2(1),
        from ? 2 * std::uint32_t(from->cells.z) : 1, std::as_bytes(std::span(from ? from->sky : open)));
    name_object(device, gpu.sky_cells, "world: sky cells");
}

/// The maps of the world's shadows; they leave the world.
void put_shadows(Device& device, GpuWorld& gpu, World& world)
{
    gpu.nearest_sampler = make_sampler(
        device, {.u = Wrap::clamp, .v = Wrap::clamp, .magnify_linear = false, .minify_linear = false, .mipmaps = false});
    gpu.sky_sampler = make_sampler(device, {.u = Wrap::clamp, .v = Wrap::clamp, .mipmaps = false});
    try {
        put_shadow_images(device, gpu, world.shadows.get());
    } catch (const NoRoom&) {
        if (!world.shadows)
            throw;
        world.notes.push_back("its shadows have no room on the GPU: it is drawn without them");
        world.shadows = nullptr;
        put_shadow_images(device, gpu, nullptr);
    }
    const Shadows* from = world.shadows.get();
    if (!from)
        return;
    gpu.shadows = 1 << 16;
    for (std::size_t i = 0; i < world.lamps.size(); ++i)
        for (const ShadowMap& map : from->maps)
            if (map.light == world.lamps[i].light)
                gpu.shadows |= 1 << i;
    auto kept = std::make_shared<Shadows>();
    kept->size = from->size, kept->maps = from->maps;
    kept->cells = from->cells, kept->low = from->low, kept->cell = from->cell;
    world.shadows = std::move(kept);
}

} // namespace

SurfaceVariant GpuWorld::variant(int material, StoredLight light) const
{
    const Material& m = world.materials[material];
    SurfaceVariant variant;
    variant.base_texture = m.base_texture >= 0, variant.emissive_texture = m.emissive_texture >= 0;
    const Needs& needs = needs_of_set[set_of_material[std::size_t(material)]];
    variant.emits = needs.light, variant.coloured = needs.colours;
    variant.masked = m.alpha_cutoff > 0;
    variant.unlit = m.unlit, variant.lights = m.unlit ? 0 : int(world.lamps.size());
    variant.point_lamps = m.unlit ? 0 : point_lamps;
    if (light != StoredLight::plain && m.mapped()) {
        variant.mapped = true, variant.matt = !m.gloss;
        variant.roughness_map = m.gloss && m.gloss->metallic_roughness.texture >= 0;
        variant.normal_map = m.gloss && m.gloss->normal.texture >= 0;
        variant.occlusion_map = m.gloss && m.gloss->occlusion.texture >= 0;
    }
    variant.clock = m.clock.has_value();
    variant.blink = m.blink.has_value();
    if (light == StoredLight::plain)
        return variant;
    const auto changes = [](const Lamp& lamp) { return lamp.frame > 0 || lamp.existence >= 0; };
    variant.lamps_move
        = variant.lights > 0 && (several_rest_frames() || std::any_of(world.lamps.begin(), world.lamps.end(), changes));
    const auto has_cone = [](const Light& lamp) {
        const auto* point = std::get_if<PointLight>(&lamp);
        return point && point->cone;
    };
    variant.cones = variant.lights > 0 && std::ranges::any_of(scene.lights, has_cone);
    const Spectra& stored = spectra_of(light);
    variant.coefficients = coefficients(light);
    variant.coefficients.own = int(stored.basis.own.size());
    variant.kinds = stored.kinds, variant.matrices = stored.matrices, variant.unshifted = stored.unshifted;
    return variant;
}

shared::SkyConstants sky_constants(
    const GpuWorld& world, StoredLight light, const glm::dmat3& cube_from_frame, double pre_exposure)
{
    const SceneFile& scene = world.scene;
    const bool plain = light == StoredLight::plain;
    const std::array<glm::dvec3, 6> colours = sky_colours(scene);
    shared::SkyConstants constants{};
    glm::vec4* const to[]{
        constants.zenith, constants.horizon, constants.nadir, constants.red, constants.green, constants.blue};
    const Spectra& stored = world.spectra_of(light);
    for (std::size_t i = 0; i < colours.size(); ++i)
        for (std::size_t group = 0; group < std::size_t(plain ? 1 : stored.groups); ++group)
            to[i][group] = glm::vec4((plain ? glm::dvec4(colours[i], 0) : stored.sky[i][group]) * pre_exposure);
    constants.up = glm::vec4(cube_from_frame * glm::dvec3(0, 1, 0), 0);
    const glm::dvec2 ahead_deg = scene.stars ? scene.stars->ahead_deg : glm::dvec2(0);
    const glm::dmat3 equatorial = glm::transpose(cube_from_frame * world_from_equatorial(ahead_deg));
    constants.equatorial0 = shared::row(equatorial, 0), constants.equatorial1 = shared::row(equatorial, 1),
    constants.equatorial2 = shared::row(equatorial, 2);
    return constants;
}

void put_spectra(Device& device, GpuWorld& world, SpectralLevel level)
{
    world.spectra = spectra_of(world.world, world.scene, level);
    auto constants = [&](const auto& values) {
        return make_static_buffer(device, std::as_bytes(std::span(values)), vk::BufferUsageFlagBits::eUniformBuffer);
    };
    auto columns = [&](std::vector<glm::vec4> all) {
        all.resize(MAX_MATRICES); // the size of the shader's array
        return constants(all);
    };
    world.columns = columns(world.spectra.columns);
    for (auto [observer, buffers] : {std::pair(&eye(), &world.eye), std::pair(&false_colours(), &world.false_colours)}) {
        const Response response = response_of(world.spectra.basis, *observer);
        if (buffers == &world.eye)
            world.unshifted = unshifted(world.spectra, response.unshifted);
        buffers->texels = nullptr;
        buffers->rows = make_static_buffer(
            device, std::as_bytes(std::span(response.rows)), vk::BufferUsageFlagBits::eUniformTexelBuffer);
        name_object(device, buffers->rows, "world: response rows");
        buffers->texels = device.device.createBufferView({{}, *buffers->rows.buffer, words_format, 0, VK_WHOLE_SIZE});
        name_object(device, buffers->texels, "world: response texels");
        buffers->picture = {};
        if (device.draws_as_gpu) {
            const std::vector<glm::u16vec4> picture = picture_of(response);
            buffers->picture = make_texture(
                device, light_format, {RESPONSE_ROWS, response.reflected}, std::as_bytes(std::span(picture)), false);
            name_object(device, buffers->picture, "world: response picture");
        }
        buffers->at_rest = float((0.5 - response.first_log2_D * response.per_octave) / RESPONSE_ROWS);
        buffers->octave = float(response.per_octave / RESPONSE_ROWS);
        buffers->last_log2_D = float(response.first_log2_D + (RESPONSE_ROWS - 1.001) / response.per_octave);
        buffers->own_rows = constants(response.own_rows);
        buffers->greatest = greatest_light(response);
        buffers->black_bodies = constants(black_body_table(*observer));
    }
    world.unshifted_columns = world.unshifted ? columns(world.unshifted->columns) : Buffer{};
}

void put_stars(GpuWorld& world, const std::vector<Star>& stars)
{
    world.stars = world.scene.stars ? star_field(stars, *world.scene.stars, world.scene.unit_m) : StarField{};
}

GpuWorld upload(Device& device, Pipelines& pipelines, World world, const SceneFile& scene, const std::vector<Star>& stars,
    std::optional<SpectralLevel> level)
{
    GpuWorld gpu;
    check_speeds(world, scene);
    place_bodies(world, scene);
    sort_instances(world);
    add_blended_triangles(world);
    gpu.scene = scene, gpu.as_gpu = device.draws_as_gpu;
    gpu.sky_names = sky_names_of(scene);
    gpu.brightest = brightest(world, scene);
    gpu.vertices
        = make_static_buffer(device, std::as_bytes(std::span(world.vertices)), vk::BufferUsageFlagBits::eVertexBuffer);
    gpu.indices = make_static_buffer(device, std::as_bytes(std::span(world.indices)), vk::BufferUsageFlagBits::eIndexBuffer);
    name_object(device, gpu.vertices, "world: vertices");
    name_object(device, gpu.indices, "world: indices");
    if (!world.vertex_maps.empty()) {
        gpu.vertex_maps = make_static_buffer(
            device, std::as_bytes(std::span(world.vertex_maps)), vk::BufferUsageFlagBits::eVertexBuffer);
        name_object(device, gpu.vertex_maps, "world: vertex maps");
    }
    const std::vector<glm::vec4> rigid(1);
    gpu.deforming = make_static_buffer(device, std::as_bytes(std::span(world.deforming.empty() ? rigid : world.deforming)),
        vk::BufferUsageFlagBits::eStorageBuffer);
    name_object(device, gpu.deforming, "world: deforming vertices");
    const std::uint32_t white = 0xffffffff;
    gpu.white = make_texture(device, vk::Format::eR8G8B8A8Unorm, {1, 1}, std::as_bytes(std::span(&white, 1)), false);
    name_object(device, gpu.white, "world: white");
    for (Texture& texture : world.textures) {
        gpu.textures.push_back(make_world_texture(device, pipelines, texture, gpu.texture_memory));
        texture.rgba = {};
    }
    note_large_images(gpu, world);
    put_materials(device, pipelines, gpu, world);
    for (std::size_t i = 0; i < world.lamps.size(); ++i)
        gpu.point_lamps |= std::holds_alternative<PointLight>(scene.lights[world.lamps[i].light]) ? 1 << i : 0;
    put_shadows(device, gpu, world);
    put_stars(gpu, stars);
    if (world.globes)
        gpu.globes = std::make_unique<GpuGlobes>(device, world.globes, scene.globes.value(), scene.seconds_per_time_unit(),
            scene.unit_m, world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0)));
    world.vertices = {}, world.vertex_maps = {}, world.deforming = {}, world.indices = {};
    gpu.world = std::move(world);
    put_spectra(device, gpu, level.value_or(needed_level(gpu.world, scene).level));
    return gpu;
}

} // namespace starbow
