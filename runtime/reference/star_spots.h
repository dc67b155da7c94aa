#pragma once
#include "eye.h"
#include "runtime/world/stars.h"
#include "view_rays.h"

namespace starbow {

/// A globe that is shown as a star's spot.
struct GlobeSpot {
    glm::dvec3 way; ///< unit, cockpit
    glm::dvec3 light; ///< times a solid angle, as the ship sees it
    std::optional<double> glared; ///< the part of the light that the Sun's own glare holds; unset: it has a star's glare
};

/// The visible stars' spots as one eye sees them.
class StarSpots {
public:
    /// beside: the eye's place for a direction, as in TracingEye::look.
    /// exposure: the shown picture's, on which it depends how far glare is seen. parts: as in TracingEye::look.
    StarSpots(const std::vector<Star>& stars, const StarSky& sky, double unit_m, const TracingEye& eye,
        const Colours& colours, const std::function<glm::dvec3(const glm::dvec3& way)>& beside, double exposure,
        std::span<const double> parts = {}, std::span<const GlobeSpot> globes = {});

    /// The light of stars in a pixel: the parts there of the spots that reach it.
    glm::dvec3 light(const ViewRays& rays, const glm::ivec2& pixel, int channel) const;
    /// The change of that light by an eye's glare in a shown picture: the light that glare brings from stars around, less
    /// the light that it takes from those in the pixel.
    glm::dvec3 glare(const ViewRays& rays, const glm::ivec2& pixel, int channel) const;

private:
    struct Spot {
        glm::dvec3 way; ///< unit, cockpit
        glm::dvec3 light; ///< divided by a solid angle, as a radiance
        double glare_deg = 0; ///< radius within which its glare is seen, if pixels are small
        double glared = 0; ///< the part of its light that a glare elsewhere holds
        double disc_deg = 0; ///< the Sun's radius, within which its glare grows no more
    };
    /// A spot's place in the picture, as found from a pixel.
    struct Seen {
        const Spot* spot;
        double off_square; ///< from the pixel's middle, pixels
        double solid_angle_sr; ///< of a pixel there
    };
    /// The spots within `reach` pixels. candidates(way, pixel): the indices of spots that may be near a direction; pixel:
    /// the width and height of a pixel there together, radians.
    template <class Candidates>
    std::vector<Seen> seen_near(
        const ViewRays& rays, const glm::ivec2& pixel, int channel, double reach, const Candidates& candidates) const;
    void sort(std::size_t first, std::size_t end, int axis);
    void near(std::size_t first, std::size_t end, int axis, const glm::dvec3& way, double reach,
        std::vector<std::size_t>& found) const;
    struct Glaring {
        std::size_t spot;
        double least_cosine; ///< of the angle within which its glare may be seen
    };
    std::vector<Glaring> glaring_; ///< the spots whose glare may be seen
    std::vector<Spot> spots_; ///< a k-d tree: the middle one of a range divides it along an axis
};

} // namespace starbow
