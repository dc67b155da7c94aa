#include "instances.h"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace starbow {

InstanceRange instances_of(const World& world, int frame)
{
    const auto of = std::equal_range(world.instances.begin(), world.instances.end(), Instance{.frame = frame},
        [](const Instance& a, const Instance& b) { return a.frame < b.frame; });
    return {std::size_t(of.first - world.instances.begin()), std::size_t(of.second - world.instances.begin())};
}

bool timed(const World& world, const Instance& instance)
{
    const Material& material = world.materials[std::size_t(world.primitives[instance.primitive].material)];
    return finite_existence(world, instance) || instance.motion >= 0 || material.clock || material.blink;
}

bool finite_existence(const World& world, const Instance& instance)
{
    return instance.existence >= 0
        && (std::isfinite(world.existence_intervals[std::size_t(instance.existence)].begin)
            || std::isfinite(world.existence_intervals[std::size_t(instance.existence)].end));
}

std::pair<bool, bool> kind_of(const World& world, const Instance& instance)
{
    return {finite_existence(world, instance), instance.motion >= 0};
}

void sort_instances(World& world)
{
    auto key = [&](const Instance& i) {
        const int material = world.primitives[i.primitive].material;
        return std::tuple(i.frame, !timed(world, i), material, i.primitive, kind_of(world, i));
    };
    std::stable_sort(world.instances.begin(), world.instances.end(),
        [&](const Instance& a, const Instance& b) { return key(a) < key(b); });
}

} // namespace starbow
