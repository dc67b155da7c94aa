#include "warm_up.h"
#include "debug.h"
#include <algorithm>
#include <bit>

namespace starbow {
namespace {

/// The states that a visitor meets soonest come first. combined: also the comparisons and false colours together with every
/// effect switched off.
std::vector<WarmUp::State> states_of(bool combined)
{
    using State = WarmUp::State;
    // Plans differ in kind with the speed: one image, several, tiles with several images, images with coarser levels. In
    // slow flight aside the cube map has other axes than the motion's.
    const State rest{}, slow{.u = {0, 0, -0.1}}, aside{.u = {0.06, 0, -0.08}};
    const State fast{.u = {0, 0, -4}, .cut = true, .mips = false}, faster{.u = {0, 0, -4}, .cut = true};
    const State few{.u = {0, 0, -4}, .mips = false}, fewer{.u = {0, 0, -100}}, fastest{.u = {0, 0, -1e5}};
    const State brisk{.u = {0, 0, -0.66}, .mips = false};
    constexpr Effects usual, none{.on = {}};
    std::vector<Effects> effects;
    for (const EffectEntry& one : all_effects)
        if (one.usual)
            effects.push_back(usual.without(one.which));
    effects.insert(effects.end(), {none, {.comparison = Comparison::galilean}, {.comparison = Comparison::no_light_delay}});
    for (const EffectEntry& one : all_effects)
        effects.push_back(one.usual ? none.with(one.which) : usual.with(one.which));
    for (unsigned set = 0; combined && set < 1u << all_effects.size(); ++set)
        for (Comparison comparison : {Comparison::none, Comparison::galilean, Comparison::no_light_delay}) {
            Effects& all = effects.emplace_back(Effects{.on = {}, .comparison = comparison});
            for (const EffectEntry& one : all_effects)
                all.on.set(one.which, set >> unsigned(one.which) & 1);
        }
    std::vector<State> states = {rest, slow, aside, brisk, few, fast};
    const auto with_effects = [&](State state) {
        for (const Effects& on : effects) {
            state.effects = on;
            states.push_back(state);
        }
    };
    const auto with_overlays = [&](State state) {
        for (Overlay overlay : drawn_overlays) {
            state.overlay = overlay;
            states.push_back(state);
        }
        state.overlay = Overlay::off, state.figures = true;
        states.push_back(state);
    };
    // Once an image has coarser levels, llvmpipe compiles anew what reads it: states without any come first.
    with_effects(fast);
    with_overlays(fast);
    states.insert(states.end(), {{.fade = 0.5}, faster, fewer, fastest});
    with_effects(faster);
    with_effects(slow);
    with_effects(brisk); // after slow flight the cube map keeps its axes
    with_overlays(slow);
    with_overlays(few);
    for (const State& state : {rest, few, aside, fewer, fastest})
        with_effects(state);
    with_overlays(rest);
    for (State state : {rest, slow, aside, brisk, few, fast, faster, fewer, fastest}) {
        state.range = true;
        states.push_back(state);
        state.range = false, state.glows = true;
        states.push_back(state);
    }
    for (std::size_t pattern = 1; pattern < pattern_names.size(); ++pattern)
        states.push_back({.pattern = Pattern(pattern)});
    return states;
}

/// The outputs' longest side, pixels, to which a warm-up shrinks them.
constexpr int small_side = 160;

/// A side of `whole` pixels as a part of it: a power of two if it is one, for llvmpipe compiles for either kind.
int small_part(int whole, double part)
{
    const auto small = unsigned(std::max(int(part * whole), 9));
    return int(std::has_single_bit(unsigned(whole)) ? std::bit_floor(small) : small + std::has_single_bit(small));
}

/// The part of a layout's sides that its inset has.
double shrinking(const Layout& layout)
{
    int longest = small_side;
    for (const Output& output : layout.outputs)
        longest = std::max({longest, output.size.x, output.size.y});
    return double(small_side) / longest;
}

Layout small_layout(Layout layout)
{
    const double part = shrinking(layout);
    for (Output& output : layout.outputs)
        output.size = {small_part(output.size.x, part), small_part(output.size.y, part)};
    return layout;
}

/// The quality with which an inset's plans are of the same kinds as the layout's.
Quality small_quality(Quality quality, const Layout& layout)
{
    quality.image_cost_texels *= shrinking(layout) * shrinking(layout);
    return quality;
}

} // namespace

WarmUp::WarmUp(Device& device, Pipelines& pipelines, const GpuWorld& world, const Layout& layout, const Quality& quality,
    const Shot& start, vk::Format format, bool meters, double bloom, bool draws)
    : device_(device)
    , pipelines_(pipelines)
    , start_(start)
    , quality_(small_quality(quality, layout))
    , states_(states_of(!device.on_processor()))
    , frame_(device, pipelines, world, small_layout(layout), quality_)
    , commands_(std::move(device.device.allocateCommandBuffers({*device.pool, vk::CommandBufferLevel::ePrimary, 1}).front()))
    , done_(device.device.createFence({}))
    , draws_(draws)
{
    frame_.meter(meters);
    frame_.bloom(bloom);
    for (const OutputState& output : frame_.views().outputs) {
        images_.push_back(make_image(device,
            {format, {std::uint32_t(output.size.x), std::uint32_t(output.size.y)},
                vk::ImageUsageFlagBits::eColorAttachment}));
        targets_.push_back({*images_.back().image, *images_.back().view, images_.back().extent, format});
    }
    name_object(device, commands_, "warm-up");
    name_object(device, done_, "warm-up done");
}

WarmUp::~WarmUp()
{
    if (submitted_)
        device_.settle();
}

bool WarmUp::ready() const { return !submitted_ || done_.getStatus() == vk::Result::eSuccess; }

bool WarmUp::step(const Panel* hud)
{
    if (submitted_) {
        device_.await(*done_, "the end of a warm-up's drawing (fence)");
        device_.device.resetFences(*done_);
        submitted_ = false;
    }
    constexpr std::size_t most_without = 4; // plans take the processor's time, too
    const std::size_t before = pipelines_.count();
    for (std::size_t i = 0; i < most_without && next_ < states_.size() && !submitted_; ++i) {
        const State& state = states_[next_++];
        Shot shot = start_;
        shot.effects = state.effects;
        shot.u = shot.ship_from_cockpit * state.u;
        Quality quality = quality_;
        quality.mips = quality.mips && state.mips;
        if (state.cut)
            quality.image_cost_texels = 0;
        frame_.adopt(quality);
        frame_.show(state.pattern);
        frame_.fade(state.fade);
        frame_.range(state.range ? std::optional(RangeCurve()) : std::nullopt);
        frame_.glows(state.glows);
        frame_.vignette({}, state.fade);
        frame_.measure({}); // the device has finished the overlay before
        if (state.figures)
            frame_.measure(Measuring{.over = {.figures = true}});
        else if (state.overlay != Overlay::off)
            frame_.measure(Measuring{.probes = {{glm::dvec3(0, 0, -1)}},
                .over = {.overlay = state.overlay},
                .panel = hud,
                .scale = {0.1, 0.1, 0.9, 0.2}});
        commands_.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        for (const Image& image : images_)
            transition(*commands_, image, vk::ImageLayout::eUndefined, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                {}, vk::ImageLayout::eColorAttachmentOptimal, vk::PipelineStageFlagBits2::eColorAttachmentOutput,
                vk::AccessFlagBits2::eColorAttachmentWrite);
        frame_.draw(*commands_, shot, hud, targets_);
        commands_.end();
        if (draws_ && pipelines_.count() > before) {
            const vk::CommandBufferSubmitInfo buffer(*commands_);
            device_.queue.submit2(vk::SubmitInfo2({}, {}, buffer, {}), *done_);
            submitted_ = true;
        }
    }
    return next_ < states_.size() || submitted_;
}

} // namespace starbow
