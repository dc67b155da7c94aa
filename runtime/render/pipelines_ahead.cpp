#include "pipelines_ahead.h"

namespace starbow {
namespace {

/// A kind of plan, as the warp's variant tells it.
struct PlanKind {
    bool single, cut, mips, unaligned;
};
/// Those that a flight meets from slow to fast; a switch meets the first three.
constexpr PlanKind plan_kinds[] = {{.cut = true}, {}, {.single = true}, {.mips = true}, {.cut = true, .mips = true},
    {.single = true, .unaligned = true}, {.unaligned = true}};
constexpr std::size_t kinds_of_a_switch = 3;

/// The present effects, then those with one switch turned.
std::array<Effects, 4> effects_ahead(const Effects& on)
{
    std::array<Effects, 4> all;
    all.fill(on);
    all[1].aberration = !on.aberration, all[2].doppler = !on.doppler, all[3].headlight = !on.headlight;
    return all;
}

} // namespace

bool make_pipeline_ahead(Pipelines& pipelines, const GpuWorld& world, const FrameState& state, const ViewSet& views,
    EyeCubes& eyes, const StarPass& stars, const ViewConstants& constants, const ViewMeter& meter)
{
    const std::size_t before = pipelines.count();
    const auto made = [&] { return pipelines.count() > before; };
    const std::array<Effects, 4> effects = effects_ahead(state.shot.effects);
    for (const ViewState& view : views.all)
        for (std::size_t i = 0; i < effects.size() && view.format != vk::Format::eUndefined; ++i) {
            WarpVariant variant = constants.in_flight(constants.variant_shown(view), effects[i]);
            for (std::size_t kind = 0; kind < (i == 0 ? std::size(plan_kinds) : kinds_of_a_switch); ++kind) {
                const PlanKind& plan = plan_kinds[kind];
                variant.single = plan.single, variant.cut = plan.cut, variant.mips = plan.mips;
                variant.unaligned = plan.unaligned;
                for (bool world_alone : {false, true}) {
                    variant.world_alone = world_alone;
                    if (world_alone <= variant.several_rest_frames)
                        pipelines.warp(variant, view.format);
                    if (made())
                        return true;
                }
            }
            if (stars.on()) {
                pipelines.stars(constants.in_flight(constants.variant_of_stars(view), effects[i]), stars.format());
                pipelines.dark(variant, view.format);
            }
            if (made())
                return true;
            eyes.all[view.eye].cube.make_ahead(world.stored_light(effects[i]));
            if (made())
                return true;
            meter.make_ahead(view, effects[i]);
            if (made())
                return true;
        }
    return false;
}

} // namespace starbow
