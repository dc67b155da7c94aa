#pragma once
#include "config/model/scene_file.h"
#include "config/model/tour_file.h"
#include "hud.h"
#include "runtime/world/world.h"
#include <array>
#include <optional>

namespace starbow {

/// A marked thing as an eye in the ship sees it.
struct SeenHighlight {
    glm::dvec3 towards{0, 0, -1}; ///< its middle, unit, cockpit axes
    double radius = 0; ///< angular, radians; a right angle from within the thing
};

/// A highlight's thing by the light that arrives at a shot's event. Nothing where the thing does not exist at its retarded
/// time, or where the picture follows another law than aberration's, with which things stand elsewhere. world: the scene's,
/// with its globes.
std::optional<SeenHighlight> seen_highlight(
    const Highlight& highlight, const Shot& shot, const World& world, const SceneFile& scene);

/// Throws InputError for a highlight on a body or a globe that the tour's scene lacks.
void check_highlights(const Tour& tour, const SceneFile& scene);

/// A thing that looks smaller than this, degrees, is shown enlarged where its highlight says so; two, which are compared,
/// already below the second.
constexpr double enlarged_below_deg = 6, compared_below_deg = 12;
/// The field of such an inset from its lower edge to its upper, degrees, of few steps; 0: the thing is large enough without
/// it. below: that size. before: as for telescope_fov_deg.
double enlarged_fov_deg(const SeenHighlight& seen, double below, double before);

/// A highlight in a picture.
struct ShownHighlight {
    std::string name;
    glm::dvec3 towards{0, 0, -1}; ///< as SeenHighlight's
    double radius = 0; ///< as SeenHighlight's
    double enlarged_deg = 0; ///< the field of its inset; 0: none
};
/// A step's highlights that are seen, in their order. enlarged_deg: each highlight's inset in the picture before, and then
/// in this one.
std::vector<ShownHighlight> shown_highlights(const std::vector<Highlight>& highlights, const Shot& shot, const World& world,
    const SceneFile& scene, std::array<double, 2>& enlarged_deg);

/// The radius of a highlight's ring, degrees: a little outside the thing, and not less than can be seen from afar; 0 where
/// the thing is so large that nobody needs a ring.
double ring_deg(const ShownHighlight& highlight);

/// A ring with a name above it. ring_px: the ring's radius. The ring's middle is that many pixels and the ring's line above
/// the panel's lower edge, and in the middle across. degree_px: pixels to a degree.
Panel draw_ring(const Typesetter& typesetter, const std::string& name, double ring_px, double degree_px);
/// The ring's middle above the panel's lower edge, pixels.
double ring_middle_px(double ring_px, double degree_px);

/// A line from the panel's lower edge to its upper, in the same colours, to be stretched to any length.
Panel draw_line(double degree_px);

} // namespace starbow
