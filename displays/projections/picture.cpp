#include "picture.h"
#include "planar.h"
#include "wall.h"

namespace starbow {
namespace {

bool operator==(const Lens::Colour& a, const Lens::Colour& b) { return a.centre == b.centre && a.k == b.k; }

/// All projections but the lens are the same for all channels.
template <typename Rays> const Rays& of(const Rays& rays, Channel) { return rays; }
const LensRays& of(const std::array<LensRays, 3>& lenses, Channel channel) { return lenses[std::size_t(channel)]; }

template <typename... Cases> struct Match : Cases... {
    using Cases::operator()...;
};
template <typename... Cases> Match(Cases...) -> Match<Cases...>; // clang 16 does not deduce it

} // namespace

PictureRays::PictureRays(const Picture& picture)
    : rays_(prepare(picture))
{
}

PictureRays::Rays PictureRays::prepare(const Picture& picture)
{
    const glm::ivec2 size = picture.size;
    return std::visit(
        Match{
            [&](const Planar& planar) -> Rays { return planar_plane(planar, size); },
            [&](const Wall& wall) -> Rays {
                if (wall.upper_right_m) {
                    if (const auto keystone = wall_keystone(wall, size, picture.eye_m))
                        return *keystone;
                } else if (const auto plane = wall_plane(wall, size, picture.eye_m)) {
                    return *plane;
                }
                return Nothing{};
            },
            [&](const Fisheye& fisheye) -> Rays { return FisheyeRays(fisheye, size); },
            [&](const Cylinder& cylinder) -> Rays { return CylinderRays(cylinder, size); },
            [&](const Equirectangular& equirectangular) -> Rays { return EquirectangularRays(equirectangular, size); },
            [&](const CubeFaces& cube) -> Rays { return CubeFaceRays(cube, size); },
            [&](const SphericalMirror& mirror) -> Rays { return SphericalMirrorRays(mirror, size, picture.eye_m); },
            [&](const Lens& lens) -> Rays {
                return Lenses{LensRays(lens, size, 0), LensRays(lens, size, 1), LensRays(lens, size, 2)};
            },
        },
        picture.projection);
}

std::optional<glm::dvec3> PictureRays::direction(glm::dvec2 pixel, Channel channel) const
{
    return std::visit([&](const auto& rays) { return of(rays, channel).direction(pixel); }, rays_);
}

std::optional<glm::dvec2> PictureRays::pixel(const glm::dvec3& direction, Channel channel) const
{
    return std::visit([&](const auto& rays) { return of(rays, channel).pixel(direction); }, rays_);
}

double PictureRays::pixel_angle(glm::dvec2 pixel, Channel channel) const
{
    return std::visit([&](const auto& rays) { return of(rays, channel).pixel_angle(pixel); }, rays_);
}

std::optional<glm::dmat3> PictureRays::planar_matrix() const
{
    if (const Plane* plane = std::get_if<Plane>(&rays_))
        return plane->matrix();
    if (const Keystone* keystone = std::get_if<Keystone>(&rays_))
        return keystone->matrix();
    return {};
}

std::optional<glm::dvec3> direction(const Picture& picture, glm::dvec2 pixel, Channel channel)
{
    return PictureRays(picture).direction(pixel, channel);
}

std::optional<glm::dvec2> pixel(const Picture& picture, const glm::dvec3& direction, Channel channel)
{
    return PictureRays(picture).pixel(direction, channel);
}

std::optional<glm::dmat3> planar_matrix(const Picture& picture) { return PictureRays(picture).planar_matrix(); }

double pixel_angle(const Picture& picture, glm::dvec2 pixel, Channel channel)
{
    return PictureRays(picture).pixel_angle(pixel, channel);
}

bool splits_colours(const Projection& projection)
{
    const Lens* lens = std::get_if<Lens>(&projection);
    return lens && !(lens->colours[0] == lens->colours[1] && lens->colours[1] == lens->colours[2]);
}

} // namespace starbow
