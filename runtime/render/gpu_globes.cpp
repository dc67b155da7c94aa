#include "gpu_globes.h"
#include "config/json/reader.h"
#include "config/model/angles.h"
#include "debug.h"
#include "pipelines.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace starbow {
namespace {

/// A map's channels, four to a texel, 65535 for 1.
using Texels = std::vector<std::uint16_t>;

/// lamps: the map is Globes::sky. Its green, the root of the lamps' light, becomes the light that passes the clouds, because
/// a device's filter takes means: the square of a mean of roots is less than the mean light, 0.44 of it around a single
/// bright texel.
Texels texels_of(const Texture& map, bool lamps)
{
    Texels all(map.rgba.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = std::uint16_t(257 * map.rgba[i]);
    for (std::size_t green = 1; lamps && green < all.size(); green += 4) {
        const unsigned root = map.rgba[green], clear = 255U - map.rgba[green - 1];
        all[green] = std::uint16_t((root * root * clear * 257ULL + 32512) / 65025);
    }
    return all;
}

/// Each texel the mean of four. width: of `from`, texels.
Texels coarser(const Texels& from, std::size_t width)
{
    Texels to(from.size() / 4);
    const std::size_t row = 4 * width;
    auto next = to.begin();
    for (std::size_t above = 0; above < from.size(); above += 2 * row)
        for (std::size_t left = above; left < above + row; left += 8)
            for (std::size_t at = left; at < left + 4; ++at)
                *next++ = std::uint16_t((2U + from[at] + from[at + 4] + from[at + row] + from[at + row + 4]) / 4);
    return to;
}

/// Appends the channels as bytes. lamps: green as 16 bits, its lower 8 in blue, because most lamps have less light than a
/// 255th of the brightest.
void append(std::vector<std::uint8_t>& bytes, const Texels& texels, bool lamps)
{
    const std::size_t begin = bytes.size();
    bytes.resize(begin + texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i)
        bytes[begin + i] = std::uint8_t((texels[i] + 128U) / 257);
    for (std::size_t green = 1; lamps && green < texels.size(); green += 4)
        bytes[begin + green] = std::uint8_t(texels[green] >> 8), bytes[begin + green + 1] = std::uint8_t(texels[green]);
}

/// An array of maps of one size, with coarser levels. second_has_lamps: the second is Globes::sky.
Image make_maps(Device& device, const std::vector<const Texture*>& maps, bool second_has_lamps)
{
    const Texture blank{.size = {2, 1}, .rgba = std::vector<std::uint8_t>(8, 0), .sampler = {}};
    const Texture& first = maps.empty() ? blank : *maps.front();
    const std::uint32_t levels = std::uint32_t(std::lround(std::log2(first.size.y))) + 1;
    Image image = make_image(device,
        {.format = vk::Format::eR8G8B8A8Unorm,
            .extent = {std::uint32_t(first.size.x), std::uint32_t(first.size.y)},
            .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
            .levels = levels,
            .layers = std::max<std::uint32_t>(std::uint32_t(maps.size()), 1),
            .array = true});
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    for (std::uint32_t layer = 0; layer < image.layers; ++layer) {
        std::vector<std::uint8_t> all;
        std::vector<vk::BufferImageCopy> copies;
        const bool lamps = second_has_lamps && layer == 1;
        Texels texels = texels_of(maps.empty() ? blank : *maps[layer], lamps);
        for (glm::uvec2 size(first.size); copies.size() < levels; size /= 2u) {
            if (!copies.empty())
                texels = coarser(texels, 2 * size.x);
            copies.emplace_back(all.size(), 0, 0,
                vk::ImageSubresourceLayers(vk::ImageAspectFlagBits::eColor, std::uint32_t(copies.size()), layer, 1),
                vk::Offset3D(), vk::Extent3D(size.x, size.y, 1));
            append(all, texels, lamps);
        }
        Buffer staging = make_mapped_buffer(device, all.size(), vk::BufferUsageFlagBits::eTransferSrc);
        copy_to(staging, std::as_bytes(std::span(all)));
        device.now([&](vk::CommandBuffer commands) {
            if (layer == 0)
                transition(commands, image, vk::ImageLayout::eUndefined, Stage::eNone, {},
                    vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite);
            commands.copyBufferToImage(*staging.buffer, *image.image, vk::ImageLayout::eTransferDstOptimal, copies);
            if (layer + 1 == image.layers)
                transition(commands, image, vk::ImageLayout::eTransferDstOptimal, Stage::eTransfer, Access::eTransferWrite,
                    vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eVertexShader | Stage::eFragmentShader,
                    Access::eShaderSampledRead);
        });
    }
    return image;
}

vk::raii::Sampler make_sampler(const Device& device, vk::SamplerAddressMode around)
{
    return device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear, around,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, 0, false, 1, false, {}, 0,
        VK_LOD_CLAMP_NONE});
}

static_assert(
    int(Scattering::cloudy) == GLOBE_CLOUDY && int(Scattering::dusty) == GLOBE_DUSTY && int(Scattering::sun) == GLOBE_SUN);

/// How much air still counts: 10 scale heights hold all but 5e-5 of it.
constexpr double scale_heights = 10;

/// The height above a globe's ground up to which light comes from.
double top_m(const Air& air)
{
    double top = scale_heights * air.scale_height_m;
    for (const Glow& glow : air.glows)
        top = std::max(top, glow.to_m);
    return top;
}

static_assert(most_glows == MAX_GLOWS);

/// Steps of D up to 1.1^160, or 4 million, beyond that of any ship.
constexpr double glow_step = 1.1;
constexpr std::size_t glow_steps = 161;

/// The middle of the northern oval, own axes of the Earth; to_sun: unit, the same.
glm::dvec3 oval_middle(const glm::dvec3& to_sun)
{
    const auto [latitude, longitude] = std::pair(geomagnetic_pole_deg.x * degree, geomagnetic_pole_deg.y * degree);
    const glm::dvec3 pole(
        std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude));
    const glm::dvec3 to_midnight = glm::normalize(glm::dot(to_sun, pole) * pole - to_sun);
    return std::cos(oval_from_pole_deg * degree) * pole + std::sin(oval_from_pole_deg * degree) * to_midnight;
}

} // namespace

GpuGlobes::GpuGlobes(Device& device, std::shared_ptr<const Globes> globes, const GlobeSky& sky, double seconds_per_time_unit,
    double unit_m, const glm::dmat3& world_from_equatorial)
    : globes_(std::move(globes))
    , origin_(world_origin(globes_->system, sky))
    , seconds_(seconds_per_time_unit)
    , unit_m_(unit_m)
    , world_from_equatorial_(world_from_equatorial)
    , rows_(globe_rows(globes_->system, globes_->parts, globes_->clouds))
{
    if (globes_->system.globes.size() > MAX_GLOBES)
        throw InputError(one_line(sky.file.string()), "",
            "has " + std::to_string(globes_->system.globes.size()) + " globes; at most " + std::to_string(MAX_GLOBES)
                + " are right");
    for (auto [observer, image, kept] :
        {std::tuple(&eye(), &light, &light_texels_), std::tuple(&false_colours(), &false_light, &false_texels_)}) {
        const std::vector<glm::vec4>& texels = *kept = globe_light(rows_, *observer);
        *image = make_texture(
            device, exact_format, {GLOBE_COLUMNS, int(rows_.spectra.size())}, std::as_bytes(std::span(texels)), false);
        name_object(device, *image, "globes: light");
    }
    upload_maps(device);
    find_brightest_glows();
}

void GpuGlobes::upload_maps(Device& device)
{
    std::vector<const Texture*> plain, fine;
    std::vector<glm::vec2> profile = {glm::vec2(0)};
    for (std::size_t i = 0; i < globes_->system.globes.size(); ++i) {
        const Globe& globe = globes_->system.globes[i];
        const Texture& map = globes_->maps[i];
        layers_.push_back(map.rgba.empty() || globe.air ? -1 : int(plain.size()));
        if (globe.air)
            fine = {&map, &globes_->sky};
        else if (!map.rgba.empty())
            plain.push_back(&map);
        if (globe.ring) {
            profile.clear();
            for (const glm::dvec2& at : globe.ring->profile)
                profile.push_back({float(at.x / GLOBE_DEEPEST_RING), float(at.y)});
        }
    }
    maps = make_maps(device, plain, false), fine_maps = make_maps(device, fine, true);
    name_object(device, maps, "globes: maps"), name_object(device, fine_maps, "globes: fine maps");
    std::vector<std::uint16_t> halves;
    for (const glm::vec2& at : profile)
        for (const float value : {at.x, at.y, 0.0f, 1.0f})
            halves.push_back(glm::packHalf1x16(value));
    rings = make_texture(device, light_format, {int(profile.size()), 1}, std::as_bytes(std::span(halves)), false);
    name_object(device, rings, "globes: ring");
    map_sampler = make_sampler(device, vk::SamplerAddressMode::eRepeat);
    ring_sampler = make_sampler(device, vk::SamplerAddressMode::eClampToEdge);
    name_object(device, map_sampler, "globes: map sampler"), name_object(device, ring_sampler, "globes: ring sampler");
}

GpuGlobes::Seen GpuGlobes::seen(const EyeEvent& eye) const
{
    const glm::dmat3 shorter(1, 0, 0, 0, 1, 0, 0, 0, eye.now ? eye.contraction : 1),
        back = glm::transpose(eye.cube_from_frame);
    return {
        globes_seen(globes_->system, origin_,
            {eye.place, eye.time, world_from_equatorial_, unit_m_, seconds_, eye.now, back * glm::dvec3(0, 0, eye.beta)}),
        shorter * eye.cube_from_frame, back * shorter * eye.cube_from_frame};
}

shared::GlobeConstants GpuGlobes::constants(const Seen& all_seen, double pre_exposure) const
{
    const std::vector<SeenGlobe>& seen = all_seen.globes;
    const glm::dmat3& cube_from_world = all_seen.cube_from_world;
    shared::GlobeConstants all{};
    all.first = glm::vec4(pre_exposure, 0, 0, 0);
    const std::vector<Globe>& globes = globes_->system.globes;
    for (shared::GlobeEntry& entry : all.entries) // those that are not seen
        entry.near = glm::vec4(1e9, 0, 0, 0);
    const auto row_of = [&](const std::string& kind) { return kind.empty() ? -1.0f : float(rows_.first.at(kind)); };
    const glm::dmat3 world_from_cube = glm::inverse(cube_from_world);
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const SeenGlobe& one = seen[k];
        const Globe& globe = globes[one.globe];
        // The last entries, so that those that are not seen come first.
        shared::GlobeEntry& entry = all.entries[globes.size() - seen.size() + k];
        const double radius = globe.radius_m / unit_m_, polar = 1 - globe.flattening;
        const glm::dvec3 from_eye = cube_from_world * one.from_eye;
        const double distance = glm::length(from_eye);
        double reach = radius * (globe.air ? 1 + top_m(*globe.air) / globe.radius_m : 1);
        if (globe.ring)
            reach = globe.ring->outer_m / unit_m_;
        const double angle = reach < distance ? std::asin(reach / distance) : pi;
        entry.near = glm::vec4(from_eye / distance, angle < pi / 2 ? 2 * std::sin(angle / 2) : 4);
        // Rows from the cube map's axes to the globe's own, scaled to a sphere of radius 1.
        glm::dmat3 own = one.own_from_world * world_from_cube;
        const glm::dvec3 scale = glm::dvec3(1, 1, 1 / polar) / radius;
        for (int c = 0; c < 3; ++c)
            own[c] *= scale;
        const glm::dvec3 eye = own * -from_eye;
        entry.row0 = shared::row(own, 0, eye.x), entry.row1 = shared::row(own, 1, eye.y),
        entry.row2 = shared::row(own, 2, eye.z);
        entry.shape = glm::vec4(
            globe.map_scale, polar, radius < distance ? std::asin(radius / distance) : pi / 2, float(int(globe.scattering)));
        const glm::dvec3 sun = one.own_from_world * one.to_sun;
        const double far = one.sun_distance_au;
        entry.light = glm::vec4(sun, far > 0 ? phase_dimming(globe, one.phase_deg) / (far * far) : 0);
        entry.kinds
            = glm::vec4(row_of(globe.kinds[0]), row_of(globe.kinds[1]), row_of(globe.kinds[2]), row_of(globe.kinds[3]));
        const Texture& map = globes_->maps[one.globe];
        entry.map = glm::vec4(layers_[one.globe], map.size.y, row_of("white"), rows_.means[one.globe]);
        if (globe.scattering == Scattering::sun)
            entry.kinds.x = row_of("sun"), entry.light = glm::vec4(0, 0, 1, 1);
        if (globe.air) {
            const double height = globe.air->scale_height_m / globe.radius_m;
            entry.air = glm::vec4(height, scale_heights * height, row_of("air"), row_of("cloud"));
            if (!globe.air->lamp.empty())
                entry.lamps = glm::vec4(row_of(globe.air->lamp), globe.air->brightest_lamps, 0, 0);
            const std::vector<Glow>& glows = globe.air->glows;
            for (std::size_t i = 0; i < glows.size(); ++i) {
                const double inner = 1 + glows[i].from_m / globe.radius_m, outer = 1 + glows[i].to_m / globe.radius_m;
                all.glows[i] = glm::vec4(inner, outer, glows[i].zenith / (outer - inner), row_of(glows[i].light));
                (glows[i].aurora ? all.first.z : all.first.y) += 1;
            }
            if (!glows.empty())
                all.aurora = glm::vec4(oval_middle(sun), all.glows[glows.size() - 1].y);
        }
        if (far > 0)
            entry.lamps.z = float(globe.radius_m / (far * astronomical_unit_m));
        const double suns = far > 0 ? std::asin(std::min(1.0, globes.front().radius_m / (far * astronomical_unit_m))) : 0;
        entry.ring = glm::vec4(0, 0, 0, suns);
        if (globe.ring)
            entry.ring = glm::vec4(
                globe.ring->inner_m / globe.radius_m, globe.ring->outer_m / globe.radius_m, row_of(globe.ring->kind), suns);
        // The Moon and the Earth hide the Sun from each other.
        if (globe.moon || globe.name == "Earth")
            for (const SeenGlobe& other : seen)
                if (other.globe != one.globe
                    && (globe.moon ? globes[other.globe].name == "Earth" : globes[other.globe].moon))
                    entry.shade = glm::vec4(one.own_from_world * (other.from_eye - one.from_eye) / radius,
                        globes[other.globe].radius_m / globe.radius_m);
    }
    return all;
}

void GpuGlobes::find_brightest_glows()
{
    constexpr double most_aurora = 3; // over a full arc, where arcs and rays meet
    for (const Globe& globe : globes_->system.globes)
        for (const Glow& glow : globe.air ? globe.air->glows : std::vector<Glow>()) {
            // Through the layer and out again, past its lower side.
            const double thick = (glow.to_m - glow.from_m) / globe.radius_m, way = 2 * std::sqrt(3 * thick) / thick;
            const double most = glow.zenith * way * (glow.aurora ? most_aurora : 1);
            const int row = rows_.first.at(glow.light);
            brightest_glows_.resize(glow_steps);
            double light = 0;
            for (std::size_t i = 0; i < glow_steps; ++i) {
                const double D = std::pow(glow_step, double(i));
                for (const std::vector<glm::vec4>* texels : {&light_texels_, &false_texels_}) {
                    const glm::dvec3 colour = starbow::globe_colour(*texels, row, D);
                    light = std::max(light, std::max({colour.r, colour.g, colour.b}) * physics::headlight(D));
                }
                brightest_glows_[i] += light * most;
            }
        }
}

double GpuGlobes::brightest_glow(const Seen& all, double E) const
{
    constexpr double farthest_radii = 100; // from there the airglow is 3 seconds of arc wide
    const bool near = std::ranges::any_of(all.globes, [&](const SeenGlobe& one) {
        const Globe& globe = globes_->system.globes[one.globe];
        return globe.air && one.distance * unit_m_ <= farthest_radii * globe.radius_m;
    });
    if (!near || !have_glows())
        return 0;
    const double step = std::ceil(std::log(std::max(E, 1.0)) / std::log(glow_step));
    return brightest_glows_[std::size_t(std::min(step, double(glow_steps - 1)))];
}

void GpuGlobes::as_stars(const Seen& all_seen, std::span<shared::StarEntry> entries) const
{
    const std::vector<SeenGlobe>& seen = all_seen.globes;
    const std::size_t count = globes_->system.globes.size();
    for (std::size_t i = 0; i < count; ++i) {
        entries[i] = {glm::vec4(0, 0, 1, -1 - float(i)), glm::vec4(0)}; // no light
        if (i + seen.size() < count)
            continue;
        const SeenGlobe& one = seen[i + seen.size() - count];
        const Globe& globe = globes_->system.globes[one.globe];
        const double radius = globe.radius_m / unit_m_, part = std::min(radius / one.distance, 1.0),
                     far = one.sun_distance_au;
        const double lit = far > 0 ? phase_part(globe, one.phase_deg) / (far * far) : 1;
        entries[i].direction = glm::vec4(glm::normalize(all_seen.contraction * one.from_eye), -1 - float(i));
        entries[i].light = glm::vec4(lit * pi * part * part * (1 - globe.flattening), std::asin(part), 0, 0);
    }
}

namespace {

/// The part of the Sun's disc that nearer globes leave, from points spread evenly over it. sun: an element of `seen`.
double sun_left(std::span<const SeenGlobe> seen, std::size_t sun, const std::vector<Globe>& globes, double unit_m)
{
    const glm::dvec3 middle = seen[sun].from_eye, way = middle / seen[sun].distance;
    const glm::dvec3 side
        = glm::normalize(glm::cross(way, std::abs(way.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(side, way);
    const double radius = globes[seen[sun].globe].radius_m / unit_m;
    constexpr int points = 61;
    int left = 0;
    for (int i = 0; i < points; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / points), turn = i * 2.399963229728653; // the golden angle
        const glm::dvec3 n = glm::normalize(middle + (side * std::cos(turn) + up * std::sin(turn)) * r);
        const std::span<const SeenGlobe> nearer = seen.subspan(sun + 1);
        left += std::none_of(nearer.begin(), nearer.end(), [&](const SeenGlobe& one) {
            const Globe& globe = globes[one.globe];
            const glm::dvec3 scale = unit_m / globe.radius_m * glm::dvec3(1, 1, 1 / (1 - globe.flattening));
            const glm::dvec3 from = scale * (one.own_from_world * -one.from_eye),
                             to = glm::normalize(scale * (one.own_from_world * n));
            const double ahead = -glm::dot(from, to);
            const glm::dvec3 nearest = from + to * ahead;
            return ahead > 0 && glm::dot(nearest, nearest) < 1;
        });
    }
    return double(left) / points;
}

} // namespace

void GpuGlobes::add_glare(shared::GlobeConstants& constants, const Seen& all, const glm::dmat3& motion_from_world, double E,
    const Effects& on) const
{
    const std::vector<Globe>& globes = globes_->system.globes;
    const auto found = std::find_if(all.globes.begin(), all.globes.end(),
        [&](const SeenGlobe& one) { return globes[one.globe].scattering == Scattering::sun; });
    if (found == all.globes.end())
        return;
    const SeenGlobe& sun = *found;
    const double left = sun_left(all.globes, std::size_t(found - all.globes.begin()), globes, unit_m_);
    if (left == 0)
        return;
    const glm::dvec3 n = motion_from_world * glm::normalize(all.contraction * sun.from_eye);
    const bool galilean = on.comparison == Comparison::galilean;
    physics::AberratedRay sight{n, 1};
    double growth = 1;
    if (on[Effect::aberration]) {
        sight = galilean ? physics::galilean_camera_from_world(n, E, 1 / E) : physics::camera_from_world(n, E, 1 / E);
        growth = sight.D;
        if (galilean) {
            const glm::dvec2 stretch = physics::galilean_stretch(sight.n, E, 1 / E);
            growth = std::sqrt(stretch.x * stretch.y);
        }
    } else
        sight.D = galilean ? physics::galilean_world_from_camera(n, E, 1 / E).D : physics::world_from_camera(n, E, 1 / E).D;
    const glm::dvec3 mean = globe_colour(on[Effect::false_colours] ? false_texels_ : light_texels_, rows_.means[sun.globe],
        on[Effect::doppler] ? sight.D : 1);
    const double part = std::min(globes[sun.globe].radius_m / unit_m_ / sun.distance, 1.0);
    const double factor
        = (on[Effect::headlight] ? physics::headlight(sight.D) : 1) * pi * part * part / (growth * growth) * left;
    constants.sun = glm::vec4(sight.n, std::asin(part) / growth / degree);
    constants.sunlight = glm::vec4(mean * (factor * constants.first.x), 0);
}

} // namespace starbow
