#pragma once
#include "cube_map_plan.h"
#include "runtime/world/eye_event.h"
#include <span>

namespace starbow {

/// One indexed draw into one image of a plan: `count` instances, listed in DrawList::visible from `first`.
struct Draw {
    std::uint32_t image, primitive, first, count;
    std::uint32_t first_index, index_count;
    bool finite_existence = false; ///< its instances need the existence test
    bool moves = false; ///< animated
    bool deforms = false;
    bool blended = false; ///< one instance of a blended surface, what of it is not opaque: its indices are in
                          ///< DrawList::sorted_indices
    double farthest = 0; ///< from the eye to the box of its first instance, or of its piece, at most
    double apart = 0; ///< greatest distance between the drawn surfaces and the full ones, scene units
};

/// The draws of one eye's cube pass.
struct DrawList {
    std::vector<shared::InstanceEntry> instances; ///< by rest frame, in the world's order; behind each frame's, the
                                                  ///< POSES poses of each animated one, in the same order
    std::vector<std::uint32_t> first_pose; ///< by rest frame, in `instances`
    std::vector<std::uint32_t> first; ///< by rest frame, in `instances`
    std::vector<std::uint32_t> visible; ///< indices into `instances`
    std::vector<std::uint32_t> sorted_indices; ///< of blended surfaces, each one's triangles from behind
    std::vector<Draw> draws; ///< by image, then from the nearest: hidden surfaces fail the depth test unshaded. After them
                             ///< the blended ones, from behind

    /// Memory of cull, kept from frame to frame.
    struct OrientedBox {
        glm::dvec3 centre, half[3]; ///< an instance's box relative to the eye, the cube map's axes; half: from the centre to
                                    ///< the middle of each side
        double scale; ///< world units per local unit, at most
        double distance, farthest; ///< from the eye: at least, at most
        bool shows; ///< its light may arrive
    };
    std::vector<OrientedBox> boxes; ///< as `instances`, without the poses
    std::vector<std::vector<std::uint32_t>> by_level;
    struct SortedSurface {
        int level = -1; ///< that is sorted; 0: the full surface; -1: none yet
        std::uint32_t first_index = 0; ///< in `sorted_indices`
    };
    std::vector<SortedSurface> sorted_surfaces; ///< as `instances`, without the poses; empty without blended surfaces
    std::vector<std::pair<float, std::uint32_t>> distances; ///< of the triangles of one surface
};

/// Transforms each rest frame's instances relative to its eye event, in double precision, rounded to float only at the
/// end. Selects those in view of each image, each at the coarsest level of detail within the quality's lod_error_texels.
/// The world's instances must be in sort_instances' order. before: a list whose memory is reused.
DrawList cull(const World& world, std::span<const EyeEvent> eye_events, const std::vector<PlannedImage>& images,
    const Quality& quality = {}, DrawList before = {});

/// Bounding spheres of a rest frame's instances that existed at their retarded times. Centre from the eye, the cube map's
/// axes, scene units.
std::vector<BoundingSphere> bounding_spheres(const World& world, const EyeEvent& eye_event);

/// Caps around the bounding boxes of a rest frame's instances that are listed and may show, the cube map's axes.
void find_caps(const DrawList& list, std::size_t rest_frame, std::vector<BoundingCap>& caps);

/// The distance to the nearest bounding box of the rest frame's instances, scene units: a lower bound of all seen
/// distances.
double nearest_box(const World& world, const EyeEvent& eye_event);

} // namespace starbow
