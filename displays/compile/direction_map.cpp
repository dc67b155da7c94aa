#include "direction_map.h"
#include "config/model/turn.h"
#include "rows.h"
#include <algorithm>
#include <bit>
#include <cmath>

namespace starbow {
namespace {

void unwarped_rows(const View& view, DirectionMap& map, int first, int end)
{
    const double squeeze = std::sqrt(view.picture_from_pixel.x * view.picture_from_pixel.y);
    const PictureRays rays(view.picture);
    for (int channel = 0; channel < map.channels; ++channel)
        for (int y = first; y < end; ++y)
            for (int x = 0; x < map.size.x; ++x) {
                const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) * view.picture_from_pixel;
                const Channel colour = map.channels == 3 ? Channel(channel) : Channel::green;
                if (auto seen = rays.direction(at, colour))
                    map.texels[(std::size_t(channel) * map.size.y + y) * map.size.x + x]
                        = glm::vec4(*seen, std::max(rays.pixel_angle(at, colour) * squeeze, 1e-12));
            }
}

struct Warped {
    const WarpMesh& mesh;
    const WarpRaster& raster;
    const Picture& source;
    const PictureRays rays;
    glm::dmat3 turn;

    void rows(DirectionMap& map, int first, int end) const
    {
        std::vector<WarpSample> samples(map.size.x);
        for (int y = first; y < end; ++y) {
            raster.row(y, samples);
            for (int x = 0; x < map.size.x; ++x) {
                if (!samples[x].shown)
                    continue;
                const std::size_t at = std::size_t(y) * map.size.x + x;
                map.intensity[at] = float(samples[x].intensity);
                for (int channel = 0; channel < map.channels; ++channel)
                    if (auto seen = warped_direction(mesh, source, rays, turn, samples[x], channel))
                        map.texels[std::size_t(channel) * map.size.x * map.size.y + at] = glm::vec4(*seen, 1);
            }
        }
    }
};

/// The picture's step at a pixel along x or y, from its neighbours that show something; 0 without any.
glm::vec3 step(const DirectionMap& map, int x, int y, int channel, glm::ivec2 way)
{
    const glm::vec4& here = map.at(x, y, channel);
    glm::vec3 sum(0);
    int count = 0;
    for (int sign : {-1, 1}) {
        const glm::ivec2 p = glm::ivec2(x, y) + sign * way;
        if (p.x < 0 || p.y < 0 || p.x >= map.size.x || p.y >= map.size.y)
            continue;
        if (const glm::vec4& there = map.at(p.x, p.y, channel); there.w > 0)
            sum += float(sign) * (glm::vec3(there) - glm::vec3(here)), ++count;
    }
    return count > 0 ? sum / float(count) : sum;
}

/// Computes pixel angles. warped: the angle is not known yet; otherwise it is only compared, because of slivers.
void angle_rows(DirectionMap& map, std::vector<float>& angles, bool warped, int channel, int first, int end)
{
    for (int y = first; y < end; ++y)
        for (int x = 0; x < map.size.x; ++x) {
            const float known = map.at(x, y, channel).w;
            if (known == 0)
                continue;
            const glm::vec3 across = step(map, x, y, channel, {1, 0}), down = step(map, x, y, channel, {0, 1});
            const float longest = std::max(glm::length(across), glm::length(down));
            // An isolated warped pixel gets an angle as large as the sky, so that it demands nothing.
            const float own = !warped ? known : longest > 0 ? std::sqrt(glm::length(glm::cross(across, down))) : 1;
            angles[std::size_t(y) * map.size.x + x] = std::max(own, 0.5f * longest);
        }
}

/// The rotation of a measured headset's directions.
glm::dmat3 turn_of(const Projection& projection)
{
    if (auto* planar = std::get_if<Planar>(&projection))
        return cockpit_from_picture(planar->turn);
    if (auto* lens = std::get_if<Lens>(&projection))
        return cockpit_from_picture(lens->turn);
    return glm::dmat3(1);
}

glm::uvec2 packed(const glm::vec4& texel)
{
    const glm::dvec3 n(texel);
    glm::dvec2 at = glm::dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z < 0)
        at = {std::copysign(1 - std::abs(at.y), at.x), std::copysign(1 - std::abs(at.x), at.y)};
    const glm::uvec2 net(at * double(0x7fffff) + (0x800000 + 0.5));
    // The angle is rounded to its upper 16 bits, which are never 0.
    const std::uint32_t angle = (std::bit_cast<std::uint32_t>(texel.w) + 0x8000u) >> 16;
    return {net.x << 8 | (angle & 0xff), net.y << 8 | angle >> 8};
}

} // namespace

std::optional<glm::dvec3> warped_direction(const WarpMesh& mesh, const Picture& source, const PictureRays& rays,
    const glm::dmat3& turn, const WarpSample& sample, int channel)
{
    if (!sample.shown)
        return {};
    switch (mesh.kind) {
    case WarpMesh::Kind::picture:
        return rays.direction(glm::dvec2(sample.sees[0]) * glm::dvec2(source.size),
            splits_colours(source.projection) ? Channel(channel) : Channel::green);
    case WarpMesh::Kind::points: {
        const glm::dvec3 way = sample.sees[0] - source.eye_m;
        return glm::length(way) > 0 ? std::optional(glm::normalize(way)) : std::nullopt;
    }
    case WarpMesh::Kind::colours:
        return turn * glm::normalize(sample.sees[std::size_t(channel)]);
    }
    return {};
}

Picture warped_picture(const View& view, const WarpMesh& mesh, bool projection_given)
{
    Picture picture = view.picture;
    if (!projection_given && mesh.frustum)
        picture.projection = *mesh.frustum;
    if (!mesh.of_viewport && std::holds_alternative<Fisheye>(picture.projection))
        picture.size = glm::ivec2(std::min(picture.size.x, picture.size.y));
    return picture;
}

std::optional<glm::dmat3> view_matrix(const View& view)
{
    std::optional<glm::dmat3> m = planar_matrix(view.picture);
    if (m) {
        (*m)[0] *= view.picture_from_pixel.x;
        (*m)[1] *= view.picture_from_pixel.y;
    }
    return m;
}

void pack_rows(const DirectionMap& map, int channel, int first_row, int rows, std::span<glm::uvec2> to)
{
    const glm::vec4* from = &map.at(0, first_row, channel);
    by_rows(rows, [&](int first, int end) {
        for (std::size_t i = std::size_t(first) * map.size.x; i < std::size_t(end) * map.size.x; ++i)
            to[i] = from[i].w > 0 ? packed(from[i]) : glm::uvec2(0);
    });
}

DirectionMap compile_direction_map(const View& view, const WarpMesh* mesh)
{
    DirectionMap map;
    map.size = view.size;
    const Picture source = mesh ? warped_picture(view, *mesh, view.projection_given) : view.picture;
    map.channels = splits_colours(source.projection) || (mesh && mesh->kind == WarpMesh::Kind::colours) ? 3 : 1;
    const std::size_t pixels = std::size_t(map.size.x) * map.size.y;
    map.texels.assign(pixels * map.channels, glm::vec4(0));
    if (mesh) {
        map.intensity.assign(pixels, 0.0f);
        const WarpRaster raster(*mesh, map.size);
        const Warped warped{*mesh, raster, source, PictureRays(source), turn_of(source.projection)};
        by_rows(map.size.y, [&](int first, int end) { warped.rows(map, first, end); });
        if (std::all_of(map.intensity.begin(), map.intensity.end(), [](float i) { return i == 1; }))
            map.intensity.clear();
    } else {
        by_rows(map.size.y, [&](int first, int end) { unwarped_rows(view, map, first, end); });
    }
    std::vector<float> angles(pixels);
    for (int channel = 0; channel < map.channels; ++channel) {
        by_rows(map.size.y, [&](int first, int end) { angle_rows(map, angles, mesh, channel, first, end); });
        glm::vec4* texels = map.texels.data() + pixels * channel;
        for (std::size_t i = 0; i < pixels; ++i)
            if (texels[i].w > 0)
                texels[i].w = angles[i];
    }
    return map;
}

} // namespace starbow
