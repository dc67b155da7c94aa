#include "commands.h"
#include "config/json/error.h"
#include "config/model/exhibit_file.h"
#include "config/model/shipped.h"
#include "contact_sheet.h"
#include "displays/compile/compiled_view.h"
#include "input/keyboard.h"
#include "interrupt.h"
#include "runtime/commands/options/command_line.h"
#include "runtime/commands/options/language.h"
#include "runtime/commands/options/pattern.h"
#include "runtime/commands/options/quality.h"
#include "runtime/exhibit/exhibit.h"
#include "runtime/exhibit/node.h"
#include "runtime/exhibit/open_exhibit.h"
#include "runtime/exhibit/outputs.h"
#include "runtime/flight/replay.h"
#include "runtime/operation/crash_counter.h"
#include "runtime/operation/last_language.h"
#include "runtime/operation/log.h"
#include "runtime/operation/record_files.h"
#include "runtime/operation/service.h"
#include "runtime/operation/state_folder.h"
#include "runtime/operation/trace.h"
#include "version.h"
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>

namespace starbow {
namespace {

/// A small world under constant light, without stars and bodies.
constexpr const char* plain_scene = "chart";

struct RunOptions {
    std::string exhibit = "desk", layout, scene, shot, pattern = "none", record, replay, language, tour, log, quality,
                ladder, trace, warm_up = "auto", node, frame_log, programme;
    double frame_budget_ms = -1; ///< below 0: the exhibit's
    double log_every_s = 0;
    bool by_eye = false;
    long frames = 0;
    bool presenter = false; ///< the guide's window, whatever the exhibit's file says
    bool verbose = false;
    bool careful = false; ///< a start with care after disorderly ends
    bool any_given = false; ///< true if any of the options above is given
};

/// The options of a record's replay: its own scene, start and rules. layout: replaces the record's; empty: keeps it.
ExhibitOptions reopen(const std::filesystem::path& record, const std::string& layout, const std::string& language)
{
    const RecordHeader header = Replay(record).header();
    const Flown flown = find_flown(record, header, layout, write_log);
    return {.content = {.scene = flown.scene, .start = header.start},
        .layout = flown.layout,
        .words = words_in(language.empty() ? "en" : language),
        .rules = header.rules,
        .exposure = header.exposing,
        .tutorial = false,
        .pattern = pattern_named(header.pattern),
        .replay = record};
}

ExhibitOptions open(const RunOptions& options)
{
    if (!options.replay.empty())
        return reopen(options.replay, options.layout, options.language);
    Exhibit exhibit = load_exhibit(shipped_file("exhibits", options.exhibit));
    // The command line has precedence over the exhibit file. A scene or a shot of its own replaces both of the file's.
    if (!options.layout.empty())
        exhibit.layout = options.layout;
    if (!options.scene.empty())
        exhibit.scene = options.scene;
    if (!options.scene.empty() || !options.shot.empty())
        exhibit.shot = options.shot, exhibit.tour.clear();
    if (!options.tour.empty())
        exhibit.tour = options.tour, exhibit.shot.clear();
    if (!exhibit.tour.empty() && !options.record.empty())
        throw InputError("A tour's flight can't be recorded; --record without a tour is right");
    if (!options.language.empty())
        exhibit.language = options.language;
    exhibit.flying.paced = exhibit.flying.paced && options.log.empty(); // in a laboratory the throttle is the students'
    if (!options.quality.empty())
        exhibit.quality = options.quality, exhibit.frame_budget_ms = 0;
    if (options.frame_budget_ms >= 0)
        exhibit.frame_budget_ms = options.frame_budget_ms;
    if (!options.ladder.empty())
        exhibit.ladder = options.ladder;
    if (!options.programme.empty())
        exhibit.programme = options.programme;
    if (options.presenter && !exhibit.presenter)
        exhibit.presenter.emplace();
    if (!options.careful && (!options.tour.empty() || !options.scene.empty() || !options.shot.empty()))
        exhibit.visiting.reset();
    if (options.careful && exhibit.visiting)
        exhibit.visiting->attract.clear(); // their worlds may be what ended it
    ExhibitOptions exhibit_options = open_exhibit(exhibit);
    exhibit_options.pattern = pattern_named(options.pattern);
    exhibit_options.record = options.record;
    exhibit_options.cache = map_cache_folder();
    if (!options.node.empty()) {
        if (!exhibit.machines)
            throw InputError("--node " + options.node + " names a machine, and the exhibit " + options.exhibit
                + " has none; \"machines\" in its file is right");
        check_machines(*exhibit.machines, exhibit_options.layout, options.node);
        exhibit_options.machines = exhibit.machines, exhibit_options.node = options.node;
        exhibit_options.machines->exhibit = identity_of(*exhibit.machines, exhibit_options.layout);
        exhibit_options.frame_log = options.frame_log;
    }
    if (exhibit_options.visiting && !options.record.empty() && !std::filesystem::is_directory(options.record))
        throw InputError("--record " + options.record
            + " is not a folder; the exhibit records each visit in a file of its own, and a folder is right");
    return exhibit_options;
}

/// True for a machine that shows what its master says.
bool follows_master(const RunOptions& options)
{
    if (options.node.empty())
        return false;
    const Exhibit exhibit = load_exhibit(shipped_file("exhibits", options.exhibit));
    return exhibit.machines && exhibit.machines->master != options.node;
}

/// The options after many disorderly ends: what is drawn may be what ended them.
RunOptions careful(RunOptions options, int ends)
{
    options.scene = plain_scene;
    options.quality = "draft";
    options.frame_budget_ms = -1; // the exhibit's ladder makes way for the quality, too
    options.shot = options.tour = options.replay = "";
    options.careful = true;
    write_log(LogKind::careful_start,
        "it has crashed or hung " + std::to_string(ends) + " times within " + std::to_string(ends_within_s / 60)
            + " minutes; it starts in safe mode: the scene '" + plain_scene + "' in the quality '" + options.quality + "'");
    return options;
}

/// The language that a docent had chosen, if there are words in it; empty: the exhibit's.
std::string language_after_crash()
{
    const std::string kept = kept_language(state_folder());
    const std::vector<std::string> known = shipped_names("words");
    return std::ranges::find(known, kept) != known.end() ? kept : "";
}

int run(const RunOptions& given)
{
    open_log({.lowest = given.verbose ? LogLevel::debug : LogLevel::info});
    // Without a service manager nobody starts the program again, and a second one may run beside it.
    std::optional<CrashCounter> ends;
    if (Service().supervised())
        ends.emplace(state_folder(), std::time(nullptr));
    const bool care = ends && ends->lately() >= most_ends && !follows_master(given);
    RunOptions options = care ? careful(given, ends->lately()) : given;
    if (ends && ends->lately() > 0 && options.language.empty())
        options.language = language_after_crash();
    else if (ends)
        forget_language(state_folder());
    ExhibitOptions exhibit_options = open(options);
    exhibit_options.careful = options.careful;
    exhibit_options.version = program_version;
    exhibit_options.frames = options.frames;
    if (options.warm_up != "auto" || options.frames > 0)
        exhibit_options.warms_up = options.warm_up == "always";
    exhibit_options.log = options.log;
    exhibit_options.log_every_s = options.log_every_s;
    exhibit_options.by_eye = options.by_eye;
    if (!has_display() && options.any_given)
        throw InputError(
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no window can be opened; "
            "starbow render, which needs none, is right");
    if (!has_display()) {
        std::printf(
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no window can be opened.\n"
            "Drawing the default shots into out/ instead.\n");
        return render_contact_sheet("out");
    }
    write_log(LogKind::files_used, "the shipped files are in " + home().string());
    write_log(LogKind::files_used, "the layout is " + exhibit_options.layout.file.string());
    write_log(LogKind::files_used, "the scene is " + exhibit_options.content.scene.string());
    write_log(LogKind::files_used, std::to_string(exhibit_options.profiles.size()) + " profiles of devices are known");
    std::optional<Trace> trace;
    if (!options.trace.empty())
        exhibit_options.trace = &trace.emplace(options.trace);
    catch_interrupts(); // they end the flight as Esc does
    exhibit_options.over = interrupted;
    const ExitWork last([&] {
        trace.reset();
        if (ends)
            ends->in_order(); // the X server's end is no fault of the exhibit
    });
    int status;
    {
        WindowSystem window_system;
        const bool leads = !exhibit_options.machines || exhibit_options.machines->master == exhibit_options.node;
        status = leads ? fly_exhibit(exhibit_options) : show_node(exhibit_options);
    }
    if (ends && status == 0)
        ends->in_order();
    return status;
}

} // namespace

static void add_run(Subcommand& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<RunOptions>();
    Subcommand* command = app.add_subcommand(
        "run", "Fly: open the layout's windows. Without a display server, draw the default shots into out/.");
    command
        ->add_option("--exhibit", options->exhibit,
            "An exhibit file, or the name of one in config/exhibits: its layout, its "
            "scene, how it flies")
        ->capture_default_str();
    command->add_option("--layout", options->layout, "Instead: a layout file, or the name of one in config/layouts");
    command->add_option("--scene", options->scene, "Instead: a scene file, or the name of one in config/scenes");
    Option* node = command->add_option("--node", options->node,
        "The name of this machine where several show the exhibit together: a node of the layout's outputs");
    command
        ->add_option("--frame-log", options->frame_log,
            "With --node: write each frame that is shown, with its time and the digest of its state, into this CSV file")
        ->needs(node);
    command->add_option("--shot", options->shot, "Instead: start at this shot, in its scene");
    add_language(*command, options->language);
    command->add_option("--pattern", options->pattern, pattern_help)->capture_default_str();
    command->add_option("--frames", options->frames, "Leave after this many frames")->check(whole_number(0, 1000000000));
    command->add_option("--record", options->record,
        "Record every control of the flight in this new file (or in a new file in this folder), for --replay. A minute at "
        "60 "
        "frames a second takes 70 kB at rest, 0.4 MB with a stick in hand, 1.2 MB with a head tracker");
    Option* log = command->add_option("--log", options->log,
        "Write what the instruments read into this CSV file, a line each time K is pressed; an existing file is continued");
    command->add_flag("--by-eye", options->by_eye,
        "For a laboratory: the instruments have scales without figures, and with --log K asks for your own reading");
    command->add_option("--log-every", options->log_every_s, "With --log: also write a line every this many seconds")
        ->check(number_between(0.02, 86400.0))
        ->needs(log);
    command
        ->add_option("--warm-up", options->warm_up,
            "Before the first frame, compile all that the visitor's switches can need: always, never, or auto, which does "
            "so on a GPU unless --frames ends the flight soon")
        ->check(one_of({"auto", "always", "never"}))
        ->capture_default_str();
    command->add_option("--trace", options->trace,
        "Write what each frame spends its time on into this JSON file, for ui.perfetto.dev or chrome://tracing; an older "
        "file is replaced");
    command->add_flag("--presenter", options->presenter,
        "Open the guide's window, too: the visitors' picture small, the tour's cue sheet, and all that a guide can do, by "
        "keys and by the mouse");
    command->add_option("--programme", options->programme,
        "The programme of a guide's show, a file or the name of one in config/programmes, for the guide's window and the "
        "remote's page [the exhibit's]");
    Option* verbose = command->add_flag("--verbose", options->verbose, "Log debug messages on standard error");
    Option* quality = command->add_option("--quality", options->quality, quality_help + std::string(" [the exhibit's]"));
    Option* hold = command
                       ->add_option("--frame-budget-ms", options->frame_budget_ms,
                           "Hold the time of a whole frame at this by moving along the ladder of measured qualities; 0: off")
                       ->check(number_between(0.0, 1000.0))
                       ->excludes(quality);
    command
        ->add_option("--ladder", options->ladder,
            "For --frame-budget-ms: a ladder that starbow measure wrote, or the name of one in config/qualities [ladder]")
        ->needs(hold);
    Option* tour = command->add_option("--tour", options->tour,
        "Instead: show this tour, a file or the name of one in config/tours; then the visitor flies, and when nobody does, "
        "it begins again. Space: pause, go on; R: next step; Backspace: back");
    for (const char* other : {"--scene", "--shot", "--record"})
        tour->excludes(other);
    Option* replay = command->add_option(
        "--replay", options->replay, "Fly a record again, bit for bit, in its scene and on its layout (or on --layout's)");
    for (const char* other :
        {"--exhibit", "--scene", "--shot", "--tour", "--pattern", "--record", "--presenter", "--programme", "--node"})
        replay->excludes(other);
    command->footer(std::string("Keys:\n") + keyboard_help()
        + "\n\nExamples:\n  starbow run --layout stereo --shot avenue-gamma4\n  starbow run --exhibit dome --language de\n  "
          "starbow run --tour first-minute\n  starbow run --presenter --programme evening\n  starbow run --exhibit "
          "our-dome.json --node left\n  starbow run --trace "
          "out/trace.json --verbose");
    command->callback([options, command, verbose, &chosen] {
        options->any_given = command->given_besides(verbose);
        chosen = [options] { return run(*options); };
    });
}

static const Registered run_command{1, add_run};

} // namespace starbow
