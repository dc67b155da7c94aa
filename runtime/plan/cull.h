#pragma once
#include "cube_map_plan.h"
#include "runtime/world/eye_event.h"
#include <span>

namespace starbow {

/// One indexed draw into one image of a plan: `count` instances, listed in DrawList::visible from `first`.
struct Draw {
    std::uint32_t image, primitive, first, count;
    std::uint32_t first_index, index_count;
    bool finite_existence = false; ///< some of it may not be there when its light would have left
    bool moves = false; ///< by itself
};

/// What the cube pass of one eye draws.
struct DrawList {
    std::vector<shared::InstanceEntry> instances; ///< of all layers, each its frame's in the world's order; behind them
                                                  ///< POSES for each that moves by itself, in the same order
    std::vector<std::uint32_t> first_pose; ///< of each layer, in `instances`
    std::vector<std::uint32_t> first; ///< of each layer, in `instances`
    std::vector<std::uint32_t> visible; ///< indices into `instances`
    std::vector<Draw> draws; ///< by image, then by primitive

    /// What cull works with; kept for its room.
    struct OrientedBox {
        glm::dvec3 centre, half[3]; ///< of an instance's box around the eye, motion axes: to the middle of each side
        double scale; ///< world units per local unit, at most
        double distance; ///< from the eye, at least
        bool shows; ///< light of it may arrive
    };
    std::vector<OrientedBox> boxes;
    std::vector<std::vector<std::uint32_t>> by_level;
};

/// Moves what rests in each eye event's frame around the eye (in double, rounded to float only there) and sorts out which
/// instance each image of that layer can see. Each is drawn at the coarsest level of detail that the quality lets
/// stray. The instances of a world stand in sort_instances' order. before: a list whose memory is taken over.
DrawList cull(const World& world, std::span<const EyeEvent> layers, const std::vector<PlannedImage>& images,
    const Quality& quality = {}, DrawList before = {});

/// Balls around what may be seen of a frame's instances: those whose light, had it left, would have left while they were
/// there.
std::vector<BoundingSphere> bounding_spheres(const World& world, const EyeEvent& eye_event);

/// Distance to the nearest of the frame's instances' bounding boxes, scene units: no surface is seen nearer.
double nearest_box(const World& world, const EyeEvent& eye_event);

} // namespace starbow
