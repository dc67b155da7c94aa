#include "view_constants.h"
#include "config/model/angles.h"
#include <algorithm>
#include <cmath>

namespace starbow {
namespace {

/// Up to so many, the warp pass keeps each rest frame's part in a variable of its own: lavapipe draws a world of two or
/// three in 0.75 to 0.85 of the time, and one of five in 1.1 of it. More share an array, and a pipeline. On a GPU any number
/// does: the twins' dearest variants take 120 registers in place of 168, and 0.79 of the cycles (`bench --shaders`).
constexpr int few_rest_frames = 4;

/// The effects' constants in the shaders, in the order of `Effect`; null: it is none. False colours are another observer.
constexpr bool WarpVariant::*effect_constants[]{
    &WarpVariant::aberration, &WarpVariant::doppler, &WarpVariant::headlight, nullptr};
static_assert(std::size(effect_constants) == all_effects.size(), "a new effect is a constant of the shaders, or null");

/// moves: false where D is 1 everywhere, so that no effect is seen.
void set_effects(WarpVariant& variant, const Effects& on, bool moves)
{
    for (const EffectEntry& one : all_effects)
        if (const auto constant = effect_constants[std::size_t(one.which)])
            variant.*constant = on[one.which] && moves;
}

/// The square root of the determinant of a flat view's matrix M: a pixel's solid angle is det M / length^3.
double unit_of(const CompiledView& view) { return view.matrix ? std::sqrt(std::abs(glm::determinant(*view.matrix))) : 0; }

} // namespace

bool ViewConstants::reprojects(const ViewState& view) const { return state_.reprojects() && view.beside_m != glm::dvec3(0); }

const PlannedImage* ViewConstants::single_image(const ViewState& view) const
{
    const std::vector<PlannedImage>& images = eyes_.plans[view.eye].images;
    const bool only = images.size() == 1 && images[0].rest_frame == 0 && images[0].tile == TILE_FRONT;
    return only && !reprojects(view) ? &images[0] : nullptr;
}

WarpVariant ViewConstants::variant(const ViewState& view) const
{
    const bool moves = eyes_.observer_of(view).E != 1
        || eyes_.all[view.eye].cube.several_rest_frames(); // without motion D is 1 everywhere
    const Effects& on = eyes_.observer_of(view).shot.effects;
    WarpVariant variant;
    variant.map = view.compiled.map != nullptr, variant.channels = view.compiled.channels() == 3;
    set_effects(variant, on, moves);
    variant.mips = eyes_.plans[view.eye].levels > 1;
    variant.reproject = reprojects(view), variant.turning = variant.reproject && state_.layout.stereo.turning;
    variant.stars = !world_.stars.stars.empty() || world_.globes;
    const StoredLight light = eyes_.all[view.eye].cube.light();
    variant.coefficients = world_.coefficients(light);
    variant.several_rest_frames = eyes_.all[view.eye].cube.several_rest_frames();
    const int rest_frames = variant.several_rest_frames ? int(world_.world.frames.size()) : 1;
    variant.milky_way = variant.several_rest_frames && world_.world.milky_way >= 0;
    variant.rest_frames = rest_frames <= (world_.as_gpu ? 1 : few_rest_frames) ? rest_frames : MAX_REST_FRAMES;
    variant.single = single_image(view);
    variant.cut = eyes_.plans[view.eye].cut;
    variant.cube_samples = state_.quality.cube_samples;
    const std::vector<RestFrameView>& read = eyes_.observer_of(view).rest_frames;
    variant.unaligned = !std::all_of(read.begin(), variant.several_rest_frames ? read.end() : read.begin() + 1,
        [](const RestFrameView& one) { return one.aligned(); });
    if (world_.globes)
        variant.globes = world_.globes->count(), variant.each_globe = world_.as_gpu, variant.glows = view.brightest_glow > 0;
    variant.galilean = on.comparison == Comparison::galilean;
    variant.by_table = variant.doppler || needs_table(on, light);
    return variant;
}

bool ViewConstants::needs_table(const Effects& on, StoredLight light) const
{
    // A base colour at rest is the shown one.
    return light == StoredLight::coefficients
        && (on[Effect::false_colours] || world_.coefficients(light) != CoefficientCounts{} || world_.spectra.matrices);
}

WarpVariant ViewConstants::in_flight(WarpVariant variant, const Effects& on) const
{
    set_effects(variant, on, true);
    const StoredLight light = world_.stored_light(on);
    variant.coefficients = world_.coefficients(light);
    variant.by_table = on[Effect::doppler] || needs_table(on, light);
    return variant;
}

WarpVariant ViewConstants::variant_shown(const ViewState& view) const
{
    WarpVariant all = variant(view);
    all.rays = eyes_.rays_of(view);
    all.sampled_response = world_.as_gpu;
    constexpr double unseen = 1.0 / 8192; // of white: less than half of an 8-bit step
    const double exposure = state_.exposure_of(eyes_.observer_of(view).shot);
    const bool dim = !state_.all_light && !state_.range && view.brightest_glow * exposure < unseen;
    all.glows = all.glows && !dim;
    return all;
}

WarpVariant ViewConstants::variant_of_stars(const ViewState& view) const
{
    WarpVariant all = variant(view);
    all.mips = all.single = all.glows = false;
    all.cut = all.unaligned = true; // no pipeline for each kind of plan
    return all;
}

WarpVariant ViewConstants::variant_metered(const ViewState& view, const Effects& on) const
{
    WarpVariant all = in_flight(variant_of_stars(view), on);
    all.mips = true;
    all.range = state_.range.has_value(), all.glows = view.brightest_glow > 0;
    all.layered = views_.outputs[view.output].layers() > 1;
    return all;
}

shared::ViewPush ViewConstants::push(const ViewState& view, const glm::dmat3& axes_from_cockpit) const
{
    const glm::dmat3 m = axes_from_cockpit * view.compiled.matrix.value_or(glm::dmat3(1));
    const ResponseBuffers& response = world_.response(eyes_.observer_of(view).shot.effects);
    const vk::Extent2D atlas = eyes_.all[view.eye].cube.atlases()[0].extent;
    shared::ViewPush push{};
    push.row0 = shared::row(m, 0, unit_of(view.compiled));
    push.row1 = shared::row(m, 1, state_.pattern == Pattern::none ? eyes_.plans[view.eye].finest_clip_level[0] : 0);
    push.row2 = shared::row(m, 2, response.at_rest);
    push.origin = glm::vec4(view.geometry().corner, 1.0 / atlas.width, 1.0 / atlas.height);
    push.corner = glm::vec4(view.geometry().corner, 2 * response.last_log2_D, response.octave);
    if (state_.pattern == Pattern::none) {
        const PlannedImage* single = single_image(view);
        push.eye = single ? tile_entry(*single).texel_from_face
                          : views_.eye_constants(view, eyes_.observer_of(view).rest_frames[0]);
        push.zenith.y = float(eyes_.all[view.eye].nearest[0]);
    }
    push.zenith.x = float(std::sin(state_.layout.stereo.full_from_zenith_deg * degree));
    push.zenith.z = float(view.geometry().size.x), push.zenith.w = float(view.geometry().size.y);
    return push;
}

glm::vec4 ViewConstants::boost(const ViewState& view, double exposure) const
{
    // A finite exposure keeps darkness dark: 0 times infinity is NaN.
    const double E = eyes_.observer_of(view).E;
    return glm::vec4(E, 1 / E, std::min(exposure / state_.pre_exposure, 1e37), near_distance);
}

shared::ViewPush ViewConstants::star_push(const ViewState& view, std::optional<double> exposure) const
{
    const Observer& own = eyes_.observer_of(view);
    shared::ViewPush constants = push(view, own.rest_frames[0].motion_from_cockpit);
    constants.boost = glm::vec4(own.E, 1 / own.E, std::min(exposure.value_or(1), 1e37), near_distance);
    const glm::dmat3 back
        = glm::inverse(own.rest_frames[0].motion_from_cockpit * view.compiled.matrix.value_or(glm::dmat3(1)));
    constants.row0 = shared::row(back, 0, constants.row0.w);
    constants.row1 = shared::row(back, 1, constants.row1.w);
    constants.row2 = shared::row(back, 2, exposure && !state_.range ? GLARE_SHOWN : 0);
    return constants;
}

shared::ViewPush ViewConstants::exposed_push(const ViewState& view, double exposure) const
{
    shared::ViewPush constants = push(view, eyes_.observer_of(view).rest_frames[0].motion_from_cockpit);
    constants.boost = boost(view, exposure);
    if (!reprojects(view))
        constants.zenith.x = std::log2(constants.boost.z);
    return constants;
}

} // namespace starbow
