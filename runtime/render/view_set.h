#pragma once
#include "bloom_pass.h"
#include "displays/compile/compiled_view.h"
#include "finish_pass.h"
#include "frame_state.h"
#include "input/controls.h"
#include "panel_pass.h"
#include "runtime/world/eye_event.h"
#include <memory>

namespace starbow {

/// A view of the layout, as the device shows it.
struct ViewState {
    std::size_t output = 0;
    std::size_t eye = 0; ///< index of its eye's cube map in EyeCubes::all
    CompiledView compiled;
    std::optional<std::size_t> map; ///< index into ViewSet::maps
    Image label; ///< of test patterns, once they were shown
    float shown_part = 1; ///< for test patterns too
    vk::raii::DescriptorSet warp_set = nullptr, label_set = nullptr;
    std::vector<std::uint64_t> written; ///< serials of all that the two sets hold
    vk::Rect2D hud_box;
    std::unique_ptr<BloomPass> bloom; ///< while the picture glows
    glm::dvec3 cube_m{0}; ///< place from which its cube map is drawn, cockpit frame, metres
    glm::dvec3 beside_m{0}; ///< the eye's place from there
    Buffer rest_frames; ///< RestFrameConstants, where something moves
    const View& geometry() const { return compiled.view; }
};

struct OutputState {
    glm::ivec2 size{0}; ///< pixels
    std::unique_ptr<FinishPass> finish; ///< null where the target takes the light as it is
};

/// A direction map on the device.
struct MapImage {
    std::shared_ptr<const DirectionMap> directions;
    Image image;
    Image inverse; ///< where there are stars
    bool closes = false; ///< InverseMap's
};

/// The views, outputs and direction maps that a layout becomes. Reads FrameState's layout; knows nothing of cube maps.
class ViewSet {
    vk::raii::DescriptorPool pool_ = nullptr; ///< first, so that it outlives the sets in `all`

public:
    /// has_stars: direction maps then get their inverse.
    ViewSet(Device& device, Pipelines& pipelines, const FrameState& state, double unit_m, bool has_stars);

    /// Everything that is computed of the layout before anything changes.
    struct Parts {
        std::vector<std::vector<CompiledView>> views; ///< of each output
        std::vector<Shade> shades;
    };
    /// Throws InputError for a wrong file, and where `rejects_empty`, for a view that shows nothing.
    Parts parts(bool rejects_empty);
    /// Takes the place of all views. Direction maps that serve again stay on the device.
    void apply_layout(Parts parts);
    void move_head(const Head& head);

    /// The direction map of a view, or a stand-in without texels where it has none.
    const Image& map_of(const ViewState& view) const;
    /// Its inverse, or the same stand-in.
    const Image& inverse_of(const ViewState& view) const;
    /// The view whose light is probed: the visitor's own and no preview, where there is one.
    const ViewState& probed_view() const;
    /// The pixels of the view; of a preview, the pixels of the view that it shows small.
    glm::ivec2 sent_pixels(const ViewState& view) const;
    /// Metres in the cockpit to scene units, the layout's hyper-stereo included.
    glm::dvec3 scene_units(const glm::dvec3& place_m) const;
    /// The eye's place from its cube map's, in a rest frame's motion axes, scene units. Where the baseline turns, the most
    /// that it ever is.
    glm::dvec3 eye_offset(const ViewState& view, const RestFrameView& layer) const;
    /// The member `eye` of ViewPush and RestFrameEntry.
    glm::vec4 eye_constants(const ViewState& view, const RestFrameView& layer) const;
    /// The unit direction in the cockpit that a point of an output (pixels from its top left) shows in its left eye.
    std::optional<glm::dvec3> direction(std::size_t output, const glm::dvec2& pixel) const;
    /// The target of an output's layer: the finishing pass's picture, or `last` where there is none.
    Target picture_of(std::size_t output, int layer, const Target& last) const;

    /// The width in pixels that makes the head-up display's panel sharp in the finest view.
    int hud_width() const;
    /// Place of the panel of instruments, `aspect` high over its width, and the width that makes it sharp.
    PanelPass::Place lab_place(double aspect) const;
    int lab_panel_width(double aspect) const;
    vk::DeviceSize memory() const;

    std::vector<ViewState> all;
    std::vector<OutputState> outputs;
    std::vector<MapImage> maps;
    PanelPass::Place hud_place;
    MapStore store;

private:
    glm::dvec3 cube_place(const View& view) const;
    std::optional<std::size_t> map_for(const CompiledView& view, std::vector<MapImage>& before);
    PixelBox panel_in(const ConeHierarchy& cones) const;
    void find_hud_box(ViewState& view) const;

    Device& device_;
    Pipelines& pipelines_;
    const FrameState& state_;
    double unit_m_;
    bool has_stars_;
    Image no_map_;
};

} // namespace starbow
