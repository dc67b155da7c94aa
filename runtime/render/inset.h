#pragma once
#include "config/model/shot.h"
#include "view_state.h"

namespace starbow {

/// A small flat picture of another shot of the same event, to be laid over the views as a callout. It is warped from the
/// cube map of the frame's first view, or from a small one of its own where that costs less: see EyeCubes::observe_inset.
struct Inset {
    static constexpr double aspect = 0.75; ///< height over width

    /// width: pixels. fov_deg: from the lower edge to the upper. Throws NoRoom.
    Inset(Device& device, const Pipelines& pipelines, int width, double fov_deg);

    double fov_deg;
    Shot shot;
    Image picture; ///< in eShaderReadOnlyOptimal once it is drawn
    vk::raii::DescriptorPool pool = nullptr; ///< declared before the view, so that it outlives its set
    ViewState view; ///< of no output
};

} // namespace starbow
