#include "commands.h"
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
    std::string layout = "desk", scene = "avenue", shot, pattern = "none";
    long frames = 0;
    bool asked = false; ///< for anything of the above
};

int run(const Options& options)
{
    Layout layout = load_layout(find("layouts", options.layout));
    std::filesystem::path scene = find("scenes", options.scene);
    Shot start = load_scene_file(scene).start;
    if (!options.shot.empty()) {
        std::filesystem::path shot_file = find("shots", options.shot);
        start = load_shot(shot_file);
        scene = scene_of(start, shot_file);
    }
    const Pattern pattern = pattern_of(options.pattern);
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
    return fly_exhibit(scene, layout, start, options.frames, pattern);
}

} // namespace

void add_run(CLI::App& app, std::function<int()>& chosen)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "run", "Fly: opens the layout's windows. Without a display server it draws the default shots to out/.");
    command->add_option("--layout", options->layout, "A layout file, or the name of one in config/layouts")
        ->capture_default_str();
    command->add_option("--scene", options->scene, "A scene file, or the name of one in config/scenes")
        ->capture_default_str();
    command->add_option("--shot", options->shot, "Start at this shot instead of the scene's start");
    command->add_option("--pattern", options->pattern, pattern_help)->capture_default_str();
    command->add_option("--frames", options->frames, "Leave after so many frames")->check(whole_number(0, 1000000000));
    command->footer(
        std::string("Keys:\n") + keyboard_help() + "\n\nExample:\n  starbow run --layout stereo --shot avenue-gamma4");
    command->callback([options, command, &chosen] {
        for (const CLI::Option* option : command->get_options())
            options->asked = options->asked || option->count() > 0;
        chosen = [options] { return run(*options); };
    });
}

} // namespace starbow
