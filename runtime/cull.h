#pragma once
#include "plan.h"
#include "watcher.h"
#include "world.h"
#include <span>

namespace starbow {

/// An eye before what stands still in one rest frame.
struct Vantage {
    int frame = 0; ///< of World::frames
    glm::dvec3 place{0}; ///< the eye's event, that frame's place and time
    double time = 0;
    glm::dmat3 motion_from_frame{1}; ///< turn
    bool now = false; ///< everything is shown where it is now, in the ship's frame: along z as much closer
    double contraction = 1, beta = 0; ///< then: 1 / gamma, and the ship's speed along z
};

/// An eye of someone who looks: its place in his cockpit, scene units. frame: which of his layers it is.
Vantage vantage_of(const Layer& layer, int frame, const glm::dvec3& place);

/// When, by the vantage's own frame, the light left that reaches it now from a place, given from the eye in motion axes; or
/// what time it is there, where that is what is shown. How much later light leaves one place than another is at most as
/// large as their distance.
inline double emission_time(const Vantage& vantage, const glm::dvec3& from_eye)
{
    return vantage.time + (vantage.now ? vantage.beta * from_eye.z : -glm::length(from_eye));
}

/// One indexed draw into one image of a plan: `count` instances, listed in DrawList::visible from `first`.
struct Draw {
    std::uint32_t image, primitive, first, count;
    std::uint32_t first_index, index_count;
    bool mortal = false; ///< some of it may not be there when its light would have left
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
    struct Seat {
        glm::dvec3 centre, half[3]; ///< of an instance's box around the eye, motion axes: to the middle of each side
        double scale; ///< world units per local unit, at most
        double distance; ///< from the eye, at least
        bool shows; ///< light of it may arrive
    };
    std::vector<Seat> seats;
    std::vector<std::vector<std::uint32_t>> by_level;
};

/// Moves what rests in each vantage's frame around the eye (in double, rounded to float only there) and sorts out which
/// instance each image of that layer can see. Each is drawn at the coarsest level of detail that the quality lets
/// stray. The instances of a world stand in sort_instances' order. before: a list whose memory is taken over.
DrawList cull(const World& world, std::span<const Vantage> layers, const std::vector<PlanImage>& images,
    const Quality& quality = {}, DrawList before = {});

/// Balls around what may be seen of a frame's instances: those whose light, had it left, would have left while they were
/// there.
std::vector<Ball> balls(const World& world, const Vantage& vantage);

/// A frame's instances, from first to before last, in sort_instances' order.
struct InstanceRange {
    std::size_t first, last;
};
InstanceRange instances_of(const World& world, int frame);

/// Whether some of an instance's own times are told: clocks, what blinks, moves by itself or is not there for ever. The
/// first of its frame.
bool timed(const World& world, const Instance& instance);

/// Distance to the nearest of the frame's instances' bounding boxes, scene units: no surface is seen nearer.
double nearest_box(const World& world, const Vantage& vantage);

/// Puts a world's instances in order of their frames, in each those that are timed first, then of their materials and their
/// primitives.
void sort_instances(World& world);

} // namespace starbow
