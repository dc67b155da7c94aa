#include "config/json/error.h"
#include "config/json/whole_file.h"
#include "config/model/shipped.h"
#include "explain.h"
#include "extremes.h"
#include "runtime/commands/commands.h"
#include "runtime/commands/options/number.h"
#include "runtime/commands/options/size.h"
#include "runtime/images/capture.h"
#include "runtime/reference/reference.h"
#include "settings.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct Options {
    std::string scene = "avenue", layout = "desk", size, out, standard = "balanced", which = "all";
    std::vector<std::string> shots, qualities;
    long rounds = 9, samples = 64;
    double budget_ms = 0;
    bool extremes = false, explain = false;
};

constexpr std::array shipped_qualities = {"draft", "balanced", "fine"};

/// The named shots, or all shipped ones of the scene.
std::vector<std::pair<std::string, Shot>> shots_of(const Options& options, const std::filesystem::path& scene)
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
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(home() / "config/shots"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
        if (const Shot shot = load_shot(file); std::filesystem::equivalent(scene_of(shot, file), scene))
            shots.emplace_back(file.stem().string(), shot);
    if (shots.empty())
        throw InputError("No shipped shot is in the scene " + options.scene + "; --shot with one of yours is right");
    return shots;
}

int measure(const Options& options)
{
    if (options.extremes)
        return measure_extremes(options.out);
    if (options.out.empty() && !options.explain)
        throw InputError("--out is required here; the folder for the results, such as out/accuracy, is right");
    Trial trial;
    trial.scene = shipped_file("scenes", options.scene);
    trial.layout = load_layout(shipped_file("layouts", options.layout));
    if (!options.size.empty())
        for (Output& output : trial.layout.outputs)
            output.size = parse_size(options.size);
    trial.shots = shots_of(options, trial.scene);
    trial.standard = load_quality(shipped_file("qualities", options.standard));
    trial.rounds = int(options.rounds), trial.samples = int(options.samples);
    if (options.explain) {
        explain(trial, device_options(false));
        return 0;
    }
    trial.folder = options.out;
    std::vector<Setting> shipped;
    for (const char* name : shipped_qualities)
        shipped.push_back({name, load_quality(shipped_file("qualities", name)), true});
    for (const std::string& name : options.qualities)
        shipped.push_back({name, load_quality(shipped_file("qualities", name)), true});
    check_writable(trial.folder / "accuracy.html");
    std::error_code error;
    std::filesystem::create_directories(trial.folder, error);
    if (error)
        throw InputError(options.out, "", "can't be made (" + error.message() + "); give a folder that can be written");

    bool two_eyes = false;
    for (const Output& output : trial.layout.outputs)
        for (const Viewport& viewport : output.viewports)
            two_eyes |= viewport.eye != Eye::middle;
    const ReferenceWorld world = open_reference_world(trial.scene);
    const SpectralLevel needed = needed_level(world.world, world.scene).level;
    const std::vector<Setting> settings
        = options.which == "shipped" ? shipped : settings_to_try(shipped, trial.standard, two_eyes, needed);
    MeasuredOn on{options.scene + ", " + options.layout, "", trial.rounds, trial.samples};
    for (const auto& [name, shot] : trial.shots)
        on.what += ", " + name;
    const std::vector<MeasuredSetting> all = measure_settings(trial, settings, device_options(false), on.machine);
    write_whole(trial.folder / "accuracy.csv", accuracy_csv(all));
    write_whole(trial.folder / "accuracy.svg", accuracy_chart(all, on.what));
    write_whole(trial.folder / "ladder.json", ladder_text(ladder_of(all)));
    write_whole(trial.folder / "accuracy.html", accuracy_page(all, on));

    const std::vector<bool> best = frontier(all);
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a].ms < all[b].ms; });
    std::printf("%s; * what no other setting beats\n\n%8s %7s %8s %8s %8s %9s %9s %8s\n", on.machine.c_str(), "ms", "ratio",
        "FLIP", "PSNR dB", "dE00 95", "edges px", "dir. px", "MiB");
    for (std::size_t i : order) {
        const MeasuredSetting& m = all[i];
        if (m.setting.shipped || best[i])
            std::printf("%8.1f %7.2f %8.4f %8.1f %8.2f %9.3f %9.4f %8.0f %s %s\n", m.ms, m.ratio, m.errors.flip,
                m.errors.psnr_dB, m.errors.ciede2000_95, m.errors.edges_95_px, m.direction_px, m.megabytes,
                best[i] ? "*" : " ", m.setting.name.c_str());
    }
    constexpr double noise = 0.15; // what times of one run may differ by
    for (const MeasuredSetting& m : all)
        if (const MeasuredSetting* better = m.setting.shipped ? better_than(m, all, noise) : nullptr) {
            const double ratio = time_ratio(trial, better->setting.quality, m.setting.quality, device_options(false));
            if (ratio < 1 / (1 + noise))
                std::printf("%s is beaten: %s takes %.2f of its time with %.2f of its FLIP\n", m.setting.name.c_str(),
                    better->setting.name.c_str(), ratio, better->errors.flip / m.errors.flip);
        }
    std::printf("\n%s/accuracy.html\n", options.out.c_str());
    if (options.budget_ms > 0) {
        const MeasuredSetting* chosen = best_within(all, options.budget_ms);
        if (!chosen) {
            std::printf("nothing is within %g ms; the fastest takes %.1f ms\n", options.budget_ms, all[order[0]].ms);
            return 1;
        }
        const std::filesystem::path file = trial.folder / "quality.json";
        write_whole(file, quality_text(chosen->setting.quality));
        std::printf("within %g ms: %s, %.1f ms; %s has it\n", options.budget_ms, chosen->setting.name.c_str(), chosen->ms,
            file.c_str());
    }
    return 0;
}

} // namespace

void add_measure(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("measure",
        "Speed for accuracy: each setting's time, memory and error against the reference, as a table and a chart.");
    command->add_option("--scene", options->scene, "A scene file, or the name of one in config/scenes")
        ->capture_default_str();
    command->add_option("--layout", options->layout, "A layout file, or the name of one in config/layouts")
        ->capture_default_str();
    command->add_option("--shot", options->shots,
        "A shot file, or the name of one in config/shots; more than one may be "
        "given [all shipped ones of the scene]");
    command->add_option("--size", options->size, "Pixels of every output, WIDTHxHEIGHT, instead of the layout's");
    command->add_option("--out", options->out,
        "The folder for accuracy.html, .csv and .svg, ladder.json; or for extremes.md; made if it is not there");
    command->add_option("--quality", options->qualities, "A quality file of your own to try too; more than one may be given")
        ->type_name("FILE");
    command->add_option("--default", options->standard, "The quality whose knobs are turned, and that all times are told by")
        ->capture_default_str();
    command->add_option("--settings", options->which, "What is tried: all, or only the shipped ones and yours (shipped)")
        ->check(CLI::IsMember({"all", "shipped"}))
        ->capture_default_str();
    command->add_option("--samples", options->samples, "Rays for each pixel of the reference")
        ->check(whole_number(1, 65536))
        ->capture_default_str();
    command->add_option("--rounds", options->rounds, "Frames that are timed of each shot")
        ->check(whole_number(1, 100000))
        ->capture_default_str();
    command
        ->add_option("--budget-ms", options->budget_ms,
            "Also choose: the most accurate setting whose frame takes no longer, as quality.json")
        ->check(CLI::Range(0.01, 1e6));
    command->add_flag("--extremes", options->extremes,
        "Instead: at the ends of what there is (speeds, places, times, sizes, views, light), whether all is finite and "
        "within "
        "its stated error, or refused");
    command->add_flag("--explain", options->explain,
        "Instead: every part of a frame that the scene, the layout and the first shot switch on, why, and its cost; and "
        "what "
        "is off");
    command->footer("Examples:\n  starbow measure --scene avenue --layout desk --out out/accuracy\n"
                    "  starbow measure --layout dome --size 1024x1024 --shot starbow --out out/dome --budget-ms 16\n"
                    "  starbow run --quality out/dome/quality.json\n  starbow measure --scene clocks --shot clocks-passing "
                    "--explain\n  starbow measure --extremes");
    command->callback([options, &chosen] { chosen = [options] { return measure(*options); }; });
}

} // namespace starbow
