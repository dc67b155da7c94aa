#include "overlay.h"
#include "runtime/plan/cull.h"
#include "runtime/world/instances.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// 1, 2 or 5 times a power of ten: the largest that is no more than x.
double round_below(double x)
{
    const double power = std::pow(10.0, std::floor(std::log10(x) + 1e-9));
    return (x >= 4.999999 * power ? 5 : x >= 1.999999 * power ? 2 : 1) * power;
}

} // namespace

OverlayScale overlay_scale(const World& world, const glm::dvec3& place, double seconds_per_time_unit)
{
    std::vector<double> distances; // of all instances' middles
    const InstanceRange range = instances_of(world, 0);
    for (std::size_t i = range.first; i < range.last; ++i) {
        const Instance& instance = world.instances[i];
        const Primitive& primitive = world.primitives[instance.primitive];
        distances.push_back(glm::distance(glm::dvec3(instance.frame_from_local * glm::dvec4(primitive.centre, 1)), place));
    }
    OverlayScale scale;
    if (distances.empty())
        return scale;
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const double typical = std::max(*middle, 1e-12) * seconds_per_time_unit;
    const double nearest = std::max(nearest_box(world, {0, place}) * seconds_per_time_unit, typical / 50);
    scale.nearest_s = round_below(nearest);
    scale.farthest_s = std::max(round_below(3 * typical), 10 * scale.nearest_s);
    scale.emission_step_s = round_below(typical / 10);
    return scale;
}

} // namespace starbow
