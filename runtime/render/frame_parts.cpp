// What a frame is made of: a layout's views with their maps and eyes, taken up at the start and whenever the layout, an
// output's size or the quality changes.
#include "config/model/angles.h"
#include "displays/compile/inverse_map.h"
#include "displays/finish/blend.h"
#include "frame.h"
#include "runtime/hud/hud_place.h"
#include <algorithm>
#include <cmath>

namespace starbow {

Frame::Frame(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
    bool keeps_depth)
    : quality_(quality)
    , device_(device)
    , pipelines_(pipelines)
    , world_(world)
    , layout_(with_stereo(layout, quality))
    , keeps_depth_(keeps_depth || reprojects() || world.star_count > 0 || world.layered())
    , stars_(device, pipelines, world)
{
    linear_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, 0,
        false, 1, false, {}, 0, VK_LOD_CLAMP_NONE});
    nearest_ = device.device.createSampler({});
    finest_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    const float zeros[4] = {};
    nothing_ = make_texture(device, exact_format, {1, 1}, std::as_bytes(std::span(zeros)), false);
    no_rest_frames_ = make_mapped_buffer(device, sizeof(shared::RestFrameConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    no_map_ = make_texture_array(device, map_format, {1, 1}, 1, std::as_bytes(std::span(zeros, 2)));
    for (const Output& output : layout_.outputs)
        outputs_.emplace_back().size = output.size;
    store_.matrices(quality.matrices || layout.head_tracker); // a map does not follow a head
    apply_layout(parts(true));
}

void Frame::resize(std::size_t output, glm::ivec2 size)
{
    if (outputs_[output].size == size)
        return;
    outputs_[output].size = size;
    apply_layout(parts(false)); // a window may be dragged so small that a viewport is left with nothing
}

void Frame::adopt(const Layout& layout)
{
    store_.keep(false);
    const Layout before = std::exchange(layout_, with_stereo(layout, quality_));
    try {
        apply_layout(parts(true));
    } catch (const InputError&) {
        layout_ = before;
        store_.keep(true);
        throw;
    }
    store_.keep(true);
}

void Frame::repeatable(bool on)
{
    repeatable_ = on;
    for (Eye& eye : eyes_)
        eye.cube.repeatable(on);
}

void Frame::adopt(const Quality& quality)
{
    const Quality before = std::exchange(quality_, quality);
    cubes_drawn_ = false;
    for (Eye& eye : eyes_)
        eye.cube.adopt(quality);
    if (quality.cube_samples == before.cube_samples && quality.half_floats == before.half_floats)
        return;
    eyes_.clear(), observers_.clear();
    apply_layout(parts(false));
}

void Frame::move_head(const Head& head)
{
    for (ViewState& view : views_) {
        View moved = view.view();
        const glm::dvec3 beside = moved.picture.eye_m - moved.head_m;
        moved.head_m += head.moved_m;
        moved.picture.eye_m = moved.head_m + head.turned * beside;
        if (auto matrix = view.compiled.map ? std::nullopt : view_matrix(moved); matrix && matrix != view.compiled.matrix) {
            view.compiled.matrix = matrix;
            view.compiled.cones = std::make_shared<ConeHierarchy>(*matrix, moved.size);
            find_hud_box(view);
        }
        Eye& eye = eyes_[view.eye];
        eye.now_m = place_of_eye(moved);
        view.beside_m = moved.picture.eye_m - eye.now_m;
    }
}

Frame::Parts Frame::parts(bool refuses_dark)
{
    Parts parts;
    std::vector<CompiledView> lit; // by projectors, not previews
    for (std::size_t output = 0; output < outputs_.size(); ++output) {
        parts.views.push_back(compile_output(store_, layout_, output, outputs_[output].size));
        if (!layout_.outputs[output].preview)
            lit.insert(lit.end(), parts.views.back().begin(), parts.views.back().end());
    }
    if (refuses_dark)
        reject_empty(layout_, lit);
    std::vector<std::vector<float>> ramps;
    if (layout_.blend.ramps)
        ramps = blend_ramps(layout_, lit, layout_.blend.power);
    parts.shades.resize(outputs_.size());
    for (std::size_t output = 0; output < outputs_.size(); ++output)
        if (!layout_.outputs[output].preview)
            parts.shades[output] = shade_of(layout_, output, outputs_[output].size, lit, ramps);
    return parts;
}

void Frame::apply_layout(Parts parts)
{
    hud_place_ = {panel_from_cockpit(layout_.hud, parts.views),
        std::tan(0.5 * layout_.hud.width_deg * degree) * glm::dvec2(1, panel_aspect)};
    std::vector<ViewState> before = std::exchange(views_, {}); // whose maps are found again
    std::vector<Map> maps_before = std::exchange(maps_, {});
    for (std::size_t output = 0; output < outputs_.size(); ++output)
        for (CompiledView& compiled : parts.views[output]) {
            ViewState view;
            view.output = output;
            view.compiled = std::move(compiled);
            views_.push_back(std::move(view));
        }
    const double room = headroom(parts.shades);
    for (std::size_t output = 0; output < outputs_.size(); ++output) {
        Output own = layout_.outputs[output];
        own.size = outputs_[output].size;
        outputs_[output].finish.reset();
        if (needs_finish(own, parts.shades[output]) || (room != 1 && !own.preview))
            outputs_[output].finish = std::make_unique<FinishPass>(device_, pipelines_, own, parts.shades[output], room);
    }

    for (ViewState& view : views_) {
        view.eye = eye_for(view.view());
        view.beside_m = view.view().picture.eye_m - eyes_[view.eye].now_m;
        view.map = map_for(view.compiled, maps_before);
        find_hud_box(view);
    }
    plans_.resize(eyes_.size());
    cubes_drawn_ = false;
    meter_.reset();
    forget_lab();

    const std::uint32_t count = std::uint32_t(views_.size());
    before.clear();
    pool_ = nullptr;
    std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eUniformBuffer, 2 * count},
        {vk::DescriptorType::eUniformTexelBuffer, 2 * count}, {vk::DescriptorType::eCombinedImageSampler, 11 * count}};
    pool_ = device_.device.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 2 * count, sizes});
    auto make_set = [&](const vk::raii::DescriptorSetLayout& set_layout) {
        return std::move(device_.device.allocateDescriptorSets({*pool_, *set_layout}).front());
    };
    for (ViewState& view : views_) {
        view.warp_set = make_set(pipelines_.warp_set);
        view.label_set = make_set(pipelines_.picture_set);
    }
}

/// Where the view's cube map is drawn from.
glm::dvec3 Frame::place_of_eye(const View& view) const
{
    return layout_.stereo.method == StereoMethod::exact ? view.picture.eye_m : view.head_m;
}

std::size_t Frame::eye_for(const View& view)
{
    const glm::dvec3 place = place_of_eye(view);
    const auto whose = std::find_if(
        observers_.begin(), observers_.end(), [&](const Observer& observer) { return observer.observer == view.observer; });
    const std::size_t own = std::size_t(whose - observers_.begin());
    if (whose == observers_.end())
        observers_.push_back({view.observer});
    auto same
        = std::find_if(eyes_.begin(), eyes_.end(), [&](const Eye& e) { return e.place_m == place && e.observer == own; });
    if (same == eyes_.end()) {
        eyes_.push_back({place, own, CubePass(device_, pipelines_, world_, quality_, keeps_depth_), place});
        same = eyes_.end() - 1;
        same->cube.repeatable(repeatable_);
    }
    same->now_m = place;
    return std::size_t(same - eyes_.begin());
}

std::optional<std::size_t> Frame::map_for(const CompiledView& view, std::vector<Map>& before)
{
    if (!view.map)
        return {};
    for (std::size_t i = 0; i < maps_.size(); ++i)
        if (maps_[i].directions == view.map)
            return i;
    for (Map& old : before)
        if (old.directions == view.map) {
            maps_.push_back(std::move(old));
            return maps_.size() - 1;
        }
    const std::vector<glm::uvec2> texels = packed(*view.map);
    maps_.push_back({view.map,
        make_texture_array(
            device_, map_format, view.map->size, std::uint32_t(view.map->channels), std::as_bytes(std::span(texels)))});
    if (stars_.on()) {
        const InverseMap inverse = starbow::inverse(*view.map);
        maps_.back().closes = inverse.closes;
        maps_.back().inverse = make_texture_array(device_, inverse_format, glm::ivec2(inverse.side),
            std::uint32_t(inverse.channels), std::as_bytes(std::span(inverse.cells)));
    }
    return maps_.size() - 1;
}

PixelBox Frame::panel_in(const ConeHierarchy& cones) const
{
    return panel_box(cones, hud_place_.panel_from_cockpit, hud_place_.half);
}

/// Or what stands in for one.
const Image& Frame::map_of(const ViewState& view) const { return view.map ? maps_[*view.map].image : no_map_; }

void Frame::find_hud_box(ViewState& view) const
{
    const PixelBox box = panel_in(*view.compiled.cones);
    view.hud_box = rect_of(view.view().corner + box.low, box.high - box.low);
}

int Frame::hud_width() const
{
    double finest = 1;
    for (const ViewState& view : views_)
        finest = std::min(finest, double(panel_in(*view.compiled.cones).finest));
    return std::clamp(int(2 * hud_place_.half.x / finest), 160, 4096);
}

} // namespace starbow
