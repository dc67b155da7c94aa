#include "commands.h"
#include "config/exhibit.h"
#include "contact_sheet.h"
#include "input/keyboard.h"
#include "number_option.h"
#include "pattern_option.h"
#include "runtime/exhibit.h"
#include "runtime/find.h"
#include "runtime/outputs.h"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace starbow {
namespace {

struct Options {
    std::string exhibit = "desk", layout, scene, shot, pattern = "none";
    long frames = 0;
    bool asked = false; ///< for anything of the above
};

int run(const Options& options)
{
    Exhibit exhibit = load_exhibit(find("exhibits", options.exhibit));
    // What the command line names counts; a scene or a shot of its own replaces both of the file's.
    if (!options.layout.empty())
        exhibit.layout = options.layout;
    if (!options.scene.empty())
        exhibit.scene = options.scene;
    if (!options.scene.empty() || !options.shot.empty())
        exhibit.shot = options.shot;
    Opening opening{.scene = find("scenes", exhibit.scene), .layout = load_layout(find("layouts", exhibit.layout))};
    opening.start = load_scene_file(opening.scene).start;
    if (!exhibit.shot.empty()) {
        const std::filesystem::path shot_file = find("shots", exhibit.shot);
        opening.start = load_shot(shot_file);
        opening.scene = scene_of(opening.start, shot_file);
    }
    opening.rules = exhibit.flying;
    opening.exposure = exhibit.exposure;
    opening.profiles = known_profiles(exhibit.profiles);
    opening.tutorial = exhibit.tutorial;
    opening.frames = options.frames;
    opening.pattern = pattern_of(options.pattern);
    if (!has_display() && options.asked)
        throw InputError(
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no window can be opened; "
            "starbow render, which needs none, is right");
    if (!has_display()) {
        std::printf(
            "There is no display server here (DISPLAY and WAYLAND_DISPLAY lead nowhere), so no window can be opened.\n"
            "Drawing the default shots into out/ instead.\n");
        return render_contact_sheet("out");
    }
    WindowSystem window_system;
    return fly_exhibit(opening);
}

} // namespace

void add_run(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "run", "Fly: opens the layout's windows. Without a display server it draws the default shots to out/.");
    command
        ->add_option("--exhibit", options->exhibit,
            "An exhibit file, or the name of one in config/exhibits: its layout, its "
            "scene, how it flies")
        ->capture_default_str();
    command->add_option("--layout", options->layout, "Instead: a layout file, or the name of one in config/layouts");
    command->add_option("--scene", options->scene, "Instead: a scene file, or the name of one in config/scenes");
    command->add_option("--shot", options->shot, "Instead: start at this shot, in its scene");
    command->add_option("--pattern", options->pattern, pattern_help)->capture_default_str();
    command->add_option("--frames", options->frames, "Leave after so many frames")->check(whole_number(0, 1000000000));
    command->footer(std::string("Keys:\n") + keyboard_help()
        + "\n\nExamples:\n  starbow run --layout stereo --shot avenue-gamma4\n  starbow run --exhibit dome");
    command->callback([options, command, &chosen] {
        for (const CLI::Option* option : command->get_options())
            options->asked = options->asked || option->count() > 0;
        chosen = [options] { return run(*options); };
    });
}

} // namespace starbow
