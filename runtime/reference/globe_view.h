#pragma once
#include "star_spots.h"

namespace starbow {

/// The globes in one view: which are discs, which are spots, and the Sun's glare over the whole picture.
class GlobeView {
public:
    /// An empty one, for a world without globes.
    GlobeView() = default;
    /// size: the view's pixels. beside: the eye's place for a direction, as in TracingEye::look.
    GlobeView(const TracingEye& eye, const ViewRays& rays, const glm::ivec2& size,
        const std::function<glm::dvec3(const glm::dvec3& way)>& beside);

    std::span<const double> parts() const { return parts_; } ///< for TracingEye::look
    std::span<const GlobeSpot> spots() const { return spots_; }
    /// The change of a pixel's light by the Sun's glare, without that of its spot. sun: the light of the Sun's disc in the
    /// pixel.
    glm::dvec3 glare(const ViewRays& rays, const glm::ivec2& pixel, int channel, const glm::dvec3& sun) const;

private:
    std::vector<double> parts_;
    std::vector<GlobeSpot> spots_;
    struct SunGlare {
        std::vector<std::pair<glm::dvec3, glm::dvec3>> lights; ///< of parts of its disc, as GlobeSpot's way and light
        double part_deg = 0; ///< width of a part
    };
    std::optional<SunGlare> sun_;
};

} // namespace starbow
