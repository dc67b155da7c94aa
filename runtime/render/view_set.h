#pragma once
#include "finish_pass.h"
#include "frame_state.h"
#include "input/controls.h"
#include "inset.h"
#include "layout_parts.h"
#include "panel_pass.h"
#include "runtime/world/eye_event.h"
#include <memory>

namespace starbow {

struct OutputState {
    glm::ivec2 size{0}; ///< pixels
    std::unique_ptr<FinishPass> finish; ///< null where needs_finish is false
    std::vector<std::uint8_t> foremost; ///< Shade::foremost
    std::size_t layers() const { return finish ? finish->layers() : 1; }
    /// True if the light of a pixel's numbers is that of this layer.
    bool shows_foremost(std::size_t layer, const glm::ivec2& pixel) const
    {
        return foremost.empty() || foremost[std::size_t(pixel.y) * std::size_t(size.x) + std::size_t(pixel.x)] == layer;
    }
};

/// A direction map on the device.
struct MapImage {
    std::shared_ptr<const DirectionMap> directions;
    Image image;
    Image inverse; ///< null in worlds without stars
    bool closes = false; ///< InverseMap::closes
};

/// The views, outputs and direction maps of FrameState's layout. It knows no cube maps.
class ViewSet {
    vk::raii::DescriptorPool pool_ = nullptr; ///< declared first, so that it outlives the sets in `all`

public:
    /// has_stars: direction maps get their inverse.
    ViewSet(Device& device, Pipelines& pipelines, const FrameState& state, const SceneFile& scene, bool has_stars);

    /// Computes the parts of FrameState's layout. Throws InputError for a wrong file and, if `rejects_empty`, for a view
    /// that shows nothing.
    LayoutParts parts(bool rejects_empty);
    /// Replaces all views. Unchanged direction maps stay on the device.
    void apply_layout(LayoutParts parts);
    void move_head(const Head& head);

    /// The direction map of a view, or an image without content where it has none.
    const Image& map_of(const ViewState& view) const;
    /// The inverse of that map, or the same image without content.
    const Image& inverse_of(const ViewState& view) const;
    /// The view whose light is probed, given by its index; without one, the first view of the visitor that is no preview,
    /// or else the first view.
    const ViewState& probed_view(std::optional<std::size_t> view = {}) const;
    /// The size in pixels of the view, or for a preview of the view that it shows.
    glm::ivec2 sent_pixels(const ViewState& view) const;
    /// Converts metres in the cockpit to scene units, including the layout's hyper-stereo.
    glm::dvec3 scene_units(const glm::dvec3& place_m) const;
    /// The eye's place relative to its cube map's, in the axes of a rest frame's cube map, scene units. For a turning
    /// baseline, an upper bound of each component.
    glm::dvec3 eye_offset(const ViewState& view, const RestFrameView& rest_frame) const;
    /// The member `eye` of ViewPush and RestFrameEntry.
    glm::vec4 eye_constants(const ViewState& view, const RestFrameView& rest_frame) const;
    /// The unit direction in the cockpit that a point of an output shows in its left eye; where colours have directions of
    /// their own, green's. pixel: from the output's top left.
    std::optional<glm::dvec3> direction(std::size_t output, const glm::dvec2& pixel) const;
    /// The index of the view that shows it there; of several the one with the largest part of the pixel.
    std::optional<std::size_t> view_at(std::size_t output, const glm::dvec2& pixel) const;
    /// True if a flat view shows all directions of another flat one, in pixels at most half as wide. Both are in the
    /// cockpit.
    static bool shows_all_of(const ViewState& large, const ViewState& small);
    /// The finish pass of the view's output; null where there is none.
    const FinishPass* finish_of(const ViewState& view) const;
    /// The target of one of an output's canvases: the finish pass's, or `last` where the output needs no finish.
    Target canvas_target(std::size_t output, int canvas, const Target& last) const;

    /// The width in pixels that makes the head-up display's panel sharp in the finest view.
    int hud_width() const;
    /// The place of the instruments' panel, and the width in pixels that makes it sharp. aspect: height over width.
    PanelPass::Place lab_place(double aspect) const;
    int lab_panel_width(double aspect) const;
    /// The place of a panel straight above the head-up display, from 3 to 12 degrees above the middle of the picture, as high
    /// as it is seen whole. half: its extent.
    PanelPass::Place place_over_middle(const glm::dvec2& half) const;
    /// The place of a panel whose middle is in a direction of the cockpit.
    PanelPass::Place place_at(const glm::dvec3& towards, const glm::dvec2& half) const;
    /// The same above a direction: it is in the middle of the panel's width and `below` above its lower edge, on its plane.
    PanelPass::Place place_above(const glm::dvec3& towards, const glm::dvec2& half, double below = 0) const;
    bool shows_whole(const PanelPass::Place& place) const; ///< is_seen_whole()
    /// The place of a panel at the head-up display's right end, across from the picture's nearer edge. off, aside: from
    /// the display, and to the left from its end, on the panel's plane.
    PanelPass::Place place_beside_hud(const glm::dvec2& half, double off, double aside = 0) const;
    /// The place of a straight line from a panel's edge towards a direction of the cockpit, short of it by end_rad; nothing
    /// where the panel covers the direction, or it is a right angle away. half_width: on the panel's plane.
    static std::optional<PanelPass::Place> place_line(
        const PanelPass::Place& from, const glm::dvec3& towards, double end_rad, double half_width);
    vk::DeviceSize memory() const;

    std::vector<ViewState> all;
    std::vector<OutputState> outputs;
    std::vector<MapImage> maps;
    PanelPass::Place hud_place;
    MapStore store;
    std::vector<std::unique_ptr<Inset>> insets; ///< two at most

private:
    std::optional<glm::dvec3> direction(const ViewState& view, std::size_t output, const glm::dvec2& pixel) const;
    glm::dvec3 cube_place(const View& view) const;
    std::optional<std::size_t> map_for(
        const CompiledView& view, const std::map<const DirectionMap*, InverseMap>& inverses, std::vector<MapImage>& before);
    std::vector<std::vector<CompiledView>> compiled_views() const;
    PixelBox panel_in(const ConeHierarchy& cones) const;
    void find_hud_box(ViewState& view) const;
    std::vector<glm::ivec2> sizes() const; ///< of the outputs

    Device& device_;
    Pipelines& pipelines_;
    const FrameState& state_;
    double unit_m_, light_speed_m_s_;
    bool has_stars_;
    Image no_map_;
    HudPlacement hud_;
};

} // namespace starbow
