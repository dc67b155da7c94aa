#include "view_set.h"
#include "config/model/angles.h"
#include "debug.h"
#include "runtime/hud/hud_place.h"
#include "shaders/physics/physics.h"
#include <algorithm>
#include <cmath>

namespace starbow {

ViewSet::ViewSet(Device& device, Pipelines& pipelines, const FrameState& state, const SceneFile& scene, bool has_stars)
    : device_(device)
    , pipelines_(pipelines)
    , state_(state)
    , unit_m_(scene.unit_m)
    , light_speed_m_s_(scene.light_speed_m_s)
    , has_stars_(has_stars)
{
    const float zeros[2] = {};
    no_map_ = make_texture_array(device, map_format, {1, 1}, 1, std::as_bytes(std::span(zeros)));
    name_object(device, no_map_, "views: no map");
    for (const Output& output : state.layout.outputs)
        outputs.emplace_back().size = output.size;
    store.matrices(uses_matrices(state.layout, state.quality));
}

glm::ivec2 ViewSet::sent_pixels(const ViewState& view) const
{
    for (const ViewState& other : all)
        if (other.output == other.geometry().output && other.output == view.geometry().output
            && other.geometry().viewport == view.geometry().viewport && other.geometry().eye == view.geometry().eye)
            return other.geometry().size;
    return view.geometry().size;
}

glm::dvec3 ViewSet::scene_units(const glm::dvec3& place_m) const
{
    return place_m * state_.layout.stereo.units_per_m(unit_m_, light_speed_m_s_);
}

glm::dvec3 ViewSet::eye_offset(const ViewState& view, const RestFrameView& rest_frame) const
{
    const glm::dvec3 offset = rest_frame.shot.ship_from_cockpit * scene_units(view.beside_m);
    if (state_.layout.stereo.turning)
        return glm::dvec3(1, 1, physics::gamma_of(rest_frame.shot.u)) * glm::length(offset);
    glm::dvec3 apart = rest_frame.cube_from_frame * physics::eye_place(rest_frame.shot.u, offset);
    apart.z *= rest_frame.contraction;
    return apart;
}

glm::vec4 ViewSet::eye_constants(const ViewState& view, const RestFrameView& rest_frame) const
{
    if (!state_.layout.stereo.turning)
        return glm::vec4(eye_offset(view, rest_frame), 0);
    const double side = view.beside_m.x < 0 ? -1 : 1;
    return glm::vec4(rest_frame.motion_from_cockpit * glm::dvec3(0, 1, 0), side * glm::length(scene_units(view.beside_m)));
}

/// Place from which the view's cube map is drawn, cockpit frame, metres.
glm::dvec3 ViewSet::cube_place(const View& view) const
{
    return state_.layout.stereo.method == StereoMethod::exact ? view.picture.eye_m : view.head_m;
}

const ViewState& ViewSet::probed_view(std::optional<std::size_t> view) const
{
    if (view)
        return all[*view];
    for (const ViewState& one : all)
        if (!state_.layout.outputs[one.output].preview && one.geometry().observer == ViewportObserver{})
            return one;
    return all.front();
}

LayoutParts ViewSet::parts(bool rejects_empty) { return layout_parts(store, state_.layout, sizes(), rejects_empty); }

std::vector<glm::ivec2> ViewSet::sizes() const
{
    std::vector<glm::ivec2> all_sizes;
    for (const OutputState& output : outputs)
        all_sizes.push_back(output.size);
    return all_sizes;
}

void ViewSet::apply_layout(LayoutParts parts)
{
    hud_ = placed_hud(state_.layout, sizes(), parts.views);
    hud_place
        = {panel_from_cockpit(hud_, parts.views), std::tan(0.5 * hud_.width_deg * degree) * glm::dvec2(1, panel_aspect)};
    std::vector<ViewState> before = std::exchange(all, {}); // their maps are reused
    std::vector<MapImage> maps_before = std::exchange(maps, {});
    for (std::size_t output = 0; output < outputs.size(); ++output)
        for (CompiledView& compiled : parts.views[output]) {
            ViewState view;
            view.output = output;
            view.compiled = std::move(compiled);
            all.push_back(std::move(view));
        }
    const double room = headroom(parts.shades);
    for (std::size_t output = 0; output < outputs.size(); ++output) {
        Output own = state_.layout.outputs[output];
        own.size = outputs[output].size;
        outputs[output].finish.reset();
        outputs[output].foremost = std::move(parts.shades[output].foremost);
        if (needs_finish(own, parts.shades[output]) || (room != 1 && !own.preview))
            outputs[output].finish
                = std::make_unique<FinishPass>(device_, pipelines_, own, parts.shades[output], own.preview ? 1 : room);
    }

    for (ViewState& view : all) {
        view.cube_m = cube_place(view.geometry());
        view.beside_m = view.geometry().picture.eye_m - view.cube_m;
        view.map = map_for(view.compiled, parts.inverses, maps_before);
        find_hud_box(view);
    }
    const std::uint32_t count = std::uint32_t(all.size());
    before.clear();
    pool_ = nullptr;
    std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBuffer, 4 * count},
        {vk::DescriptorType::eUniformTexelBuffer, 2 * count}, {vk::DescriptorType::eCombinedImageSampler, 20 * count}};
    pool_ = device_.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2 * count, sizes});
    name_object(device_, pool_, "views: descriptor pool");
    auto make_set = [&](const vk::raii::DescriptorSetLayout& set_layout) {
        vk::raii::DescriptorSet set = std::move(device_.device.allocateDescriptorSets({*pool_, *set_layout}).front());
        name_object(device_, set, "views: descriptor set");
        return set;
    };
    for (ViewState& view : all) {
        view.warp_set = make_set(pipelines_.layouts.warp_set);
        view.label_set = make_set(pipelines_.layouts.picture_set);
    }
}

std::optional<std::size_t> ViewSet::map_for(
    const CompiledView& view, const std::map<const DirectionMap*, InverseMap>& inverses, std::vector<MapImage>& before)
{
    if (!view.map)
        return {};
    for (std::size_t i = 0; i < maps.size(); ++i)
        if (maps[i].directions == view.map)
            return i;
    for (MapImage& old : before)
        if (old.directions == view.map) {
            maps.push_back(std::move(old));
            return maps.size() - 1;
        }
    const DirectionMap& map = *view.map;
    maps.push_back({view.map,
        make_texture_array(device_, map_format, map.size, std::uint32_t(map.channels), sizeof(glm::uvec2),
            [&](std::uint32_t channel, int first, int rows, std::span<std::byte> to) {
                pack_rows(map, int(channel), first, rows,
                    {reinterpret_cast<glm::uvec2*>(to.data()), to.size() / sizeof(glm::uvec2)});
            })});
    if (has_stars_) {
        const auto known = inverses.find(view.map.get());
        const InverseMap inverse = known != inverses.end() ? known->second : starbow::inverse(map);
        maps.back().closes = inverse.closes;
        maps.back().inverse = make_texture_array(device_, inverse_format, glm::ivec2(inverse.side),
            std::uint32_t(inverse.channels), std::as_bytes(std::span(inverse.cells)));
    }
    return maps.size() - 1;
}

const Image& ViewSet::map_of(const ViewState& view) const { return view.map ? maps[*view.map].image : no_map_; }

const Image& ViewSet::inverse_of(const ViewState& view) const
{
    return view.map && has_stars_ ? maps[*view.map].inverse : no_map_;
}

PixelBox ViewSet::panel_in(const ConeHierarchy& cones) const
{
    return panel_box(cones, hud_place.panel_from_cockpit, hud_place.half);
}

void ViewSet::find_hud_box(ViewState& view) const
{
    const PixelBox box = panel_in(*view.compiled.cones);
    view.hud_box = rect_of(view.geometry().corner + box.low, box.high - box.low);
}

int ViewSet::hud_width() const
{
    double finest = 1;
    for (const ViewState& view : all)
        finest = std::min(finest, double(panel_in(*view.compiled.cones).finest));
    return std::clamp(int(2 * hud_place.half.x / finest), 160, 4096);
}

/// The direction that one view shows there, if it shows any.
std::optional<glm::dvec3> ViewSet::direction(const ViewState& view, std::size_t output, const glm::dvec2& pixel) const
{
    const glm::dvec2 at = pixel - glm::dvec2(view.geometry().corner), size(view.geometry().size);
    if (view.output != output || view.geometry().canvas != 0 || at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y)
        return {};
    if (view.compiled.matrix)
        return glm::normalize(*view.compiled.matrix * glm::dvec3(at, 1));
    const glm::vec4 texel = view.compiled.map->at(int(at.x), int(at.y), view.compiled.channels() == 3 ? 1 : 0);
    if (texel.w > 0)
        return glm::normalize(glm::dvec3(texel));
    return {};
}

std::optional<glm::dvec3> ViewSet::direction(std::size_t output, const glm::dvec2& pixel) const
{
    const auto view = view_at(output, pixel);
    return view ? direction(all[*view], output, pixel) : std::nullopt;
}

std::optional<std::size_t> ViewSet::view_at(std::size_t output, const glm::dvec2& pixel) const
{
    for (std::size_t i = 0; i < all.size(); ++i)
        if (direction(all[i], output, pixel)
            && outputs[output].shows_foremost(std::size_t(all[i].geometry().layer), glm::ivec2(pixel)))
            return i;
    return {};
}

std::vector<std::vector<CompiledView>> ViewSet::compiled_views() const
{
    std::vector<std::vector<CompiledView>> views(outputs.size());
    for (const ViewState& view : all)
        views[view.output].push_back(view.compiled);
    return views;
}

/// The same panel with its middle moved on its own plane.
static glm::dmat3 moved(const glm::dmat3& panel_from_cockpit, const glm::dvec2& by)
{
    glm::dmat3 rows = glm::transpose(panel_from_cockpit);
    rows[0] -= by.x * rows[2], rows[1] -= by.y * rows[2];
    return glm::transpose(rows);
}

PanelPass::Place ViewSet::place_over_middle(const glm::dvec2& half) const
{
    const std::vector<std::vector<CompiledView>> views = compiled_views();
    PanelPass::Place place;
    // Most rings around the subjects of tours, with their names, reach up to less than 12 degrees.
    for (const double elevation_deg : {12.0, 9.0, 6.0, 3.0}) {
        const HudPlacement there{.azimuth_deg = hud_.azimuth_deg, .elevation_deg = elevation_deg};
        place = {moved(panel_from_cockpit(there, views), {0, half.y}), half};
        if (is_seen_whole(place.panel_from_cockpit, place.half, views))
            break;
    }
    return place;
}

PanelPass::Place ViewSet::place_at(const glm::dvec3& towards, const glm::dvec2& half) const
{
    const glm::dvec2 angles = azimuth_elevation_deg(towards);
    const HudPlacement there{.azimuth_deg = angles.x, .elevation_deg = angles.y};
    return {panel_from_cockpit(there, compiled_views()), half};
}

PanelPass::Place ViewSet::place_above(const glm::dvec3& towards, const glm::dvec2& half, double below) const
{
    return {moved(place_at(towards, half).panel_from_cockpit, {0, half.y - below}), half};
}

bool ViewSet::shows_whole(const PanelPass::Place& place) const
{
    return is_seen_whole(place.panel_from_cockpit, place.half, compiled_views());
}

PanelPass::Place ViewSet::place_beside_hud(const glm::dvec2& half, double off, double aside) const
{
    const double gap = 0.02, up = hud_place.half.y + gap + half.y + off;
    const bool low = hud_.elevation_deg < 0;
    return {moved(hud_place.panel_from_cockpit, {hud_place.half.x - half.x - aside, low ? up : -up}), half};
}

std::optional<PanelPass::Place> ViewSet::place_line(
    const PanelPass::Place& from, const glm::dvec3& towards, double end_rad, double half_width)
{
    const glm::dvec3 end = from.panel_from_cockpit * towards;
    if (end.z <= 0.01)
        return {}; // more than a right angle away
    const glm::dvec2 to = glm::dvec2(end) / end.z;
    const glm::dvec2 parts = glm::abs(to) / from.half;
    const double leaves = std::max(parts.x, parts.y); // of the panel at 1 / leaves of the way
    if (leaves <= 1)
        return {};
    const glm::dvec2 begin = to / leaves, way = to - begin, along = glm::normalize(way);
    const double length = glm::length(way) - std::tan(end_rad) * std::sqrt(1 + glm::dot(to, to));
    if (length <= 0)
        return {};
    const glm::dmat3 turn(along.y, along.x, 0, -along.x, along.y, 0, 0, 0, 1); // x' across, y' along
    return PanelPass::Place{turn * moved(from.panel_from_cockpit, begin + 0.5 * length * along), {half_width, 0.5 * length}};
}

PanelPass::Place ViewSet::lab_place(double aspect) const
{
    const std::vector<std::vector<CompiledView>> shown = compiled_views();
    return {panel_from_cockpit(instruments_place(hud_, aspect, shown), shown),
        std::tan(0.5 * hud_.width_deg * degree) * glm::dvec2(1, aspect)};
}

int ViewSet::lab_panel_width(double aspect) const
{
    const PanelPass::Place place = lab_place(aspect);
    double finest = 1;
    for (const ViewState& view : all)
        finest = std::min(finest, panel_box(*view.compiled.cones, place.panel_from_cockpit, place.half).finest);
    return std::clamp(int(2 * place.half.x / finest), 160, 4096);
}

bool ViewSet::shows_all_of(const ViewState& large, const ViewState& small)
{
    if (!large.compiled.matrix || !small.compiled.matrix)
        return false;
    const glm::dmat3 large_from_small = glm::inverse(*large.compiled.matrix) * *small.compiled.matrix;
    const glm::dvec2 size(small.geometry().size), most = glm::dvec2(large.geometry().size) - 0.5;
    glm::dvec2 first(1e300), last(-1e300);
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        // The outermost of two rays along each side of a pixel.
        const glm::dvec3 there = large_from_small * glm::dvec3(0.25 + corner * (size - 0.5), 1);
        if (there.z <= 0)
            return false;
        first = glm::min(first, glm::dvec2(there) / there.z), last = glm::max(last, glm::dvec2(there) / there.z);
    }
    return glm::all(glm::greaterThanEqual(first, glm::dvec2(0.5))) && glm::all(glm::lessThanEqual(last, most))
        && glm::all(glm::greaterThanEqual(last - first, 2.0 * size));
}

const FinishPass* ViewSet::finish_of(const ViewState& view) const
{
    return view.output < outputs.size() ? outputs[view.output].finish.get() : nullptr;
}

Target ViewSet::canvas_target(std::size_t output, int canvas, const Target& last) const
{
    const FinishPass* finish = outputs[output].finish.get();
    return finish ? finish->canvas(std::size_t(canvas)) : last;
}

void ViewSet::move_head(const Head& head)
{
    for (ViewState& view : all) {
        View moved = view.geometry();
        const glm::dvec3 beside = moved.picture.eye_m - moved.head_m;
        moved.head_m += head.moved_m;
        moved.picture.eye_m = moved.head_m + head.turned * beside;
        if (auto matrix = view.compiled.map ? std::nullopt : view_matrix(moved); matrix && matrix != view.compiled.matrix) {
            view.compiled.matrix = matrix;
            view.compiled.cones = std::make_shared<ConeHierarchy>(*matrix, moved.size);
            find_hud_box(view);
        }
        view.cube_m = cube_place(moved);
        view.beside_m = moved.picture.eye_m - view.cube_m;
    }
}

vk::DeviceSize ViewSet::memory() const
{
    vk::DeviceSize bytes = 0;
    for (const MapImage& map : maps)
        bytes += map.image.bytes + map.inverse.bytes;
    for (const ViewState& view : all)
        bytes += view.bloom ? view.bloom->memory() : 0;
    for (const OutputState& output : outputs)
        bytes += output.finish ? output.finish->memory() : 0;
    for (const std::unique_ptr<Inset>& inset : insets)
        bytes += inset->picture.bytes;
    return bytes;
}

} // namespace starbow
