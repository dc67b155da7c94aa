#include "fill.h"
#include "runtime/world/parallel.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace starbow {
namespace {

/// The lowest and the highest place of a box along an axis.
glm::dvec2 extent_along(const AlignedBox& box, const glm::dvec3& axis)
{
    const glm::dvec3 a = axis * box.low, b = axis * box.high;
    const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b);
    return {low.x + low.y + low.z, high.x + high.y + high.z};
}

ShadowMap across(const glm::dvec3& towards, const Boxes& boxes, int size, double extent)
{
    ShadowMap map;
    // The first axis goes with the longest side of the world, so that the texels of a street are shorter across it.
    const glm::dvec3 sides = boxes.middle.high - boxes.middle.low;
    glm::dvec3 along(0);
    double longest = -1;
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0);
        axis[k] = 1;
        axis -= towards * glm::dot(towards, axis);
        if (sides[k] * glm::length(axis) > longest && glm::length(axis) > 0.1)
            longest = sides[k] * glm::length(axis), along = glm::normalize(axis);
    }
    map.axes = {along, glm::cross(towards, along), towards};
    for (int level = 0; level < 2; ++level)
        for (int k = 0; k < 2; ++k) {
            const glm::dvec2 range = extent_along(level == 0 ? boxes.middle : boxes.all, map.axes[std::size_t(k)]);
            // A margin of two texels: look-ups read the texels around.
            map.texel[level][k] = std::max(range.y - range.x, 1e-6 * (1 + extent)) / (size - 4);
            map.low[level][k] = 0.5 * (range.x + range.y) - 0.5 * size * map.texel[level][k];
        }
    const glm::dvec2 depth = extent_along(boxes.all, towards);
    const double margin = 0.01 * (depth.y - depth.x) + 1e-6 * (1 + extent);
    map.nothing = depth.x - margin, map.nearest = depth.y + margin;
    return map;
}

} // namespace

std::vector<ShadowMap> maps_of(const SceneFile& scene, const Boxes& boxes, int& size, int& layers)
{
    const std::vector<bool> has = lights_with_shadows(boxes, scene);
    std::vector<std::size_t> far, near;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (has[i])
            (std::holds_alternative<DirectionalLight>(scene.lights[i]) ? far : near).push_back(i);
    layers = int(2 * far.size() + 6 * near.size());
    size = layers <= 2 ? 4096 : layers <= 8 ? 2048 : 1024;
    const double extent = glm::length(glm::max(glm::abs(boxes.all.low), glm::abs(boxes.all.high)));
    std::vector<ShadowMap> maps;
    int layer = 0;
    for (const std::size_t i : far) {
        maps.push_back(across(std::get<DirectionalLight>(scene.lights[i]).towards, boxes, size, extent));
        maps.back().light = i, maps.back().layer = layer;
        layer += 2;
    }
    for (const std::size_t i : near) {
        ShadowMap map;
        map.light = i, map.point = true, map.place = std::get<PointLight>(scene.lights[i]).position;
        map.layer = layer;
        map.nothing = -(extent + glm::length(map.place)), map.nearest = 0;
        maps.push_back(map);
        layer += 6;
    }
    return maps;
}

void fill_map(Shadows& shadows, const ShadowMap& map, const Occluders& occluders,
    const std::function<void(double)>& progress, double from, double to)
{
    const int size = shadows.size, layers = map.point ? 6 : 2;
    // Rays begin outside everything. What is nearer to the lamp than the world's middle counts as its border.
    const double beyond = std::max(map.nearest, 2 * occluders.extent());
    const auto number = [&](double place) {
        const double part = std::clamp((place - map.nothing) / (map.nearest - map.nothing), 0.0, 1.0);
        return std::uint16_t(std::lround(65535 * part));
    };
    const auto row = [&](std::size_t line) {
        const int layer = int(line) / size, y = int(line) % size;
        std::uint16_t* texel
            = &shadows.texels[(std::size_t(map.layer + layer) * std::size_t(size) + std::size_t(y)) * std::size_t(size)];
        static_assert(4096 % Occluders::bundle == 0);
        for (int x = 0; x < size; x += Occluders::bundle) {
            Occluders::Vectors from, ways;
            for (int k = 0; k < Occluders::bundle; ++k) {
                const glm::dvec2 at(x + k + 0.5, y + 0.5);
                if (map.point) {
                    from.set(k, map.place), ways.set(k, cube_direction(layer, 2.0 * at / double(size) - 1.0));
                } else {
                    const glm::dvec2 place = map.low[layer] + at * map.texel[layer];
                    from.set(k, place.x * map.axes[0] + place.y * map.axes[1] + beyond * map.axes[2]);
                    ways.set(k, -map.axes[2]);
                }
            }
            const Occluders::Hits hits = occluders.first(from, ways);
            for (int k = 0; k < Occluders::bundle; ++k)
                texel[x + k] = hits.distance[k] < std::numeric_limits<float>::infinity()
                    ? number(map.point ? -double(hits.distance[k]) : beyond - double(hits.distance[k]))
                    : 0;
        }
    };
    in_parallel(std::size_t(layers) * std::size_t(size), row, progress, from, to);
}

} // namespace starbow
