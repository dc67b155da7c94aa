#include "config/json/error.h"
#include "config/json/reader.h"
#include "config/json/whole_file.h"
#include "config/model/angles.h"
#include "config/model/file_kind.h"
#include "config/model/shipped.h"
#include "displays/check/floor_plan.h"
#include "displays/check/floor_plan_table.h"
#include "displays/check/lint.h"
#include "displays/compile/compiled_view.h"
#include "displays/finish/shade.h"
#include "exhibit_lines.h"
#include "flashes.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/hud/hud_place.h"
#include "runtime/images/capture.h"
#include "runtime/shadow/still_things.h"
#include "runtime/world/blended.h"
#include "runtime/world/globes.h"
#include "runtime/world/open_scene.h"
#include "runtime/world/spectral_errors.h"
#include "runtime/world/stars.h"
#include "runtime/world/worldline.h"
#include "world_sheet.h"
#include <cstdio>
#include <map>
#include <memory>

namespace starbow {
namespace {

/// Errors of colours that a visitor could notice beside the right ones.
constexpr double most_difference = 3, most_luminance = 0.03;

struct CheckOptions {
    std::string file, svg, scene, write, page;
    FlashOptions flashes;
};

/// The views of each output, none of a preview; adds the warnings about their meshes. Throws InputError for a layout that
/// can be read but not drawn.
std::vector<std::vector<CompiledView>> compiled(const Layout& layout, std::vector<std::string>& mesh_warnings)
{
    MapStore store;
    std::vector<std::vector<CompiledView>> all(layout.outputs.size());
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        if (!layout.outputs[output].preview) {
            const std::vector<CompiledView> views = all[output]
                = compile_output(store, layout, output, layout.outputs[output].size);
            reject_empty(layout, views);
            (void)shade_of(layout, output, layout.outputs[output].size, views, {});
            for (const CompiledView& view : views)
                if (view.mesh && view.view.eye != Eye::right) // the left eye has the same mesh
                    for (const std::string& warning : view.mesh->warnings)
                        mesh_warnings.push_back(viewport_name(layout, int(output), int(view.view.viewport)) + ", "
                            + one_line(layout.outputs[output].viewports[view.view.viewport].warp->file.filename().string())
                            + ": " + warning);
        }
    return all;
}

/// The directions of warped viewports' pixels, from their compiled maps.
ViewRegion region_of(const Layout& layout, const std::vector<std::vector<CompiledView>>& views)
{
    auto maps = std::make_shared<std::map<const Viewport*, CompiledView>>();
    for (std::size_t output = 0; output < layout.outputs.size(); ++output)
        for (const CompiledView& view : views[output])
            (*maps)[&layout.outputs[output].viewports[view.view.viewport]] = view;
    return [maps](const Output&, const Viewport& viewport, glm::dvec2 pixel) -> std::optional<glm::dvec3> {
        const DirectionMap& map = *maps->at(&viewport).map;
        const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(pixel)), glm::ivec2(0), map.size - 1);
        const glm::vec4 texel = map.at(at.x, at.y);
        return texel.w > 0 ? std::optional<glm::dvec3>(texel) : std::nullopt;
    };
}

int check(const CheckOptions& options)
{
    const std::filesystem::path layout_file = shipped_file("layouts", options.file);
    const Layout layout = load_layout(layout_file);
    const std::filesystem::path file = options.svg.empty() ? layout.name + "-plan.svg" : options.svg;
    check_not_read(file, {layout_file});
    check_ending(file, ".svg");
    check_writable(file);
    std::vector<std::string> mesh_warnings;
    const std::vector<std::vector<CompiledView>> views = compiled(layout, mesh_warnings);
    const std::vector<Coverage> shown = coverages(layout, region_of(layout, views));
    const HudPlacement hud = placed_hud(layout, {}, views);
    for (const FloorPlanRow& row : floor_plan_rows(layout, shown))
        std::printf("%s: %s; %s, %s of the sky; %s pixels, %s per degree\n", row.name.c_str(), row.projection.c_str(),
            row.spans.c_str(), row.sky.c_str(), row.pixels.c_str(),
            row.per_degree.empty() ? "none" : row.per_degree.c_str());
    for (const std::string& line : overlap_lines(layout, shown))
        std::printf("%s\n", line.c_str());
    for (const auto& lines : {mesh_warnings, lint(layout, shown)})
        for (const std::string& line : lines)
            std::printf("note: %s\n", line.c_str());
    if (const std::string line = hud_warning(layout, hud, views); !line.empty())
        std::printf("note: %s\n", line.c_str());
    if (file.has_parent_path())
        std::filesystem::create_directories(file.parent_path());
    write_whole(file, draw_floor_plan(layout, shown, hud));
    std::printf("%s\n", file.c_str());
    return 0;
}

/// The places of a scene's globes at its time 0, as an eye at its origin sees them.
void print_globes(const SceneFile& scene, const Globes& globes)
{
    const WorldOrigin origin = world_origin(globes.system, scene.globes.value());
    const glm::dmat3 turn = world_from_equatorial(scene.stars ? scene.stars->ahead_deg : glm::dvec2(0));
    const std::vector<glm::dvec3> places = globe_places_m(globes.system, origin.days);
    std::printf(
        "globes at %s's date from %s: place (x, y, z) at that time and radius, scene units; as %s sees it: light travel "
        "time in minutes, right ascension and declination (J2000)\n",
        scene.name.c_str(), scene.globes->origin.c_str(), scene.globes->origin.c_str());
    for (const SeenGlobe& one : globes_seen(globes, scene, {})) {
        const Globe& globe = globes.system.globes[one.globe];
        const glm::dvec3 n = glm::transpose(turn) * (one.from_eye / one.distance);
        const glm::dvec3 place = turn * (places[one.globe] - origin.place_m) / scene.unit_m;
        const double ascension = std::atan2(n.y, n.x) / degree;
        std::printf("  %-8s [%.9g, %.9g, %.9g] %.6g; %.3f min; %.3f %+.3f\n", globe.name.c_str(), place.x, place.y, place.z,
            globe.radius_m / scene.unit_m, one.distance * scene.seconds_per_time_unit() / 60,
            ascension < 0 ? ascension + 360 : ascension, std::asin(n.z) / degree);
    }
}

/// How the live picture represents the scene's light, and how far its colours are off at worst.
int check_scene(const std::string& name)
{
    const SceneFile scene = open_scene(shipped_file("scenes", name));
    World world = load_world(scene);
    if (world.globes)
        print_globes(scene, *world.globes);
    place_bodies(world, scene);
    note_lacking_shadows(scene, world, world.notes);
    note_crossing_blended(world, world.notes);
    for (const std::string& note : world.notes)
        std::printf("note: %s\n", note.c_str());
    const NeededLevel needed = needed_level(world, scene);
    std::printf("%s\n", describe(needed).c_str());
    const SceneErrors scene_errors = starbow::scene_errors(world, scene, needed.level);
    const SpectralErrors& off = scene_errors.errors;
    std::printf("colours at D from 1/8 to 8: CIEDE2000 median %.2f, worst %.2f; luminance %.1f %% at worst\n", off.median,
        off.worst, 100 * off.luminance);
    if (off.worst > most_difference || off.luminance > most_luminance)
        std::printf("note: the scene has more different spectra than coefficients; the worst are those of %s, with "
                    "CIEDE2000 %.1f. Fewer materials with reflectances of their own, or fewer lamps that pass, make it "
                    "exact\n",
            scene_errors.worst.c_str(), off.worst);
    return 0;
}

/// Refuses the options that the file's kind has no use for: somebody who gives one expects a file that would not come.
void refuse_others(const CheckOptions& options, bool world)
{
    const auto refuse = [](const char* option, const std::string& value, const char* right) {
        if (!value.empty())
            throw InputError(std::string(option) + " \"" + value + "\" is for " + right);
    };
    if (world)
        refuse("--svg", options.svg, "a layout or an exhibit; a world's page has its plan, and --page is right");
    else {
        refuse("--write", options.write, "a glTF world; a layout or an exhibit is not changed by its check");
        refuse("--page", options.page, "a world; a layout's or an exhibit's drawing is an .svg, and --svg is right");
    }
}

} // namespace

static void add_check(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<CheckOptions>();
    Subcommand* command = app.add_subcommand("check",
        "Read a layout, print what each viewport shows, and draw the floor plan; or an exhibit, with all that it names, its "
        "machines and its layout; or a world of your own, and show it; or a "
        "scene, and say how exact its light is; or a tour or a flight, and count its flashes.");
    Option* file = command->add_option("FILE", options->file,
        "A layout file, or the name of one in config/layouts: its viewports and its floor plan. Or an exhibit's file: "
        "all files that the exhibit names are read, and its machines and their network are listed. Or a scene file or a "
        "glTF "
        "world (.glb, .gltf): its size, its cost, what is drawn differently from the file, and a page with a plan and "
        "stills");
    Option* scene = command->add_option("--scene", options->scene,
        "A scene file, or the name of one in config/scenes: how its light is represented, the worst error of a colour, and "
        "the places "
        "of its globes");
    scene->excludes(file);
    Option* flashes = command->add_option("--flashes", options->flashes.film,
        "A tour file, the name of one in config/tours, or a record of starbow run --record (.jsonl): the flashes that an "
        "eye sees, by WCAG 2.3.1; exit status 1 where there are more than three in a second");
    flashes->excludes(file)->excludes(scene);
    command
        ->add_option("--layout", options->flashes.layout,
            "With --flashes: a layout file, or the name of one in config/layouts [desk; for a record its own]")
        ->needs(flashes);
    command
        ->add_option("--exposure-mode", options->flashes.mode,
            "With --flashes of a tour: as an eye sees it (eye), or by one curve that shows everything at once (range)")
        ->check(one_of({"eye", "range"}))
        ->needs(flashes)
        ->capture_default_str();
    command
        ->add_option(
            "--out", options->flashes.out, "With --flashes: the picture; without it NAME-flashes.png in the current folder")
        ->needs(flashes);
    command->add_option("--svg", options->svg, "The drawing; without it LAYOUT-plan.svg in the current folder")
        ->excludes(flashes);
    command->add_option("--write", options->write, "With a glTF world: write a suggested scene file for it, for you to edit")
        ->needs(file);
    command->add_option("--page", options->page, "With a world: the page; without it NAME-world.html in the current folder")
        ->needs(file);
    command->footer("Examples:\n  starbow check dome --svg out/dome.svg\n  starbow check our-dome.json\n  starbow check "
                    "my.glb --write my.json\n  starbow "
                    "check --scene chart\n"
                    "  starbow check --flashes first-minute --layout dome --out out/flashes.png");
    command->callback([options, file, scene, flashes, &chosen] {
        if (file->count() == 0 && scene->count() == 0 && flashes->count() == 0)
            require_one_of("FILE, --scene or --flashes");
        chosen = [options] {
            if (!options->flashes.film.empty())
                return check_flashes(options->flashes);
            if (!options->scene.empty())
                return check_scene(options->scene);
            const std::optional<FileKind> kind = kind_of_file(options->file);
            const bool world = kind == FileKind::scene || kind == FileKind::gltf;
            refuse_others(*options, world);
            if (kind == FileKind::exhibit) {
                CheckOptions of_layout = *options;
                of_layout.file = print_exhibit(options->file);
                return check(of_layout);
            }
            if (world)
                return check_world(options->file, options->page, options->write);
            return check(*options);
        };
    });
}

static const Registered check_command{3, add_check};

} // namespace starbow
