#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "explain.h"
#include "extremes.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/options/size.h"
#include "runtime/commands/tools.h"
#include "runtime/images/capture.h"
#include "runtime/reference/reference.h"
#include "settings.h"
#include "shimmer.h"
#include "shown.h"
#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>

namespace starbow {
namespace {

struct MeasureOptions {
    std::string scene = "avenue", layout = "desk", size, out, standard = "balanced", which = "all";
    std::vector<std::string> shots, qualities;
    long rounds = 9, samples = 64;
    double budget_ms = 0;
    bool extremes = false, explain = false, shimmer = false, shown = false;
    bool one_scene = false; ///< --scene is given
};

constexpr std::array shipped_qualities = {"draft", "balanced", "fine"};

/// The named shots, or all shipped ones of the scene.
std::vector<std::pair<std::string, Shot>> shots_of(const MeasureOptions& options, const std::filesystem::path& scene)
{
    std::vector<std::pair<std::string, Shot>> shots;
    for (const std::string& name : options.shots) {
        const std::filesystem::path file = shipped_file("shots", name);
        const Shot shot = load_shot(file);
        if (!std::filesystem::equivalent(scene_of(shot, file), scene))
            throw InputError(
                "--shot " + name + " is in the scene " + shot.scene + "; one in " + options.scene + " is right");
        shots.emplace_back(file.stem().string(), shot);
    }
    if (!shots.empty())
        return shots;
    for (const std::string& name : shipped_names("shots")) {
        const std::filesystem::path file = shipped_file("shots", name);
        if (const Shot shot = load_shot(file); std::filesystem::equivalent(scene_of(shot, file), scene))
            shots.emplace_back(name, shot);
    }
    if (shots.empty())
        throw InputError("No shipped shot is in the scene " + options.scene + "; --shot with one of yours is right");
    return shots;
}

/// The named shots of any scene; without names those of the scene that is given, or of all scenes.
std::vector<ShotInScene> shots_to_show(const MeasureOptions& options)
{
    std::vector<ShotInScene> shots;
    for (const std::string& name : options.shots.empty() ? shipped_names("shots") : options.shots) {
        const std::filesystem::path file = shipped_file("shots", name);
        const Shot shot = load_shot(file);
        const std::filesystem::path scene = scene_of(shot, file);
        if (!options.one_scene || std::filesystem::equivalent(scene, shipped_file("scenes", options.scene)))
            shots.push_back({file.stem().string(), shot, scene});
    }
    if (shots.empty())
        throw InputError("No such shot is in the scene " + options.scene + "; one of its shots, or another scene, is right");
    std::ranges::sort(shots, {}, [](const ShotInScene& one) { return std::pair(one.scene, one.name); });
    return shots;
}

Trial trial_of(const MeasureOptions& options)
{
    Trial trial;
    trial.scene = shipped_file("scenes", options.scene);
    trial.layout = layout_in_size(options.layout, options.size);
    trial.shots = shots_of(options, trial.scene);
    trial.standard = load_quality(shipped_file("qualities", options.standard));
    trial.rounds = int(options.rounds), trial.samples = int(options.samples);
    trial.folder = options.out;
    return trial;
}

/// The shipped settings, and behind them the visitor's own.
std::vector<Setting> shipped_settings(const MeasureOptions& options)
{
    std::vector<Setting> shipped;
    for (const char* name : shipped_qualities)
        shipped.push_back({name, load_quality(shipped_file("qualities", name)), true});
    for (const std::string& name : options.qualities)
        shipped.push_back({name, load_quality(shipped_file("qualities", name)), true});
    return shipped;
}

/// The settings that the options choose; first the shipped ones and the visitor's own.
std::vector<Setting> settings_of(const MeasureOptions& options, const Trial& trial)
{
    const std::vector<Setting> shipped = shipped_settings(options);
    if (options.which == "shipped")
        return shipped;
    const ReferenceWorld world = open_reference_world(trial.scene);
    return settings_to_try(
        shipped, trial.standard, has_two_eyes(trial.layout), needed_level(world.world, world.scene).level);
}

/// Makes the folder for the results, before hours of measuring.
void make_folder(const std::filesystem::path& folder)
{
    check_writable(folder / "accuracy.html");
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw InputError(folder.string(), "", "can't be made (" + error.message() + "); give a folder that can be written");
}

/// Prints the shipped settings and those that no other setting beats, fastest first; then the shipped ones that are beaten.
void print_settings(const Trial& trial, const std::vector<MeasuredSetting>& all, const std::string& machine)
{
    const std::vector<bool> best = frontier(all);
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a].ms < all[b].ms; });
    std::printf("%s; * no other setting beats it\n\n%8s %7s %8s %8s %8s %9s %9s %8s\n", machine.c_str(), "ms", "ratio",
        "FLIP", "PSNR dB", "dE00 95", "edges px", "dir. px", "MiB");
    for (std::size_t i : order) {
        const MeasuredSetting& m = all[i];
        if (m.setting.shipped || best[i])
            std::printf("%8.1f %7.2f %8.4f %8.1f %8.2f %9.3f %9.4f %8.0f %s %s\n", m.ms, m.ratio, m.errors.flip,
                m.errors.psnr_dB, m.errors.ciede2000_95, m.errors.edges_95_px, m.direction_px, m.megabytes,
                best[i] ? "*" : " ", m.setting.name.c_str());
    }
    constexpr double noise = 0.15; // times of one run may differ by this part
    for (const MeasuredSetting& m : all)
        if (const MeasuredSetting* better = m.setting.shipped ? better_than(m, all, noise) : nullptr) {
            const double ratio = time_ratio(trial, better->setting.quality, m.setting.quality, device_options(false));
            if (ratio < 1 / (1 + noise))
                std::printf("%s is beaten: %s takes %.2f of its time with %.2f of its FLIP\n", m.setting.name.c_str(),
                    better->setting.name.c_str(), ratio, better->errors.flip / m.errors.flip);
        }
}

/// Writes the most accurate setting within the budget. Returns the exit status: 1 where none is.
int choose_within(double budget_ms, const Trial& trial, const std::vector<MeasuredSetting>& all)
{
    const MeasuredSetting* chosen = best_within(all, budget_ms);
    if (!chosen) {
        const auto fastest = std::min_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.ms < b.ms; });
        std::printf("nothing is within %g ms; the fastest takes %.1f ms\n", budget_ms, fastest->ms);
        return 1;
    }
    const std::filesystem::path file = trial.folder / "quality.json";
    write_whole(file, quality_text(chosen->setting.quality));
    std::printf("within %g ms: %s, %.1f ms; %s has it\n", budget_ms, chosen->setting.name.c_str(), chosen->ms, file.c_str());
    return 0;
}

int measure(const MeasureOptions& options)
{
    if (options.extremes)
        return measure_extremes(options.out);
    if (options.shown) {
        const Layout layout = layout_in_size(options.layout, options.size);
        const std::vector<ShotInScene> shots = shots_to_show(options);
        if (!options.out.empty())
            make_folder(options.out);
        return measure_shown(options.out, layout, shots, device_options(false));
    }
    if (options.out.empty() && !options.explain && !options.shimmer)
        throw InputError("--out is required here; the folder for the results, such as out/accuracy, is right");
    const Trial trial = trial_of(options);
    if (options.explain) {
        explain(trial, device_options(false));
        return 0;
    }
    if (!trial.folder.empty())
        make_folder(trial.folder);
    if (options.shimmer)
        return measure_shimmer(trial, shipped_settings(options), device_options(false));
    const std::vector<Setting> settings = settings_of(options, trial);
    MeasuredOn on{options.scene + ", " + options.layout, "", trial.rounds, trial.samples};
    for (const auto& [name, shot] : trial.shots)
        on.what += ", " + name;
    const std::vector<MeasuredSetting> all = measure_settings(trial, settings, device_options(false), on.machine);
    write_whole(trial.folder / "accuracy.csv", accuracy_csv(all));
    write_whole(trial.folder / "accuracy.svg", accuracy_chart(all, on.what));
    write_whole(trial.folder / "ladder.json", ladder_text(ladder_of(all)));
    write_whole(trial.folder / "accuracy.html", accuracy_page(all, on));
    print_settings(trial, all, on.machine);
    std::printf("\n%s/accuracy.html\n", options.out.c_str());
    return options.budget_ms > 0 ? choose_within(options.budget_ms, trial, all) : 0;
}

} // namespace

static void add_measure(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<MeasureOptions>();
    Subcommand* command = app.add_subcommand(measure_tool.name, measure_tool.help);
    const Option* scene = command->add_option("--scene", options->scene, "A scene file, or the name of one in config/scenes")
                              ->capture_default_str();
    command->add_option("--layout", options->layout, "A layout file, or the name of one in config/layouts")
        ->capture_default_str();
    command->add_option("--shot", options->shots,
        "A shot file, or the name of one in config/shots; more than one may be "
        "given [all shipped ones of the scene]");
    command->add_option("--size", options->size, "Pixels of every output, WIDTHxHEIGHT, instead of the layout's");
    command->add_option("--out", options->out,
        "The folder for accuracy.html, .csv and .svg, ladder.json; or for extremes.md, shimmer.md or shown.md; made if "
        "it is not there");
    command->add_option("--quality", options->qualities, "A quality file of your own to try too; more than one may be given")
        ->type_name("FILE");
    command
        ->add_option(
            "--default", options->standard, "The quality whose settings are varied, and that all times are relative to")
        ->capture_default_str();
    command
        ->add_option(
            "--settings", options->which, "Which settings are tried: all, or only the shipped ones and yours (shipped)")
        ->check(one_of({"all", "shipped"}))
        ->capture_default_str();
    command->add_option("--samples", options->samples, "Rays for each pixel of the reference")
        ->check(whole_number(1, 65536))
        ->capture_default_str();
    command->add_option("--rounds", options->rounds, "Timed frames of each shot")
        ->check(whole_number(1, 100000))
        ->capture_default_str();
    command
        ->add_option("--budget-ms", options->budget_ms,
            "Also choose: the most accurate setting whose frame takes no longer, as quality.json")
        ->check(number_between(0.01, 1e6));
    command->add_flag("--extremes", options->extremes,
        "Instead: whether extreme inputs (speeds, places, times, sizes, views, light) give finite results within the stated "
        "error, or are refused");
    command->add_flag("--explain", options->explain,
        "Instead: every part of a frame that the scene, the layout and the first shot switch on, why, and its cost; and "
        "what is off");
    command->add_flag("--shimmer", options->shimmer,
        "Instead: how much the live picture flickers in slow turns and slow acceleration from the first shot, beyond the "
        "change of the ray-traced picture");
    command->add_flag("--shown", options->shown,
        "Instead: how much of the layout's picture each shot fills, as an eye sees it and by the range curve, in all scenes "
        "unless --scene or --shot is given");
    command->footer("Examples:\n  starbow measure --scene avenue --layout desk --out out/accuracy\n"
                    "  starbow measure --layout dome --size 1024x1024 --shot starbow --out out/dome --budget-ms 16\n"
                    "  starbow run --quality out/dome/quality.json\n  starbow measure --scene clocks --shot clocks-passing "
                    "--explain\n  starbow measure --extremes\n  starbow measure --shown --layout dome --size 512x512");
    command->callback([options, scene, &chosen] {
        options->one_scene = scene->count() > 0;
        chosen = [options] { return measure(*options); };
    });
}

static const Registered measure_command{11, add_measure};

} // namespace starbow
