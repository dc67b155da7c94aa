#pragma once
#include "displays/compile/compiled_view.h"
#include <memory>

namespace starbow {

/// The places of `count` samples in each pixel, in fractions from its top left. They are Hammersley's points, one in each of
/// `count` rows, the same in every pixel and every run.
std::vector<glm::dvec2> sample_places(int count);

/// A view's directions in double, also between its pixels' centres. In a warped view the samples' columns are rounded to
/// sixteenths of a pixel.
class ViewRays {
public:
    ViewRays(const CompiledView& view, const std::vector<glm::dvec2>& samples); ///< both must outlive it

    int channels() const { return channels_; }

    /// One row of pixels: unit directions in the cockpit, nullopt where nothing is shown.
    class Row {
    public:
        std::optional<glm::dvec3> centre(int x, int channel) const;
        std::optional<glm::dvec3> sample(int x, std::size_t sample, int channel) const;

    private:
        friend ViewRays;
        const ViewRays* rays = nullptr;
        int y = 0;
        std::vector<WarpSample> centres_;
        std::vector<std::vector<WarpSample>> samples_;
    };
    Row row(int y) const;

    /// The direction of any point, pixels from the view's corner. A warped view is extrapolated only as far as a plane
    /// through the pixel and its neighbours goes.
    std::optional<glm::dvec3> direction(const glm::dvec2& pixel, int channel) const;

    /// The pixel angle, as DirectionMap has it, from directions at the pixel's edges; 0 where one of them shows nothing.
    double pixel_rad(const glm::ivec2& at, int channel) const;

private:
    std::optional<glm::dvec3> warped(const WarpSample& sample, int channel) const;
    const CompiledView& view_;
    const std::vector<glm::dvec2>& places_;
    int channels_;
    Picture source_;
    PictureRays rays_;
    glm::dmat3 turn_;
    std::unique_ptr<WarpRaster> centres_, fine_;
};

} // namespace starbow
