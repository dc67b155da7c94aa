#include "explain.h"
#include "runtime/commands/median.h"
#include "runtime/render/pass_timer.h"
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

namespace starbow {
namespace {

/// All that a frame is made from.
struct Made {
    World world;
    SceneFile scene;
    std::vector<Star> stars;
    Layout layout;
    Shot shot;
    Quality quality;
    bool meter = false;
    double bloom = 0;
};

struct Part {
    std::string name;
    bool on;
    std::string why; ///< it is on, or off
    std::function<void(Made&)> turn; ///< makes it the other way; none where there is no other way
};

std::string count(std::size_t n, const std::string& one, const std::string& many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

template <class Is> std::size_t materials_that(const World& world, Is&& is)
{
    std::size_t n = 0;
    for (const Material& material : world.materials)
        n += is(material);
    return n;
}

/// The views of a layout, counted.
struct ViewCounts {
    std::size_t views = 0, maps = 0, eyes = 0;
    bool colours_part = false; ///< a lens parts them
};

/// The parts of a frame as they are found, in order.
struct PartList {
    const Made& made;
    const RenderContext& context;
    std::vector<Part> all{};

    void add(const std::string& name, bool on, const std::string& why, const std::string& why_not,
        std::function<void(Made&)> turn)
    {
        all.push_back({name, on, on ? why : why_not, std::move(turn)});
    }
    void add_effects();
    void add_light();
    void add_world();
    void add_views(const ViewCounts& views);
    void add_sampling(const CubeMapPlan& plan);
};

void PartList::add_effects()
{
    const Effects& effects = made.shot.effects;
    const bool moves = made.shot.u != glm::dvec3(0);
    const std::string at_rest = moves ? "the shot's effects leave it out" : "the shot is at rest";
    add("aberration", moves && effects[Effect::aberration], "the ship moves", at_rest,
        [](Made& m) { m.shot.effects.on.flip(Effect::aberration); });
    add("Doppler shift of spectra", moves && effects[Effect::doppler], "the ship moves", at_rest,
        [](Made& m) { m.shot.effects.on.flip(Effect::doppler); });
    add("headlight, D^3", moves && effects[Effect::headlight], "the ship moves", at_rest,
        [](Made& m) { m.shot.effects.on.flip(Effect::headlight); });
}

void PartList::add_light()
{
    const SceneFile& scene = made.scene;
    const NeededLevel needed = needed_level(context.world.world, scene);
    const int coefficients = context.world.spectra.basis.reflected;
    const bool unshifted = context.world.stored_light(made.shot.effects) == StoredLight::unshifted;
    const std::string colours = "without the Doppler effect the colours themselves are stored";
    add("light in more than 3 coefficients", coefficients > 3 && !unshifted,
        std::to_string(coefficients) + ": " + describe(needed), unshifted ? colours : describe(needed),
        [](Made& m) { m.quality.spectra = m.quality.spectra ? std::nullopt : std::optional(SpectralLevel::colours); });
    const bool own = !context.world.spectra.basis.own.empty();
    add("emissions of the scene's own", own && !unshifted,
        count(context.world.spectra.basis.own.size(), "lamp, glow or line", "lamps, glows or lines")
            + " each a coefficient of its own",
        own ? colours : "the scene has no lamp, glow or line but sunlit colours", {});
    add("stars", !context.world.stars.stars.empty(),
        count(context.world.stars.stars.size(), "star", "stars") + " in the scene's sky", "the scene names no catalogue",
        [](Made& m) { m.stars.clear(), m.scene.stars.reset(); });
    add("the Milky Way", context.world.world.milky_way >= 0, "a panorama behind the stars", "the scene names none",
        [](Made& m) { m.world.milky_way = -1; });
    const int globes = context.world.globes ? context.world.globes->count() : 0;
    add("globes", globes > 0, count(std::size_t(globes), "globe", "globes") + " before the sky, each pixel by itself",
        "the scene has no Sun, planets and moons", [](Made& m) { m.world.globes.reset(), m.scene.globes.reset(); });
    add("lamps", !scene.lights.empty(), count(scene.lights.size(), "light", "lights") + " in the scene",
        "the scene has none", [](Made& m) { m.scene.lights.clear(); });
}

void PartList::add_world()
{
    const World& world = context.world.world;
    const std::size_t clocks = materials_that(world, [](const Material&m) { return m.clock.has_value(); }),
                      blinks = materials_that(world, [](const Material&m) { return m.blink.has_value(); }),
                      base = materials_that(world, [](const Material&m) { return m.base_texture >= 0; }),
                      masked = materials_that(world, [](const Material&m) { return m.alpha_cutoff > 0 && !m.blended; });
    add("clocks, with light delay", clocks > 0, count(clocks, "dial", "dials") + " in the world", "no surface is a clock",
        [](Made& m) {
            for (Material& material : m.world.materials)
                material.clock.reset();
        });
    add("what blinks", blinks > 0, count(blinks, "surface", "surfaces"), "nothing blinks", [](Made& m) {
        for (Material& material : m.world.materials)
            material.blink.reset();
    });
    add("what moves by itself", !world.motions.empty(), count(world.motions.size(), "motion", "motions") + " in the world",
        "nothing spins and nothing is animated", [](Made& m) {
            for (Instance& instance : m.world.instances)
                instance.motion = instance.deformation = -1;
            for (Primitive& primitive : m.world.primitives)
                primitive.deforming = -1;
        });
    add("bodies in frames of their own", world.frames.size() > 1,
        count(world.frames.size() - 1, "velocity", "velocities") + " beside rest", "every body of the scene stands still",
        [](Made& m) {
            m.scene.bodies.clear();
            std::erase_if(m.scene.lights, [](const Light& light) {
                const PointLight* point = std::get_if<PointLight>(&light);
                return point && !point->body.empty();
            });
        });
    add("pictures on surfaces", base > 0, count(base, "surface has", "surfaces have") + " one", "no surface has one",
        [](Made& m) {
            for (Material& material : m.world.materials)
                material.base_texture = -1;
        });
    add("holes in surfaces", masked > 0, count(masked, "surface has", "surfaces have") + " them", "no surface is masked",
        [](Made& m) {
            for (Material& material : m.world.materials)
                material.alpha_cutoff = 0;
        });
}

void PartList::add_views(const ViewCounts& views)
{
    add("one cube map for each eye", views.eyes > 1,
        std::to_string(views.eyes) + ": the eyes of the layout see from so many places",
        "the layout has one eye, or all share one map", [](Made& m) { m.quality.stereo = StereoMethod::shared; });
    add("reprojection of two eyes", made.layout.stereo.method == StereoMethod::reprojected && views.views > 1,
        "the layout's stereo method", "the layout's stereo method is another",
        [](Made& m) { m.layout.stereo.turning = false, m.quality.stereo = StereoMethod::shared; });
    add("maps of directions", views.maps > 0,
        std::to_string(views.maps) + " of " + count(views.views, "view is", "views are") + " not linear in the pixel",
        "every view is flat: a matrix describes it", [](Made& m) { m.quality.matrices = !m.quality.matrices; });
    add("a direction of its own for each colour", views.colours_part, "a lens parts them", "no lens parts them", {});
    bool shades = made.layout.blend.ramps;
    for (const Output& output : made.layout.outputs)
        shades |= needs_finish(output, {});
    add("blend, colour and packing of outputs", shades, "the layout asks for it", "each output shows its picture as it is",
        [](Made& m) {
            m.layout.blend.ramps = false;
            for (Output& output : m.layout.outputs)
                output.colour = {};
        });
}

void PartList::add_sampling(const CubeMapPlan& plan)
{
    add("images nested behind", plan.finest_clip_level[0] > 0 && plan.images.size() > 1,
        count(plan.images.size(), "image", "images") + " of the cube map, D varies over the sky", "D is the same everywhere",
        [](Made& m) { m.quality.clip_levels = m.quality.clip_levels > 0 ? 0 : 42; });
    add("coarser images, mips", plan.levels > 1, "several texels fall into one pixel somewhere", "nowhere more than two",
        [](Made& m) { m.quality.mips = !m.quality.mips; });
    add("samples of a texel", made.quality.cube_samples > 1, std::to_string(made.quality.cube_samples) + ", by the quality",
        "the quality has one", [](Made& m) { m.quality.cube_samples = m.quality.cube_samples > 1 ? 1 : 4; });
    add("rays of a pixel", made.quality.pixel_rays > 1,
        std::to_string(made.quality.pixel_rays * made.quality.pixel_rays) + ", by the quality", "the quality has one",
        [](Made& m) { m.quality.pixel_rays = m.quality.pixel_rays > 1 ? 1 : 2; });
    add("metering of the exposure", made.meter, "", "a still has its own; starbow run meters",
        [](Made& m) { m.meter = !m.meter; });
    add("glow around what shines", made.bloom > 0, "", "the exhibit or --bloom asks for it", [](Made& m) { m.bloom = 0.1; });
}

/// One way to make a frame, on the device.
struct MadeFrame {
    GpuWorld world;
    OffscreenRenderer renderer;
    Shot shot;
    MadeFrame(Device& device, Pipelines& pipelines, const Made& made)
        : world(upload(device, pipelines, made.world, made.scene, made.stars, made.quality.spectra))
        , renderer(device, pipelines, world, made.layout, within(device, made.quality), false)
        , shot(made.shot)
    {
        renderer.frame().meter(made.meter);
        renderer.frame().bloom(made.bloom);
    }
    double ms(Device& device) { return PassTimer(device, renderer).frame(shot); }
};

ViewCounts count_views(const Trial& trial)
{
    ViewCounts counts;
    MapStore store;
    store.matrices(trial.standard.matrices);
    for (std::size_t output = 0; output < trial.layout.outputs.size(); ++output)
        for (const CompiledView& view : compile_output(store, trial.layout, output, trial.layout.outputs[output].size)) {
            ++counts.views;
            counts.maps += view.map != nullptr;
            counts.colours_part |= view.channels() == 3;
        }
    return counts;
}

/// The time of a frame over that of a frame without the part: medians of rounds in turn.
double cost_of(const Part& part, const Made& made, RenderContext& context, MadeFrame& all, int rounds)
{
    Made without = made;
    part.turn(without);
    MadeFrame other(context.device, context.pipelines, without);
    std::vector<double> with_ms, without_ms;
    for (int round = -2; round < rounds; ++round) {
        const double a = all.ms(context.device), b = other.ms(context.device);
        if (round >= 0)
            with_ms.push_back(a), without_ms.push_back(b);
    }
    return median(with_ms) / median(without_ms);
}

} // namespace

void explain(const Trial& trial, const Device::Options& options)
{
    LoadedScene loaded = load_scene(trial.scene);
    const Made made{std::move(loaded.world), std::move(loaded.scene), std::move(loaded.stars), trial.layout,
        trial.shots[0].second, trial.standard};
    RenderContext context(trial.scene, options, trial.standard.spectra);
    MadeFrame all(context.device, context.pipelines, made);
    all.ms(context.device);

    const std::vector<CubeMapPlan>& plans = all.renderer.frame().plans();
    ViewCounts views = count_views(trial);
    views.eyes = plans.size();
    PartList parts{made, context};
    parts.add_effects();
    parts.add_light();
    parts.add_world();
    parts.add_views(views);
    parts.add_sampling(plans[0]);
    std::printf("%s, %s, %s, on %s\n\nOn, and the time of a frame with it over one without:\n", trial.scene.stem().c_str(),
        trial.layout.file.stem().c_str(), trial.shots[0].first.c_str(), context.device.name());
    for (const Part& part : parts.all) {
        if (!part.on)
            continue;
        char cost[32] = "-";
        if (part.turn)
            std::snprintf(cost, sizeof cost, "%.2f", cost_of(part, made, context, all, trial.rounds));
        std::printf("  %-38s %6s   %s\n", part.name.c_str(), cost, part.why.c_str());
        std::fflush(stdout);
    }
    std::printf("\nOff, at no cost:\n");
    for (const Part& part : parts.all)
        if (!part.on)
            std::printf("  %-38s          %s\n", part.name.c_str(), part.why.c_str());
}

} // namespace starbow
