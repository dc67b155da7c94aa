#include "view_descriptors.h"
#include "debug.h"
#include <algorithm>

namespace starbow {
ViewDescriptors::ViewDescriptors(Device& device, const GpuWorld& world, const FrameState& state, ViewSet& views,
    const EyeCubes& eyes, const StarPass& stars)
    : device_(device)
    , world_(world)
    , state_(state)
    , views_(views)
    , eyes_(eyes)
    , stars_(stars)
{
    linear_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, 0,
        false, 1, false, {}, 0, VK_LOD_CLAMP_NONE});
    name_object(device, linear_, "views: linear");
    nearest_ = device.device.createSampler({});
    name_object(device, nearest_, "views: nearest");
    finest_ = device.device.createSampler({{}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
        vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge});
    name_object(device, finest_, "views: finest");
    const float zeros[4] = {};
    range_ = make_mapped_buffer(device, sizeof(shared::RangeConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    name_object(device, range_, "views: range");
    nothing_ = make_texture(device, exact_format, {1, 1}, std::as_bytes(std::span(zeros)), false);
    name_object(device, nothing_, "views: nothing");
    no_maps_ = make_texture_array(device, exact_format, {1, 1}, 1, std::as_bytes(std::span(zeros)));
    name_object(device, no_maps_, "views: no maps");
    no_globes_ = make_mapped_buffer(device, sizeof(shared::GlobeConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    name_object(device, no_globes_, "views: no globes");
}

void ViewDescriptors::write()
{
    if (state_.range)
        write_range();
    for (ViewState& view : views_.all)
        write(view);
    for (const std::unique_ptr<Inset>& inset : views_.insets)
        if (state_.pattern == Pattern::none)
            write(inset->view);
}

void ViewDescriptors::write(ViewState& view)
{
    writes_.clear(), serials_.clear(), images_used_ = buffers_used_ = 0;
    if (*view.label_set)
        collect_label_set(view);
    if (state_.pattern == Pattern::none) {
        write_rest_frames(view);
        write_globes(view);
        collect_warp_set(view);
    }
    if (serials_ == view.written)
        return;
    device_.device.updateDescriptorSets(writes_, {});
    view.written = serials_;
}

void ViewDescriptors::image(
    const vk::raii::DescriptorSet& set, std::uint32_t binding, const Image& image, const vk::raii::Sampler& sampler)
{
    vk::DescriptorImageInfo& info = image_infos_[images_used_++];
    info = vk::DescriptorImageInfo(*sampler, *image.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    writes_.push_back({*set, binding, 0, 1, vk::DescriptorType::eCombinedImageSampler, &info});
    serials_.insert(serials_.end(), {image.serial, &sampler == &linear_ ? 1u : &sampler == &nearest_ ? 2u : 3u});
}

void ViewDescriptors::buffer(const vk::raii::DescriptorSet& set, std::uint32_t binding, const Buffer& buffer)
{
    vk::DescriptorBufferInfo& info = buffer_infos_[buffers_used_++];
    info = vk::DescriptorBufferInfo(*buffer.buffer, 0, VK_WHOLE_SIZE);
    writes_.push_back({*set, binding, 0, 1, vk::DescriptorType::eUniformBuffer, nullptr, &info});
    serials_.push_back(buffer.serial);
}

void ViewDescriptors::collect_label_set(const ViewState& view)
{
    image(view.label_set, 0, views_.map_of(view), nearest_);
    image(view.label_set, 1, *view.label.view ? view.label : nothing_, linear_);
}

void ViewDescriptors::collect_warp_set(const ViewState& view)
{
    const CubePass& cube = eyes_.all[view.eye].cube;
    const std::vector<Image>& atlases = cube.atlases();
    const ResponseBuffers& response = world_.response(eyes_.observer_of(view).shot.effects);
    const vk::raii::Sampler& filter = eyes_.plans[view.eye].levels > 1 ? linear_ : finest_;
    const vk::raii::DescriptorSet& set = view.warp_set;
    image(set, 0, views_.map_of(view), nearest_);
    constexpr std::uint32_t atlas_bindings[MAX_GROUPS] = {1, 7, 8, 9};
    const std::size_t groups = std::size_t(world_.spectra_of(cube.light()).groups);
    for (std::size_t group = 0; group < MAX_GROUPS; ++group)
        image(set, atlas_bindings[group], atlases[std::min(group, groups - 1)], filter);
    texel_views_ = {cube.tiles(), *response.texels};
    writes_.push_back({*set, 2, 0, 1, vk::DescriptorType::eUniformTexelBuffer, nullptr, nullptr, &texel_views_[0]});
    writes_.push_back({*set, 3, 0, 1, vk::DescriptorType::eUniformTexelBuffer, nullptr, nullptr, &texel_views_[1]});
    serials_.insert(serials_.end(), {cube.tiles_serial(), response.rows.serial});
    image(set, 4, state_.keeps_depth ? cube.depth() : nothing_, nearest_);
    image(set, 5, stars_.on() ? stars_.picture() : nothing_, nearest_);
    image(set, 6, views_.inverse_of(view), nearest_);
    buffer(set, 10, response.own_rows);
    image(set, 11, cube.several_rest_frames() ? atlases.back() : nothing_, filter);
    const FinishPass* finish = views_.finish_of(view);
    const Image* shares = finish ? finish->shares(view.geometry()) : nullptr;
    image(set, 13, shares ? *shares : nothing_, nearest_);
    buffer(set, 12, view.rest_frames);
    image(set, 14, world_.milky_way(), world_.milky_way_sampler());
    const GpuGlobes* globes = world_.globes.get();
    const bool false_colours = eyes_.observer_of(view).shot.effects[Effect::false_colours];
    buffer(set, 15, globes ? view.globes : no_globes_);
    image(set, 16, globes ? globes->maps : no_maps_, globes ? globes->map_sampler : nearest_);
    image(set, 17, globes ? globes->fine_maps : no_maps_, globes ? globes->map_sampler : nearest_);
    image(set, 18, !globes ? nothing_ : false_colours ? globes->false_light : globes->light, nearest_);
    image(set, 19, globes ? globes->rings : nothing_, globes ? globes->ring_sampler : nearest_);
    buffer(set, 20, range_);
    image(set, 21, *response.picture.view ? response.picture : nothing_, finest_);
}

void ViewDescriptors::write_globes(ViewState& view)
{
    if (!world_.globes)
        return;
    if (!*view.globes.buffer)
        view.globes = make_mapped_buffer(device_, sizeof(shared::GlobeConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    const RestFrameView& world = eyes_.observer_of(view).rest_frames[0];
    GpuGlobes::Seen seen = world_.globes->seen(eye_event_of(world, 0, glm::dvec3(0)));
    glm::dvec3 place = views_.scene_units(view.cube_m + view.beside_m);
    const double away = glm::length(place), most = world_.globes->farthest_eye(seen);
    if (away > most)
        place *= most / away;
    if (place != glm::dvec3(0))
        seen = world_.globes->seen(eye_event_of(world, 0, place));
    shared::GlobeConstants constants = world_.globes->constants(seen, state_.pre_exposure);
    world_.globes->add_glare(constants, seen, world.motion_from_frame, world.E, eyes_.observer_of(view).shot.effects);
    copy_to(view.globes, std::as_bytes(std::span(&constants, 1)));
    const bool in_any_case = state_.glows && world_.globes->have_glows();
    view.brightest_glow = in_any_case ? INFINITY : world_.globes->brightest_glow(seen, world.E);
}

void ViewDescriptors::write_range()
{
    shared::RangeConstants all{};
    const std::array<double, RANGE_KNOTS>& shown = state_.range->shown;
    for (std::size_t k = 0; k < shown.size(); ++k)
        all.knots[k]
            = glm::vec4(shown[k] + state_.shot.exposure_ev, k + 1 < shown.size() ? shown[k + 1] - shown[k] : 0, 0, 0);
    copy_to(range_, std::as_bytes(std::span(&all, 1)));
}

void ViewDescriptors::write_rest_frames(ViewState& view)
{
    if (!*view.rest_frames.buffer)
        view.rest_frames
            = make_mapped_buffer(device_, sizeof(shared::RestFrameConstants), vk::BufferUsageFlagBits::eUniformBuffer);
    const EyeCube& eye = eyes_.all[view.eye];
    const CubeMapPlan& plan = eyes_.plans[view.eye];
    const std::vector<RestFrameView>& rest_frames = eyes_.observer_of(view).rest_frames;
    shared::RestFrameConstants all{};
    std::size_t count = 0;
    for (std::size_t at = 0; at < rest_frames.size(); ++at) {
        const bool seen = std::any_of(plan.images.begin(), plan.images.end(),
            [&](const PlannedImage& image) { return std::size_t(image.rest_frame) == at; });
        if (at > 0 && !seen)
            continue;
        const RestFrameView& rest_frame = rest_frames[at];
        const glm::dmat3 turn = rest_frame.motion_from_cockpit * glm::transpose(rest_frames[0].motion_from_cockpit);
        shared::RestFrameEntry& entry = all.entries[count++];
        entry.row0 = shared::row(turn, 0);
        entry.row1 = shared::row(turn, 1, plan.finest_clip_level[at]);
        entry.row2 = shared::row(turn, 2);
        entry.cube0 = shared::row(rest_frame.cube_from_motion, 0);
        entry.cube1 = shared::row(rest_frame.cube_from_motion, 1);
        entry.cube2 = shared::row(rest_frame.cube_from_motion, 2);
        entry.boost = glm::vec4(rest_frame.E, 1 / rest_frame.E, at * TILE_COUNT, at);
        entry.eye = views_.eye_constants(view, rest_frame);
        entry.nearest.y = float(eye.nearest[at]);
        BoundingCap cap = eye.caps[at];
        cap.axis = glm::transpose(rest_frame.cube_from_motion) * cap.axis;
        const glm::dvec4 there = cap_in_ship(cap, rest_frame.E);
        entry.cap = glm::vec4(glm::transpose(turn) * glm::dvec3(there), there.w);
    }
    all.count[0].x = float(count);
    all.sky = sky_constants(world_, eye.cube.light(), rest_frames[0].cube_from_frame, state_.pre_exposure);
    copy_to(view.rest_frames, std::as_bytes(std::span(&all, 1)));
}

} // namespace starbow
