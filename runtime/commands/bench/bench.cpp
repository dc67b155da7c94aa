#include "bodies.h"
#include "card.h"
#include "config/json/whole_file.h"
#include "counts.h"
#include "cubes.h"
#include "estimate.h"
#include "flight.h"
#include "frame_stages.h"
#include "governor.h"
#include "input.h"
#include "layout.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/tools.h"
#include "runtime/images/capture.h"
#include "runtime/render/absent_card.h"
#include "scaling.h"
#include "shaders.h"
#include "stars.h"
#include "worlds.h"
#include <memory>
#include <nlohmann/json.hpp>

namespace starbow {
namespace {

struct BenchOptions {
    int rounds = 25, seconds = 60;
    bool input = false;
    std::string card, display, json, layout, shot = "avenue-gamma4";
    bool stars = false, bodies = false, worlds = false, cubes = false, flight = false, scaling = false, governor = false;
    bool shaders = false, counts = false, estimate = false;
    std::string family = card_families.front(), pass, scene, against, ladder = "ladder";
    double frame_budget_ms = 0;
};

int bench(const BenchOptions& options)
{
    if (options.input)
        return bench_input(options.layout, options.seconds);
    if (options.governor)
        return bench_governor(options.ladder, options.frame_budget_ms, options.seconds);
    if (!options.card.empty())
        bench_card(options.card, options.display, options.rounds);
    else if (options.stars)
        bench_stars(options.rounds);
    else if (options.bodies)
        bench_bodies(options.rounds);
    else if (options.worlds)
        bench_worlds(options.rounds);
    else if (options.flight)
        bench_flight();
    else if (options.shaders)
        bench_shaders(options.family, options.pass, options.scene, options.json, options.against);
    else if (options.estimate)
        bench_estimate(options.family, options.layout.empty() ? "desk" : options.layout, options.shot);
    else if (options.counts)
        bench_counts();
    else if (options.scaling)
        bench_scaling(options.rounds);
    else if (options.cubes)
        bench_cubes(options.rounds);
    else if (!options.layout.empty())
        bench_layout(options.layout, options.shot, options.rounds);
    else if (options.json.empty())
        bench_frame_stages(options.rounds, false);
    else {
        check_writable(options.json);
        const nlohmann::ordered_json figures = bench_frame_stages(options.rounds, true);
        make_folder_of(options.json);
        write_whole(options.json, figures.dump(2) + "\n");
    }
    return 0;
}

} // namespace

static void add_bench(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<BenchOptions>();
    Subcommand* command = app.add_subcommand(bench_tool.name, bench_tool.help);
    command->add_option("--rounds", options->rounds, "How often each stage is timed")
        ->check(whole_number(3, 10000))
        ->capture_default_str();
    command->add_option("--json", options->json,
        "Also time the dome, bodies, worlds and the flight, and write all figures to this file; with --shaders: each "
        "pipeline's figures");
    command->add_option("--card", options->card,
        "Instead: this graphics card with a window, domes, walls and a headset, at three speeds in two qualities, pass by "
        "pass; writes card.json, a page and a trace into this folder");
    command->add_option("--display", options->display, "With --card: this display alone")
        ->check(one_of({card_displays.begin(), card_displays.end()}));
    command->add_option("--layout", options->layout,
        "Instead: this layout stage by stage, and displays compared with each other: kinds of projection, many viewports, "
        "stereo methods");
    command->add_option("--shot", options->shot, "With --layout and --estimate: the shot")->capture_default_str();
    command->add_flag("--stars", options->stars, "Instead: what the stars cost, the avenue's own and a million");
    command->add_flag("--bodies", options->bodies, "Instead: what bodies that move cost, in view and out of it");
    command->add_flag("--worlds", options->worlds, "Instead: the shipped worlds in which something moves, stage by stage");
    command->add_flag("--cubes", options->cubes,
        "Instead: a dome beside a plain picture, and the planned images beside six full faces as fine");
    command->add_flag("--flight", options->flight,
        "Instead: the longest frame of a scripted flight through take-off, all switches, gamma 100, cuts and edits");
    command->add_flag(
        "--scaling", options->scaling, "Instead: the cost of a pixel, a triangle and an object as they grow many");
    command->add_flag("--input", options->input,
        "Instead: in the exhibit's windows (on --layout), the time from a stick's report to the return of the present call "
        "that shows it");
    command->add_flag("--governor", options->governor,
        "Instead: how well a frame's time is held under a load that doubles and halves every 5 s");
    command->add_option("--ladder", options->ladder, "With --governor: the ladder")->capture_default_str();
    command->add_option(
        "--frame-budget-ms", options->frame_budget_ms, "With --governor: the time that is held [1.5 of the middle rung's]");
    command->add_option("--seconds", options->seconds, "With --input and --governor: how long")
        ->check(whole_number(1, 3600))
        ->capture_default_str();
    command->add_flag("--counts", options->counts,
        "Instead: how many passes, draws, binds and other calls a frame makes, by world, layout and speed");
    command->add_flag("--shaders", options->shaders,
        "Instead: what each pass's shaders cost on a graphics card that need not be there, as its compiler (RADV) says");
    command->add_flag("--estimate", options->estimate,
        "Instead: what a frame of --layout and --shot takes at least on a card of --family, by its shaders' cycles");
    command->add_option("--family", options->family, "With --shaders and --estimate: the card's family")
        ->check(one_of({card_families.begin(), card_families.end()}))
        ->capture_default_str();
    command->add_option("--pass", options->pass, "With --shaders: each variant of this pass, instead of all passes");
    command->add_option("--scene", options->scene, "With --shaders: this world alone [all that are shipped]");
    command->add_option(
        "--against", options->against, "With --shaders: a file of an earlier --json; what changed is printed");
    command->footer("Examples:\n  starbow bench --json out/bench.json\n  starbow bench --card out/card\n  starbow bench "
                    "--input --seconds 60\n"
                    "  starbow bench --shaders --scene avenue --pass warp\n"
                    "  starbow bench --estimate --layout dome --family navi21");
    command->callback([options, &chosen] { chosen = [options] { return bench(*options); }; });
}

static const Registered bench_command{10, add_bench};

} // namespace starbow
