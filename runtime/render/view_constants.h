#pragma once
#include "eye_cubes.h"

namespace starbow {

/// Computes specialization constants and push constants for a view's shaders; records no commands.
class ViewConstants {
public:
    ViewConstants(const GpuWorld& world, const FrameState& state, const ViewSet& views, const EyeCubes& eyes)
        : world_(world)
        , state_(state)
        , views_(views)
        , eyes_(eyes)
    {
    }

    /// The variant of passes that take one ray a pixel.
    WarpVariant variant(const ViewState& view) const;
    /// The variant of passes that show light: all rays of the quality.
    WarpVariant variant_shown(const ViewState& view) const;
    /// The variant of the star pass. Any plan will do, so that a change of the plan makes no new pipeline.
    WarpVariant variant_of_stars(const ViewState& view) const;
    /// A variant for flight with these effects, whatever the ship does now.
    WarpVariant in_flight(WarpVariant variant, const Effects& on) const;
    /// The variant of the exposure's samples. They are few, so that it does without what the plan and rest would save.
    WarpVariant variant_metered(const ViewState& view, const Effects& on) const;
    /// The image ahead if it is the plan's only one, as often at rest; null otherwise.
    const PlannedImage* single_image(const ViewState& view) const;
    /// The push constants of a view. Their rows lead from pixels to the axes of axes_from_cockpit.
    shared::ViewPush push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const;
    /// The same in the motion axes of the view's observer, exposed.
    shared::ViewPush exposed_push(const ViewState& view, double exposure) const;
    /// The star pass's push constants: their rows lead from motion axes back to pixels. exposure: of a picture that is
    /// shown, with the stars' glare unless a curve shows everything at once; without one the light is as it is measured.
    shared::ViewPush star_push(const ViewState& view, std::optional<double> exposure) const;

private:
    bool reprojects(const ViewState& view) const; ///< its cube map is not drawn at its own eye
    bool needs_table(const Effects& on, StoredLight light) const; ///< at D = 1
    glm::vec4 boost(const ViewState& view, double exposure) const;

    const GpuWorld& world_;
    const FrameState& state_;
    const ViewSet& views_;
    const EyeCubes& eyes_;
};

} // namespace starbow
