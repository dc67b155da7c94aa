#include "view_meter.h"
#include "debug.h"
#include <algorithm>

namespace starbow {

void ViewMeter::prepare()
{
    if (!state_.meters || meter_)
        return;
    std::vector<glm::ivec2> sizes;
    for (const ViewState& view : views_.all)
        sizes.push_back(state_.layout.outputs[view.output].preview ? glm::ivec2(0) : view.geometry().size);
    meter_ = std::make_unique<Meter>(device_, sizes, star_count_);
}

void ViewMeter::record(vk::CommandBuffer commands)
{
    if (!state_.meters)
        return;
    const Label label(device_, commands, "meter");
    const vk::RenderingAttachmentInfo picture = meter_->begin(commands);
    device_.begin_rendering(commands, {{}, {{0, 0}, meter_->extent()}, 1, 0, picture});
    for (std::size_t i = 0; i < views_.all.size(); ++i) {
        const ViewState& view = views_.all[i];
        if (!counts_here(view))
            continue;
        const Meter::Cell& cell = meter_->cell(i);
        shared::ViewPush constants = constants_.exposed_push(view, 1);
        constants.origin.x = float(cell.corner.x), constants.origin.y = float(cell.corner.y);
        const glm::dvec2 step = glm::dvec2(view.geometry().size) / glm::dvec2(cell.size);
        constants.zenith.z = float(step.x), constants.zenith.w = float(step.y);
        const vk::Pipeline pipeline = pipelines_.meter(constants_.variant_metered(view, state_.shot.effects));
        passes_.draw_warp(commands, view, pipeline, constants, cell.corner, cell.size);
        if (stars_.on() && star_count_ > 0)
            meter_stars(commands, view, meter_->star_cell(i));
    }
    device_.end_rendering(commands);
    meter_->end(commands);
}

void ViewMeter::meter_stars(vk::CommandBuffer commands, const ViewState& view, const Meter::Cell& cell)
{
    shared::ViewPush constants = constants_.star_push(view, {});
    constants.corner = glm::vec4(cell.size, meter_->every(), 0);
    const WarpVariant own = constants_.variant_metered(view, state_.shot.effects);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.star_meter(own));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *pipelines_.layouts.star_layout, 0, *view.warp_set, {});
    commands.pushConstants<shared::ViewPush>(*pipelines_.layouts.star_layout,
        vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
    stars_.sample(commands, view.observer, cell.corner, cell.size, meter_->every(), own.channels);
}

std::optional<double> ViewMeter::metered() const { return metered_ev(surfaces(), stars(), in_space_); }

std::span<const LuminanceSample> ViewMeter::surfaces() const
{
    return state_.meters && meter_ ? meter_->view() : std::span<const LuminanceSample>();
}

std::span<const LuminanceSample> ViewMeter::stars() const
{
    return state_.meters && meter_ ? meter_->stars() : std::span<const LuminanceSample>();
}

bool ViewMeter::counts_here(const ViewState& view) const
{
    const Output& output = state_.layout.outputs[view.output];
    return !output.preview && state_.is_here(output);
}

std::vector<ViewSamples> ViewMeter::own_samples() const
{
    std::vector<ViewSamples> all;
    for (std::size_t i = 0; state_.meters && meter_ && i < views_.all.size(); ++i) {
        if (!counts_here(views_.all[i]))
            continue;
        const std::span<LuminanceSample> surfaces = meter_->view(i), stars = meter_->stars(i);
        all.push_back({std::int32_t(i), {surfaces.begin(), surfaces.end()}, {stars.begin(), stars.end()}});
    }
    return all;
}

void ViewMeter::add_samples(std::span<const ViewSamples> others)
{
    for (const ViewSamples& other : others) {
        if (!state_.meters || !meter_ || other.view < 0 || std::size_t(other.view) >= views_.all.size()
            || counts_here(views_.all[std::size_t(other.view)]))
            continue;
        const std::span<LuminanceSample> surfaces = meter_->view(std::size_t(other.view)),
                                         stars = meter_->stars(std::size_t(other.view));
        if (surfaces.size() != other.surfaces.size() || stars.size() != other.stars.size())
            continue; // of another layout
        std::ranges::copy(other.surfaces, surfaces.begin());
        std::ranges::copy(other.stars, stars.begin());
    }
}

} // namespace starbow
