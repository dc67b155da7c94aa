#include "direction_map.h"
#include "picture.h"
#include <algorithm>
#include <thread>

namespace starbow {
namespace {

void compile_rows(const PictureRays& rays, DirectionMap& map, int first, int end)
{
    for (int y = first; y < end; ++y)
        for (int x = 0; x < map.size.x; ++x) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const std::optional<glm::dvec3> seen = rays.direction(centre);
            if (seen)
                map.texels[std::size_t(y) * map.size.x + x] = glm::dvec4(*seen, rays.pixel_angle(centre));
        }
}

} // namespace

std::optional<glm::dvec3> direction(const Projection& projection, glm::ivec2 size, glm::dvec2 pixel)
{
    return direction(Picture{projection, size}, pixel);
}

std::optional<glm::dvec2> pixel(const Projection& projection, glm::ivec2 size, const glm::dvec3& direction)
{
    return pixel(Picture{projection, size}, direction);
}

std::optional<glm::dmat3> planar_matrix(const Projection& projection, glm::ivec2 size)
{
    return planar_matrix(Picture{projection, size});
}

double pixel_angle(const Projection& projection, glm::ivec2 size, glm::dvec2 pixel)
{
    return pixel_angle(Picture{projection, size}, pixel);
}

double pixel_length(const Projection& projection, glm::ivec2 size)
{
    if (const Fisheye* dome = std::get_if<Fisheye>(&projection))
        return glm::radians(dome->aperture_deg) / std::min(size.x, size.y);
    return 0;
}

DirectionMap compile(const Projection& projection, glm::ivec2 size)
{
    DirectionMap map{size, std::vector<glm::vec4>(std::size_t(size.x) * size.y, glm::vec4(0))};
    const PictureRays rays(Picture{projection, size});
    // Bands of whole rows: no texel depends on another, so the result does not depend on the number of threads.
    const int bands = std::clamp(int(std::thread::hardware_concurrency()), 1, std::max(size.y, 1));
    std::vector<std::jthread> threads;
    for (int band = 1; band < bands; ++band)
        threads.emplace_back([&, band] {
            compile_rows(
                rays, map, int(std::int64_t(size.y) * band / bands), int(std::int64_t(size.y) * (band + 1) / bands));
        });
    compile_rows(rays, map, 0, size.y / bands);
    threads.clear();
    return map;
}

} // namespace starbow
