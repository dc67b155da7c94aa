#include "still_things.h"
#include "occluders.h"
#include "runtime/world/boxes.h"
#include "runtime/world/outline.h"
#include "runtime/world/shadows.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

constexpr int most_point_lamps = 3; // with six maps each

} // namespace

Boxes boxes_of(const World& world)
{
    std::vector<AlignedBox> things;
    for (const Instance& instance : world.instances)
        if (hides_light(world, instance)) {
            const Primitive& primitive = world.primitives[instance.primitive];
            things.push_back(transformed({primitive.low, primitive.high}, instance.frame_from_local));
        }
    Boxes boxes;
    if (things.empty())
        return boxes;
    boxes.all = boxes.middle = middle_of(things).box;
    glm::dvec3 centre;
    for (int k = 0; k < 3; ++k) {
        const auto half = things.begin() + std::ptrdiff_t(things.size() / 2);
        const auto middle = [k](const AlignedBox& box) { return 0.5 * (box.low[k] + box.high[k]); };
        std::nth_element(things.begin(), half, things.end(),
            [&](const AlignedBox& a, const AlignedBox& b) { return middle(a) < middle(b); });
        centre[k] = middle(*half);
    }
    const auto reach = [&](const AlignedBox& box) {
        return glm::length(glm::max(glm::abs(box.low - centre), glm::abs(box.high - centre)));
    };
    std::sort(things.begin(), things.end(), [&](const AlignedBox& a, const AlignedBox& b) { return reach(a) < reach(b); });
    const std::size_t most = std::size_t(std::ceil(0.97 * double(things.size())));
    if (most < things.size()) {
        AlignedBox middle = things.front();
        for (std::size_t i = 1; i < most; ++i)
            middle = around(middle, things[i]);
        boxes.middle = {glm::max(middle.low, boxes.all.low), glm::min(middle.high, boxes.all.high)};
    }
    const glm::dvec3 size = boxes.middle.high - boxes.middle.low;
    const double longest = std::max({size.x, size.y, size.z});
    double ground = boxes.middle.low.y;
    for (const AlignedBox& thing : things) {
        if (is_flat(thing) && thing.high.y < boxes.middle.low.y && thing.high.y > boxes.middle.low.y - 1.5 * longest)
            ground = std::min(ground, thing.high.y);
    }
    // Things take the sky from the ground as far around as they are high.
    const double margin = std::clamp(boxes.middle.high.y - ground, 0.1 * longest, 0.5 * longest);
    boxes.around_middle = {boxes.middle.low - margin, boxes.middle.high + margin};
    boxes.around_middle.low.y = std::min(boxes.around_middle.low.y, ground);
    return boxes;
}

std::vector<bool> lights_with_shadows(const Boxes& boxes, const SceneFile& scene)
{
    const glm::dvec3 centre = 0.5 * (boxes.around_middle.low + boxes.around_middle.high);
    // There, a texel of a map of 1024 is a 32nd of the things' longest side.
    const glm::dvec3 size = boxes.middle.high - boxes.middle.low;
    const double reach = 16 * std::max({size.x, size.y, size.z});
    std::vector<bool> has;
    int points = 0;
    for (const Light& light : scene.lights) {
        const auto* point = std::get_if<PointLight>(&light);
        has.push_back(!point
            || (point->body.empty() && glm::distance(point->position, centre) < reach && points++ < most_point_lamps));
    }
    return has;
}

void note_lacking_shadows(const SceneFile& scene, const World& world, std::vector<std::string>& notes)
{
    const bool moves = !scene.bodies.empty() || !world.motions.empty();
    if (scene.shadows && moves && std::ranges::find(notes, no_moving_shadows) == notes.end())
        notes.push_back(no_moving_shadows);
}

} // namespace starbow
