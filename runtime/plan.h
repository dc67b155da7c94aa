#pragma once
#include "config/quality.h"
#include "displays/blocks.h"
#include "runtime/shared.h"
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace starbow {

/// What one pane asks of its eye's cube map.
struct View {
    const Blocks* blocks;
    glm::dmat3 motion_from_cockpit; ///< turn into the axes whose z is the direction of motion
    double parallax_rad = 0; ///< by how much the place that a pixel reads may lie off its direction, in the world
};

/// A ball around something that is drawn, from the eye in motion axes, scene units.
struct Ball {
    glm::dvec3 centre;
    double radius;
};

/// One rest frame's part of a cube map: how the panes look at it, boosted by its own motion.
struct PlanLayer {
    std::vector<View> views;
    double E = 1; ///< e^rapidity between it and the ship; 1 where directions are not aberrated
    bool galilean = false; ///< velocities are added: circles do not stay circles
    std::optional<std::vector<Ball>> things{}; ///< outside which there is nothing to draw; none: everywhere is something
};

/// One picture to draw: a rectangle of one face of the cube around the eye, at one resolution, and its place in the atlas.
/// Faces are numbered +z (ahead), -z (behind), +x, -x, +y, -y of the motion axes; a face's coordinates (a, b) are the two
/// other components (x before y before z) over the distance along its normal.
struct PlanImage {
    int slot; ///< of its layer
    int face;
    glm::dvec2 low, high; ///< face coordinates of the picture's edges, gutter included
    glm::ivec2 size; ///< texels
    glm::ivec2 atlas; ///< top left texel
    double texels_per_unit; ///< of face coordinate
    int levels; ///< mip levels the warp pass reads
    double hole = 0; ///< half the side of the square in the middle that no pixel reads: a finer image holds it
    int layer = 0;
};

/// What the cube map of one eye must hold for one frame.
struct Plan {
    std::vector<PlanImage> images; ///< by layer
    glm::ivec2 atlas_size{0};
    std::vector<int> rear_last; ///< of each layer: the finest nested image behind that differs from the one before
    int levels = 1; ///< of the atlas: the most that any image needs
    double texels = 0; ///< drawn, all images
    double pixels = 0; ///< served
};

/// Decides which faces are looked at, in which rectangle and how finely. Pure. Every texel that a pixel of the views reads,
/// the neighbours of its filter included, lies inside an image.
///
/// The cut: one image ahead; each side in three bands across the motion, so that D varies less than twofold in each; behind,
/// nested squares shrinking by sqrt 2 (D varies as the square of the angle there). A slot that nobody looks at is left out,
/// and so is one in which nothing stands. before: a plan whose memory is taken over.
Plan make_plan(const std::vector<PlanLayer>& layers, const Quality& quality, Plan before = {});
/// Of a world in which nothing moves.
Plan make_plan(const std::vector<View>& views, double E, const Quality& quality);

/// Whether what is drawn for one plan serves another, at hardly less density: it may then be shown once more.
bool serves(const Plan& drawn, const Plan& wanted);

/// The slot that shows the unit direction n (motion axes) and n's face coordinates there: what the warp shader does.
struct SlotPlace {
    int slot, face;
    glm::dvec2 at;
};
SlotPlace slot_of(const glm::dvec3& n, int rear_last);

/// Unit direction (not normalised: length of the face's plane) of a face coordinate.
glm::dvec3 face_direction(int face, const glm::dvec2& at);

/// clip_from_motion of an image: reversed z, infinite far plane, near plane at `near_distance` along the face's normal.
glm::dmat4 clip_from_motion(const PlanImage& image, double near_distance);

/// What the warp shader reads of one image, and of all: for each layer one entry per slot, into a table that has room for
/// them.
shared::SlotEntry slot_entry(const PlanImage& image);
void put_slots(const Plan& plan, std::span<shared::SlotEntry> table);

/// Turn from world axes to motion axes: z along u, y as near as possible to the cockpit's up; at rest z is the cockpit's
/// straight ahead. The same turn leads from the ship's axes to the motion axes in the ship's frame.
glm::dmat3 motion_from_world(const glm::dvec3& u, const glm::dquat& ship_from_cockpit);

} // namespace starbow
